/* SPDX-License-Identifier: MIT */
#include "sim/radio.h"

#include "buildings.h"
#include "near.h"
#include "suite.h"

#define START   "start,0,0,0\n"
#define AP      "id,x,y,z,p0_dbm,exponent\na,0,0,0,-40,2.5\n"
#define MATCHED "radio.model = matched\n"
/* The full model with everything off that can be switched off. */
#define BARE                                                                                       \
    "radio.p0_spread_db = 0\nradio.exponent_spread = 0\nradio.wall_spread = 0\n"                   \
    "radio.wall_keep = 1\nradio.shadow_db = 0\nradio.rice_db = 60\nradio.body_db = 0\n"            \
    "radio.offset_db = 0\nradio.step_db = 0\nradio.floor_dbm = -200\nradio.lost_share = 0\n"

typedef struct {
    sim_scenario_t scenario;
    sim_radio_t radio;
} setup_t;

static void open_radio(setup_t *s, const char *text, const char *plan, const char *aps,
                       uint64_t seed)
{
    sim_error_t error;
    s->scenario = scenario_in(text, plan, aps);
    ck_assert(sim_radio_open(&s->radio, &s->scenario, seed, &error));
}

static void close_radio(setup_t *s)
{
    sim_radio_close(&s->radio);
    sim_scenario_free(&s->scenario);
}

static double mean_at(const setup_t *s, double x, double y, double heading_rad)
{
    return sim_radio_mean(&s->radio, 0, sim_vec3(x, y, 0.0), heading_rad);
}

/* Mean of a model in which one setting differs from BARE. */
static double mean_with(const char *setting, const char *plan, double x, double heading_rad,
                        uint64_t seed)
{
    char text[1200];
    setup_t s;
    snprintf(text, sizeof text, "%s%s%s", START, BARE, setting);
    open_radio(&s, text, plan, AP, seed);
    double mean = mean_at(&s, x, 0.0, heading_rad);
    close_radio(&s);
    return mean;
}

START_TEST(strength_falls_with_the_logarithm_of_distance)
{
    setup_t s;
    open_radio(&s, START MATCHED, "", AP, 1);
    ASSERT_NEAR(mean_at(&s, 1.0, 0.0, 0.0), -40.0, 1e-12, "dBm");
    ASSERT_NEAR(mean_at(&s, 0.0, -10.0, 0.0), -65.0, 1e-12, "dBm");
    ASSERT_NEAR(mean_at(&s, 30.0, 40.0, 0.0), -82.4742501084, 1e-9, "dBm"); /* 25 lg 50 */
    ASSERT_NEAR(sim_radio_mean(&s.radio, 0, sim_vec3(0.0, 0.0, 10.0), 0.0), -65.0, 1e-12, "dBm");
    ASSERT_NEAR(mean_at(&s, 0.0, 0.0, 0.0), mean_at(&s, 0.1, 0.0, 0.0), 1e-12, "dBm");
    close_radio(&s);
}
END_TEST

START_TEST(what_is_not_told_comes_from_the_settings)
{
    setup_t s;
    open_radio(&s, START MATCHED "radio.p0_dbm = -30\nradio.exponent = 3\nradio.ap_height_m = 10\n",
               "", "id,x,y\na,0,0\n", 1);
    ASSERT_NEAR(mean_at(&s, 0.0, 0.0, 0.0), -60.0, 1e-12, "dBm");
    close_radio(&s);
}
END_TEST

/* Three walls of 6, 4 and (as not told) 5 dB between x = 1 and 4. */
#define WALLS "wall,6,1.5,-1,1.5,1\nwall,4,2.5,-1,2.5,1\nhole,3.4,-1,3.6,-1,3.5,0.5\n"

START_TEST(walls_take_what_the_plan_tells)
{
    static const double places[] = {1.0, 2.0, 3.0, 4.0}, losses[] = {0.0, 6.0, 10.0, 20.0};
    setup_t s;
    open_radio(&s, START MATCHED "radio.wall_db = 5\n", WALLS, AP, 1);
    for (int i = 0; i < 4; i++) {
        double free = -40.0 - 25.0 * log10(places[i]);
        ASSERT_NEAR(mean_at(&s, places[i], 0.0, 0.0), free - losses[i], 1e-9, "dBm");
    }
    close_radio(&s);
}
END_TEST

