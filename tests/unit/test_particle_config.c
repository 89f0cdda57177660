/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_config.h"

#include <math.h>
#include <string.h>

#include "near.h"
#include "setting.h"
#include "suite.h"

static insole_particle_filter_config_t config;

static insole_status_t judge(void)
{
    insole_particle_filter_config_t before = config;
    insole_status_t status = insole_particle_config_check(&config);
    ck_assert_mem_eq(&config, &before, sizeof config);
    return status;
}

static void expect(insole_status_t expected, const char *name)
{
    setting_expect(judge, expected, name, 0.0);
}

START_TEST(settings_are_in_range_or_refused)
{
    static const insole_particle_filter_config_t *const settings[] = {
        &insole_particle_filter_defaults, &insole_particle_filter_two_order,
        &insole_particle_filter_phone, &insole_particle_filter_phone_plain};
    config = *settings[_i];
    expect(INSOLE_OK, "as it is");
    INSOLE_PARTICLE_FILTER_KEYS(SETTING_HAS_ENDS)
    config.field.spacing_m = -1;
    expect(INSOLE_ERR_VALUE, "a setting of the field");
    ck_assert_int_eq(insole_particle_config_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

/* The paper knows no offset, no scale, no spreading of copies and no second thoughts. */
START_TEST(the_paper_is_as_printed)
{
    config = insole_particle_filter_two_order;
    ck_assert(config.walls == INSOLE_WALLS_INSIDE);
    ck_assert(config.sigma_wander_rad == 0 && config.sigma_scale == 0 && config.scale_memory == 1);
    ck_assert(config.spread_share == 0 && config.redraw_share == 0);
    ck_assert(config.turn_share > 0 && config.sigma_length_m > 0);
}
END_TEST

/* Steps of a phone scatter by 0.3 of their length, 4 degrees across; the offset wanders by 2.5
 * degrees, the scale by 0.005 about a scatter of 0.12. A shoe's settings have none of it. */
START_TEST(a_stride_as_it_is_set)
{
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, INSOLE_R(0.8), INSOLE_R(0.5), INSOLE_R(-0.2));
    insole_cloud_stride_t s = insole_particle_config_stride(&insole_particle_filter_phone, &news);
    ASSERT_NEAR(s.length_m, 0.8, 1e-6, "m");
    ASSERT_NEAR(s.heading_rad, 0.5, 1e-6, "rad");
    ASSERT_NEAR(s.sigma_length_m, 0.24, 1e-6, "m");
    ASSERT_NEAR(s.sigma_heading_rad, 0.07, 1e-6, "rad");
    ASSERT_NEAR(s.apart_wander_rad, 0.0436, 1e-6, "rad");
    ASSERT_NEAR(s.apart_scale, 0.005, 1e-5, "");
    ck_assert(s.sigma_wander_rad == 0 && s.sigma_scale == 0);
    insole_evidence_scatter(&news, INSOLE_R(0.01), INSOLE_R(0.04));
    s = insole_particle_config_stride(&insole_particle_filter_phone, &news);
    ASSERT_NEAR(s.sigma_length_m, hypot(0.24, 0.1), 1e-6, "m");
    ASSERT_NEAR(s.sigma_heading_rad, hypot(0.07, 0.2), 1e-6, "rad");
    insole_evidence_scatter(&news, 0, 0);
    config = insole_particle_filter_two_order;
    s = insole_particle_config_stride(&config, &news);
    ck_assert(s.sigma_length_m == config.sigma_length_m);
    ck_assert(s.sigma_heading_rad == config.turn_share * news.turn_rad * -1);
    config = insole_particle_filter_defaults;
    s = insole_particle_config_stride(&config, &news);
    ck_assert(s.sigma_length_m == config.sigma_length_m && s.sigma_heading_rad == 0);
    ck_assert(s.sigma_wander_rad == config.sigma_wander_rad);
    ck_assert(s.apart_wander_rad == 0 && s.apart_scale == 0);
    ASSERT_NEAR(s.sigma_scale, (double)config.sigma_scale * sqrt(1.0 - 0.99 * 0.99), 1e-7, "");
}
END_TEST

static insole_cloud_source_t cloud_of(insole_real_t sigma_m, insole_real_t sigma_rad)
{
    insole_cloud_source_t cloud;
    memset(&cloud, 0, sizeof cloud);
    cloud.var_x_m2 = cloud.var_y_m2 = sigma_m * sigma_m;
    cloud.sigma_offset_rad = sigma_rad;
    return cloud;
}

/* The same in double, from what the settings say they are. */
static double power_of(double sigma_m, double sigma_rad, bool is_blind)
{
    double wider = is_blind ? 2.5 : 1.0, least = is_blind ? (double)config.blind_power : 1.0;
    double most = (double)(is_blind ? config.blind_search_power : config.search_power);
    double in_m = sigma_m / (wider * (double)config.search_sigma_m);
    double in_rad = sigma_rad / (wider * (double)config.search_offset_rad);
    double square = in_m * in_m + in_rad * in_rad;
    return least + (most - least) * square / (1.0 + square);
}

START_TEST(a_scan_says_more_to_a_wide_cloud)
{
    static const double sigma_m[] = {0, 0.1, 0.5, 1.5, 3, 10, 100};
    static const double sigma_rad[] = {0, 0.05, 0.7, 3.1};
    config = insole_particle_filter_defaults;
    for (size_t i = 0; i < 7; i++) {
        for (size_t j = 0; j < 4; j++) {
            insole_cloud_source_t cloud =
                cloud_of((insole_real_t)sigma_m[i], (insole_real_t)sigma_rad[j]);
            double power = (double)insole_particle_config_scan_power(&config, &cloud, _i > 0);
            double expected = power_of(sigma_m[i], sigma_rad[j], _i > 0);
            ck_assert_msg(fabs(power - expected) < 1e-5 * expected, "%g m %g rad: %g, not %g",
                          sigma_m[i], sigma_rad[j], power, expected);
        }
    }
}
END_TEST

START_TEST(power_stays_within_its_bounds)
{
    config = insole_particle_filter_defaults;
    for (int exponent = -40; exponent < 38; exponent++) {
        insole_cloud_source_t cloud = cloud_of(0, 0);
        cloud.var_x_m2 = cloud.var_y_m2 = (insole_real_t)pow(10.0, exponent);
        insole_real_t power = insole_particle_config_scan_power(&config, &cloud, false);
        ck_assert(power >= 1 && power <= config.search_power);
        power = insole_particle_config_scan_power(&config, &cloud, true);
        ck_assert(power >= config.blind_power && power <= config.blind_search_power);
    }
}
END_TEST

START_TEST(the_paper_weighs_all_scans_alike)
{
    config = insole_particle_filter_two_order;
    insole_cloud_source_t narrow = cloud_of(INSOLE_R(0.01), 0), wide = cloud_of(30, 3);
    ck_assert(insole_particle_config_scan_power(&config, &narrow, _i > 0) == 1);
    ck_assert(insole_particle_config_scan_power(&config, &wide, _i > 0) == 1);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("particle_config");
    TCase *tcase = tcase_create("settings");
    tcase_add_loop_test(tcase, settings_are_in_range_or_refused, 0, 4);
    tcase_add_test(tcase, the_paper_is_as_printed);
    tcase_add_test(tcase, a_stride_as_it_is_set);
    tcase_add_loop_test(tcase, a_scan_says_more_to_a_wide_cloud, 0, 2);
    tcase_add_test(tcase, power_stays_within_its_bounds);
    tcase_add_loop_test(tcase, the_paper_weighs_all_scans_alike, 0, 2);
    suite_add_tcase(suite, tcase);
    return suite;
}
