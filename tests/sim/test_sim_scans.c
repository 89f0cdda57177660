/* SPDX-License-Identifier: MIT */
#include "sim/scans.h"

#include "buildings.h"
#include "near.h"
#include "suite.h"

#define STAND "start,0,0,0\npause,600\nwalk.lead_in_s = 0\nwalk.lead_out_s = 0\n"
#define THREE "id,x,y,z,p0_dbm,exponent\na,3,0,1,-40,2\nb,0,4,1,-40,2\nc,-5,1,1,-40,2\n"
#define EVEN                                                                                       \
    "radio.jitter_s = 0\nradio.missed_share = 0\nradio.late_share = 0\nradio.lost_share = 0\n"

typedef struct {
    sim_scenario_t scenario;
    sim_walk_t *walk;
    sim_list_t heard;
} setup_t;

static void scan(setup_t *s, const char *text, const char *aps, uint64_t seed)
{
    sim_error_t error;
    s->scenario = scenario_in(text, "", aps);
    s->walk = sim_walk_open(&s->scenario, seed, &error);
    ck_assert_msg(s->walk != NULL, "%s", error.text);
    ck_assert(sim_scans_make(s->walk, &s->scenario, seed, &s->heard, &error));
}

static void finish(setup_t *s)
{
    sim_list_free(&s->heard);
    sim_walk_close(s->walk);
    sim_scenario_free(&s->scenario);
}

static const sim_heard_t *heard_at(const setup_t *s, size_t number)
{
    return sim_list_at(&s->heard, number);
}

START_TEST(without_access_points_or_switched_off_nothing_is_heard)
{
    setup_t s;
    scan(&s, STAND, "", 1);
    ck_assert_uint_eq(s.heard.count, 0u);
    finish(&s);
    scan(&s, STAND "radio.model = off\n", THREE, 1);
    ck_assert_uint_eq(s.heard.count, 0u);
    finish(&s);
}
END_TEST

static const double periods[] = {0.1, 0.5, 1.0, 7.3};

START_TEST(scans_come_with_their_period)
{
    char text[500];
    setup_t s;
    snprintf(text, sizeof text, "%s%sradio.period_s = %g\n", STAND, EVEN, periods[_i]);
    scan(&s, text, THREE, 1);
    ASSERT_NEAR((double)s.heard.count / 3.0, 600.0 / periods[_i], 1.0, "scans");
    double first = heard_at(&s, 0)->t_s;
    ASSERT_AT_LEAST(first, 0.0, "s");
    ASSERT_AT_MOST(first, periods[_i], "s");
    for (size_t i = 0; i < s.heard.count; i++) {
        ASSERT_NEAR(heard_at(&s, i)->t_s, first + (double)(i / 3) * periods[_i], 1e-9, "s");
        ck_assert_uint_eq(heard_at(&s, i)->ap, i % 3);
        ck_assert(heard_at(&s, i)->age_s == 0.0);
    }
    finish(&s);
}
END_TEST

static double when_heard(const sim_heard_t *heard)
{
    return heard->t_s - heard->age_s;
}

/* Where in the period the scans lie: their mean direction on a circle. */
static double phase_of(const setup_t *s, double period_s)
{
    double sine = 0.0, cosine = 0.0;
    for (size_t i = 0; i < s->heard.count; i++) {
        double turn = 2.0 * SIM_PI * when_heard(heard_at(s, i)) / period_s;
        sine += sin(turn);
        cosine += cos(turn);
    }
    return period_s * atan2(sine, cosine) / (2.0 * SIM_PI);
}

START_TEST(times_vary_scans_get_lost_and_some_are_late)
{
    setup_t s;
    scan(&s,
         STAND "radio.period_s = 0.2\nradio.jitter_s = 0.01\nradio.missed_share = 0.1\n"
               "radio.late_share = 0.2\nradio.late_s = 0.5\nradio.lost_share = 0\n",
         "id,x,y\na,3,0\n", 2);
    double phase = phase_of(&s, 0.2), count = (double)s.heard.count;
    double late = 0.0, age = 0.0, squares = 0.0;
    for (size_t i = 0; i < s.heard.count; i++) {
        const sim_heard_t *h = heard_at(&s, i);
        late += h->age_s > 0.0 ? 1.0 : 0.0;
        age += h->age_s;
        squares += pow(remainder(when_heard(h) - phase, 0.2), 2.0);
    }
    ASSERT_NEAR(count, 2700.0, 60.0, "scans");
    ASSERT_NEAR(late / count, 0.2, 0.03, "1");
    ASSERT_NEAR(age / late, 0.5, 0.07, "s");
    ASSERT_NEAR(sqrt(squares / count), 0.01, 0.001, "s");
    finish(&s);
}
END_TEST