START_TEST(further_walls_take_less)
{
    double free = mean_with("", "", 4.0, 0.0, 1);
    const char *two = "wall,6,1.5,-1,1.5,1\nwall,4,2.5,-1,2.5,1\n";
    ASSERT_NEAR(free - mean_with("radio.wall_keep = 0.8\n", "wall,6,1.5,-1,1.5,1\n", 4.0, 0.0, 1),
                6.0, 1e-9, "dB");
    ASSERT_NEAR(free - mean_with("radio.wall_keep = 0.8\n", two, 4.0, 0.0, 1), 5.0 * 1.8, 1e-9,
                "dB");
    ASSERT_NEAR(free - mean_with("radio.wall_keep = 0\n", two, 4.0, 0.0, 1), 5.0, 1e-9, "dB");
}
END_TEST

START_TEST(all_pieces_of_a_wall_have_one_loss_and_walls_differ)
{
    const char *plan = "wall,10,1.5,-1,1.5,0.5,1.5,9\nwall,10,-1.5,-1,-1.5,9\n";
    setup_t s;
    double sum = 0.0, squares = 0.0, apart = 0.0;
    int n = 500;
    for (int seed = 1; seed <= n; seed++) {
        open_radio(&s, START BARE "radio.wall_spread = 0.2\nradio.building = 0\n", plan, AP,
                   (uint64_t)seed);
        double free = -40.0 - 25.0 * log10(2.0);
        double low = free - mean_at(&s, 2.0, 0.0, 0.0);
        double high = -40.0 - 12.5 * log10(8.0) - mean_at(&s, 2.0, 2.0, 0.0);
        double other = free - mean_at(&s, -2.0, 0.0, 0.0);
        ASSERT_NEAR(low, high, 1e-9, "dB");
        sum += low / n;
        squares += (low - 10.0) * (low - 10.0) / n;
        apart += (low - other) * (low - other) / n;
        close_radio(&s);
    }
    ASSERT_NEAR(sum, 10.0, 0.3, "dB");
    ASSERT_NEAR(sqrt(squares), 2.0, 0.25, "dB");
    ASSERT_NEAR(sqrt(apart), 2.0 * sqrt(2.0), 0.35, "dB");
}
END_TEST

START_TEST(the_body_takes_most_from_behind)
{
    double ahead = mean_with("radio.body_db = 8\n", "", -4.0, 0.0, 1);
    ASSERT_NEAR(ahead, mean_with("", "", -4.0, 0.0, 1), 1e-9, "dBm");
    ASSERT_NEAR(ahead - mean_with("radio.body_db = 8\n", "", -4.0, SIM_PI, 1), 8.0, 1e-9, "dB");
    worst_t step = {0.0, 0.0};
    double last = ahead;
    for (int i = 1; i <= 180; i++) {
        double angle = SIM_PI * i / 180.0;
        double now = mean_with("radio.body_db = 8\n", "", -4.0, angle, 1);
        double mirrored = mean_with("radio.body_db = 8\n", "", -4.0, -angle, 1);
        ck_assert(now < last);
        ASSERT_NEAR(now, mirrored, 1e-9, "dBm");
        worst_note(&step, last - now, angle);
        last = now;
    }
    ASSERT_WORST(step, 0.08, "dB per degree");
}
END_TEST

/* Spread over seeds of the mean at 10 m, where a single setting makes it. */
static double spread_of(const char *setting)
{
    double squares = 0.0, bare = mean_with("", "", 10.0, 0.0, 1);
    int n = 400;
    for (int seed = 1; seed <= n; seed++) {
        double off = mean_with(setting, "", 10.0, 0.0, (uint64_t)seed) - bare;
        squares += off * off / n;
    }
    return sqrt(squares);
}

START_TEST(access_points_receiver_and_places_differ_as_asked_for)
{
    ASSERT_NEAR(spread_of("radio.building = 0\nradio.p0_spread_db = 3\n"), 3.0, 0.35, "dB");
    ASSERT_NEAR(spread_of("radio.building = 0\nradio.exponent_spread = 0.2\n"), 2.0, 0.25, "dB");
    ASSERT_NEAR(spread_of("radio.building = 0\nradio.shadow_db = 3.5\n"), 3.5, 0.4, "dB");
    ASSERT_NEAR(spread_of("radio.offset_db = 2\n"), 2.0, 0.25, "dB");
}
END_TEST

START_TEST(a_building_is_the_same_for_every_seed)
{
    const char *drawn = "radio.p0_spread_db = 3\nradio.exponent_spread = 0.2\nradio.shadow_db = 4\n"
                        "radio.wall_spread = 0.3\nradio.building = %d\n";
    char one[300], two[300];
    snprintf(one, sizeof one, drawn, 1);
    snprintf(two, sizeof two, drawn, 2);
    double a = mean_with(one, WALLS, 4.0, 0.0, 5), b = mean_with(one, WALLS, 4.0, 0.0, 6);
    double c = mean_with(two, WALLS, 4.0, 0.0, 5);
    ck_assert(a == b);
    ASSERT_AT_LEAST(fabs(a - c), 0.01, "dB");
}
END_TEST

enum { READINGS = 20000 };

typedef struct {
    double mean, sigma, skew, lag; /* lag: correlation of a reading with the next */
    double heard;                  /* share */
} reading_t;

/* Statistics of readings at one place. */
static reading_t readings_of(const char *text, double x)
{
    static double values[READINGS];
    setup_t s;
    open_radio(&s, text, "", AP, 3);
    reading_t r = {0.0, 0.0, 0.0, 0.0, 0.0};
    int n = 0;
    for (int i = 0; i < READINGS; i++) {
        if (sim_radio_hear(&s.radio, 0, sim_vec3(x, 0.0, 0.0), 0.0, &values[n])) {
            r.mean += values[n++];
        }
    }
    r.mean /= n;
    for (int i = 0; i < n; i++) {
        double d = values[i] - r.mean;
        r.sigma += d * d / n;
        r.skew += d * d * d / n;
        r.lag += i > 0 ? d * (values[i - 1] - r.mean) / n : 0.0;
    }
    r.lag /= r.sigma;
    r.skew /= pow(r.sigma, 1.5);
    r.sigma = sqrt(r.sigma);
    r.heard = (double)n / READINGS;
    close_radio(&s);
    return r;
}

START_TEST(matched_noise_is_white_and_normal)
{
    reading_t r = readings_of(START MATCHED "radio.noise_db = 4\n", 10.0);
    ASSERT_NEAR(r.mean, -65.0, 0.15, "dBm");
    ASSERT_NEAR(r.sigma, 4.0, 0.1, "dB");
    ASSERT_NEAR(r.skew, 0.0, 0.08, "1");
    ASSERT_NEAR(r.lag, 0.0, 0.03, "1");
    ASSERT_NEAR(r.heard, 1.0, 0.0, "1");
}
END_TEST

START_TEST(a_matched_radio_hears_by_the_mean_alone)
{
    const char *text = START MATCHED "radio.noise_db = 4\nradio.floor_dbm = -64.99\n";
    setup_t s;
    double dbm;
    open_radio(&s, text, "", AP, 3);
    for (int i = 0; i < 100; i++) {
        ck_assert(!sim_radio_hear(&s.radio, 0, sim_vec3(10.0, 0.0, 0.0), 0.0, &dbm));
        ck_assert(sim_radio_hear(&s.radio, 0, sim_vec3(9.9, 0.0, 0.0), 0.0, &dbm));
    }
    close_radio(&s);
}
END_TEST

/* Mean and spread of 10 lg of the power, by summing the density of the amplitude. */
static void rice_by_density(double k_db, double *mean, double *sigma)
{
    double k = pow(10.0, 0.1 * k_db), m = 0.0, m2 = 0.0, all = 0.0;
    for (double r = 0.0005; r < 4.0; r += 0.001) {
        double z = 2.0 * r * sqrt(k * (k + 1.0)), bessel = 0.0;
        for (int i = 0; i < 200; i++) {
            bessel += exp(z * cos(SIM_PI * (i + 0.5) / 200.0) - z) / 200.0;
        }
        double p = r * bessel * exp(z - k - (k + 1.0) * r * r), db = 20.0 * log10(r);
        all += p;
        m += p * db;
        m2 += p * db * db;
    }
    *mean = m / all;
    *sigma = sqrt(m2 / all - *mean * *mean);
}