START_TEST(the_log_is_in_order_and_within_the_walk)
{
    setup_t s;
    scan(&s, STAND "radio.period_s = 0.1\nradio.late_share = 0.5\nradio.late_s = 2\n", THREE, 2);
    for (size_t i = 1; i < s.heard.count; i++) {
        const sim_heard_t *a = heard_at(&s, i - 1), *b = heard_at(&s, i);
        ck_assert(a->t_s < b->t_s || (a->t_s == b->t_s && a->ap < b->ap));
        ck_assert(b->t_s <= sim_walk_duration(s.walk) && b->t_s - b->age_s >= 0.0);
    }
    finish(&s);
}
END_TEST

/* With no noise each reading tells the distance from where it was heard. */
#define EXACT "radio.model = matched\nradio.noise_db = 0\nradio.period_s = 0.25\n"
#define TRIP  "start,0,0,0\nwalk,8,0,1.3\nwalk,8,5,1.1\npause,1\nwalk,2,4,1.4\n"

START_TEST(a_matched_radio_hears_where_the_truth_is)
{
    setup_t s;
    scan(&s, TRIP EXACT, THREE, 1);
    sim_body_t body = sim_walk_body(s.walk);
    static const sim_vec3_t aps[] = {{3.0, 0.0, 1.0}, {0.0, 4.0, 1.0}, {-5.0, 1.0, 1.0}};
    ck_assert(heard_at(&s, 0)->t_s == 0.0);
    for (size_t i = 0; i < s.heard.count; i++) {
        const sim_heard_t *h = heard_at(&s, i);
        sim_vec3_t at = body.pose(body.state, h->t_s).position_m;
        double distance = pow(10.0, (-40.0 - h->dbm) / 20.0);
        ASSERT_NEAR(distance, sim_vec3_norm(sim_vec3_sub(at, aps[h->ap])), 1e-9, "m");
    }
    finish(&s);
}
END_TEST

START_TEST(a_late_scan_tells_where_it_was_heard)
{
    setup_t s;
    scan(&s,
         "start,0,0,0\nwalk,40,0,1.3\nradio.late_share = 0.5\nradio.late_s = 2\n"
         "radio.period_s = 0.3\nradio.p0_spread_db = 0\nradio.exponent_spread = 0\n"
         "radio.shadow_db = 0\nradio.rice_db = 60\nradio.body_db = 0\nradio.offset_db = 0\n"
         "radio.step_db = 0\nradio.floor_dbm = -200\n",
         "id,x,y,z,p0_dbm,exponent\na,-3,0,0,-40,2\n", 1);
    sim_body_t body = sim_walk_body(s.walk);
    worst_t off = {0.0, 0.0};
    double oldest = 0.0;
    for (size_t i = 0; i < s.heard.count; i++) {
        const sim_heard_t *h = heard_at(&s, i);
        sim_vec3_t at = body.pose(body.state, when_heard(h)).position_m;
        double distance = pow(10.0, (-40.0 - h->dbm) / 20.0);
        worst_note(&off, fabs(distance / hypot(at.x + 3.0, hypot(at.y, at.z)) - 1.0), h->t_s);
        oldest = fmax(oldest, h->age_s);
    }
    ASSERT_WORST(off, 0.01, "of the distance"); /* what fading is left */
    ASSERT_AT_LEAST(oldest, 3.0, "s");
    finish(&s);
}
END_TEST

START_TEST(a_radio_on_the_body_goes_with_it)
{
    setup_t s;
    scan(&s, TRIP EXACT "radio.place = body\nradio.height_m = 1\n",
         "id,x,y,z,exponent\na,-50,0,1,2\n", 1);
    double last = 0.0;
    for (size_t i = 0; i < s.heard.count; i++) {
        const sim_heard_t *h = heard_at(&s, i);
        double distance = pow(10.0, (-40.0 - h->dbm) / 20.0);
        if (h->t_s > 5.0 && h->t_s < 8.0) { /* a foot would stop and go */
            ASSERT_NEAR((distance - last) / 0.25, 1.3, 0.25, "m/s");
        }
        last = distance;
    }
    ASSERT_NEAR(last, hypot(52.0, 4.0), 0.02, "m");
    finish(&s);
}
END_TEST