static const double rices_db[] = {-20.0, 0.0, 7.0, 15.0};

START_TEST(fading_is_that_of_rice)
{
    char text[1200];
    double mean, sigma;
    snprintf(text, sizeof text, "%s%sradio.rice_db = %g\n", START, BARE, rices_db[_i]);
    reading_t r = readings_of(text, 10.0);
    rice_by_density(rices_db[_i], &mean, &sigma);
    ASSERT_NEAR(r.mean, -65.0 + mean, 0.02 + 0.03 * sigma, "dBm");
    ASSERT_NEAR(r.sigma, sigma, 0.03 * sigma, "dB");
    ASSERT_AT_MOST(r.skew, -0.2, "1"); /* deep fades, no deep peaks */
}
END_TEST

START_TEST(readings_come_in_whole_steps)
{
    setup_t s;
    open_radio(&s, START "radio.step_db = 1\n", "", AP, 3);
    bool differ = false;
    double last = 0.0;
    for (int i = 0; i < 300; i++) {
        double dbm;
        if (sim_radio_hear(&s.radio, 0, sim_vec3(9.0, 0.1 * i, 0.0), 0.0, &dbm)) {
            ck_assert(dbm == round(dbm));
            differ = differ || (i > 0 && dbm != last);
            last = dbm;
        }
    }
    ck_assert(differ);
    close_radio(&s);
    reading_t fine = readings_of(START BARE "radio.rice_db = 7\n", 10.0);
    reading_t coarse = readings_of(START BARE "radio.rice_db = 7\nradio.step_db = 3\n", 10.0);
    ASSERT_NEAR(coarse.mean, fine.mean, 0.15, "dBm");
    ASSERT_NEAR(coarse.sigma * coarse.sigma, fine.sigma * fine.sigma + 9.0 / 12.0, 0.4, "dB^2");
}
END_TEST

START_TEST(weak_signals_are_heard_by_chance)
{
    static const double floors[] = {-80.0, -67.0, -65.0, -63.0, -50.0};
    static const double shares[] = {0.99945, 0.7311, 0.5, 0.2689, 0.00055};
    for (int i = 0; i < 5; i++) {
        char text[1200];
        snprintf(text, sizeof text, "%s%sradio.floor_dbm = %g\nradio.floor_soft_db = 2\n", START,
                 BARE, floors[i]);
        ASSERT_NEAR(readings_of(text, 10.0).heard, shares[i], 0.015, "1");
    }
    ASSERT_NEAR(readings_of(START BARE "radio.lost_share = 0.3\n", 10.0).heard, 0.7, 0.012, "1");
}
END_TEST

START_TEST(equal_seeds_give_equal_readings)
{
    setup_t a, b, c;
    open_radio(&a, START, "", AP, 3);
    open_radio(&b, START, "", AP, 3);
    open_radio(&c, START, "", AP, 4);
    bool differ = false;
    for (int i = 0; i < 100; i++) {
        double x = 0.0, y = 0.0, z = 0.0;
        bool heard = sim_radio_hear(&a.radio, 0, sim_vec3(5.0, 0.0, 0.0), 0.0, &x);
        ck_assert_int_eq(heard, sim_radio_hear(&b.radio, 0, sim_vec3(5.0, 0.0, 0.0), 0.0, &y));
        sim_radio_hear(&c.radio, 0, sim_vec3(5.0, 0.0, 0.0), 0.0, &z);
        ck_assert(x == y);
        differ = differ || x != z;
    }
    ck_assert(differ);
    close_radio(&a);
    close_radio(&b);
    close_radio(&c);
}
END_TEST

START_TEST(near_is_the_mean_round_an_access_point)
{
    setup_t s;
    double free = -40.0 - 25.0 * log10(1.5);
    open_radio(&s, START BARE "radio.body_db = 6\n", "", AP, 1);
    ASSERT_NEAR(sim_radio_near(&s.radio, 0, 0.0), free - 3.0, 1e-9, "dBm");
    close_radio(&s);
    /* at a wall, the half behind it does not count; shut in, there is nowhere to measure */
    open_radio(&s, START MATCHED, "wall,20,-9,0.1,9,0.1\n", AP, 1);
    ASSERT_NEAR(sim_radio_near(&s.radio, 0, 0.0), free, 1e-9, "dBm");
    close_radio(&s);
    open_radio(&s, START MATCHED, "hole,-1,-1,1,-1,1,1,-1,1\n", AP, 1);
    ck_assert(isnan(sim_radio_near(&s.radio, 0, 0.0)));
    close_radio(&s);
}
END_TEST