/* The mean of n readings scatters by 1 / sqrt(n) of one. */
START_TEST(readings_are_averaged_over_the_period)
{
    static const double counts[] = {1.0, 4.0, 16.0};
    double sigma[3];
    for (int k = 0; k < 3; k++) {
        char text[500];
        setup_t s;
        double sum = 0.0, squares = 0.0;
        snprintf(text, sizeof text,
                 STAND EVEN "radio.model = matched\nradio.noise_db = 4\nradio.readings = %g\n",
                 counts[k]);
        scan(&s, text, "id,x,y,z\na,3,0,1\n", 6);
        double n = (double)s.heard.count;
        ASSERT_NEAR(n, 600.0, 1.0, "scans");
        for (size_t i = 0; i < s.heard.count; i++) {
            sum += heard_at(&s, i)->dbm / n;
            squares += pow(heard_at(&s, i)->dbm, 2.0) / n;
        }
        sigma[k] = sqrt(squares - sum * sum);
        finish(&s);
    }
    ASSERT_NEAR(sigma[0], 4.0, 0.4, "dB");
    ASSERT_NEAR(sigma[1], 2.0, 0.2, "dB");
    ASSERT_NEAR(sigma[2], 1.0, 0.1, "dB");
}
END_TEST

/* Ten readings in the second before the scan tell of the place half a second before it. */
START_TEST(averaged_readings_lag_behind_a_walker)
{
    setup_t one, ten;
    const char *walk = "start,0,0,0\nwalk,30,0,1.3\nradio.place = body\nradio.model = matched\n"
                       "radio.noise_db = 0\nradio.height_m = 1\n";
    char text[500];
    const char *ap = "id,x,y,z,exponent\na,-50,0,1,2\n";
    scan(&one, walk, ap, 1);
    snprintf(text, sizeof text, "%sradio.readings = 10\n", walk);
    scan(&ten, text, ap, 1);
    for (size_t i = 8; i < 20; i++) {
        double ahead = pow(10.0, (-40.0 - heard_at(&one, i)->dbm) / 20.0);
        double behind = pow(10.0, (-40.0 - heard_at(&ten, i)->dbm) / 20.0);
        ASSERT_NEAR(ahead - behind, 0.45 * 1.3, 0.08, "m");
    }
    finish(&one);
    finish(&ten);
}
END_TEST

START_TEST(equal_seeds_hear_the_same)
{
    setup_t a, b, c;
    scan(&a, TRIP, THREE, 4);
    scan(&b, TRIP, THREE, 4);
    scan(&c, TRIP, THREE, 5);
    ck_assert_uint_eq(a.heard.count, b.heard.count);
    bool differ = a.heard.count != c.heard.count;
    for (size_t i = 0; i < a.heard.count; i++) {
        const sim_heard_t *x = heard_at(&a, i), *y = heard_at(&b, i), *z = heard_at(&c, i);
        ck_assert(x->t_s == y->t_s && x->ap == y->ap && x->dbm == y->dbm);
        differ = differ || z == NULL || x->dbm != z->dbm;
    }
    ck_assert(differ);
    finish(&a);
    finish(&b);
    finish(&c);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/scans");
    suite_add(suite, "off", without_access_points_or_switched_off_nothing_is_heard);
    suite_add_loop(suite, "period", scans_come_with_their_period, 4);
    suite_add(suite, "times", times_vary_scans_get_lost_and_some_are_late);
    suite_add(suite, "order", the_log_is_in_order_and_within_the_walk);
    suite_add(suite, "matched", a_matched_radio_hears_where_the_truth_is);
    suite_add(suite, "late", a_late_scan_tells_where_it_was_heard);
    suite_add(suite, "body", a_radio_on_the_body_goes_with_it);
    suite_add(suite, "seeds", equal_seeds_hear_the_same);
    suite_add(suite, "readings", readings_are_averaged_over_the_period);
    suite_add(suite, "lag", averaged_readings_lag_behind_a_walker);
    return suite;
}