/* Half of the time nobody is in the way; else the loss has the second moment of a normal. */
START_TEST(people_in_between_take_some)
{
    char text[1200];
    setup_t s;
    snprintf(text, sizeof text, "%s%sradio.crowd_db = 6\nradio.crowd_s = 1\n", START, BARE);
    open_radio(&s, text, "", AP, 3);
    double free_dbm = mean_at(&s, 9.0, 0.0, 0.0), none = 0.0, squares = 0.0, together = 0.0;
    double last = 0.0, mean = 0.0;
    int n = 40000;
    for (int i = 0; i < n; i++) {
        double dbm;
        sim_radio_wait(&s.radio, 0.25);
        ck_assert(sim_radio_hear(&s.radio, 0, sim_vec3(9.0, 0.0, 0.0), 0.0, &dbm));
        double loss = free_dbm - dbm;
        none += fabs(loss) < 0.1 ? 1.0 / n : 0.0; /* fading is 60 dB down */
        squares += loss * loss / n;
        mean += loss / n;
        together += loss * last / n;
        last = loss;
    }
    ASSERT_NEAR(none, 0.5, 0.04, "1");
    ASSERT_NEAR(mean, 6.0 / sqrt(2.0 * SIM_PI), 0.2, "dB");
    ASSERT_NEAR(sqrt(squares), 6.0 / sqrt(2.0), 0.25, "dB");
    double kept = (together - mean * mean) / (squares - mean * mean);
    ASSERT_NEAR(kept, exp(-0.25), 0.08, "1"); /* the cut at 0 takes little of the correlation */
    close_radio(&s);
}
END_TEST

START_TEST(without_people_waiting_changes_nothing)
{
    setup_t a, b;
    open_radio(&a, START, "", AP, 3);
    open_radio(&b, START "radio.crowd_s = 50\n", "", AP, 3);
    for (int i = 0; i < 200; i++) {
        double x = 0.0, y = 0.0;
        sim_radio_wait(&b.radio, 0.1 * i);
        bool heard = sim_radio_hear(&a.radio, 0, sim_vec3(5.0, 0.0, 0.0), 0.0, &x);
        ck_assert_int_eq(heard, sim_radio_hear(&b.radio, 0, sim_vec3(5.0, 0.0, 0.0), 0.0, &y));
        ck_assert(x == y);
    }
    close_radio(&a);
    close_radio(&b);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/radio");
    suite_add(suite, "distance", strength_falls_with_the_logarithm_of_distance);
    suite_add(suite, "not told", what_is_not_told_comes_from_the_settings);
    suite_add(suite, "walls", walls_take_what_the_plan_tells);
    suite_add(suite, "many walls", further_walls_take_less);
    suite_add(suite, "wall spread", all_pieces_of_a_wall_have_one_loss_and_walls_differ);
    suite_add(suite, "body", the_body_takes_most_from_behind);
    suite_add(suite, "spreads", access_points_receiver_and_places_differ_as_asked_for);
    suite_add(suite, "building", a_building_is_the_same_for_every_seed);
    suite_add(suite, "matched", matched_noise_is_white_and_normal);
    suite_add(suite, "matched floor", a_matched_radio_hears_by_the_mean_alone);
    suite_add_loop(suite, "rice", fading_is_that_of_rice, 4);
    suite_add(suite, "steps", readings_come_in_whole_steps);
    suite_add(suite, "floor", weak_signals_are_heard_by_chance);
    suite_add(suite, "seeds", equal_seeds_give_equal_readings);
    suite_add(suite, "near", near_is_the_mean_round_an_access_point);
    suite_add(suite, "people", people_in_between_take_some);
    suite_add(suite, "nobody", without_people_waiting_changes_nothing);
    return suite;
}
