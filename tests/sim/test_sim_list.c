/* SPDX-License-Identifier: MIT */
#include "sim/list.h"

#include <stdint.h>

#include "suite.h"

START_TEST(items_stay_in_order_while_it_grows)
{
    sim_list_t list = sim_list(sizeof(uint32_t));
    for (uint32_t i = 0; i < 1000u; i++) {
        uint32_t item = 3u * i;
        ck_assert(sim_list_add(&list, &item));
    }
    ck_assert_uint_eq(list.count, 1000u);
    for (uint32_t i = 0; i < 1000u; i++) {
        ck_assert_uint_eq(*(uint32_t *)sim_list_at(&list, i), 3u * i);
    }
    sim_list_free(&list);
}
END_TEST

START_TEST(there_is_nothing_past_the_end)
{
    sim_list_t list = sim_list(sizeof(double));
    double item = 1.5;
    ck_assert_ptr_null(sim_list_at(&list, 0));
    ck_assert(sim_list_add(&list, &item));
    ck_assert_ptr_nonnull(sim_list_at(&list, 0));
    ck_assert_ptr_null(sim_list_at(&list, 1));
    sim_list_free(&list);
}
END_TEST

START_TEST(a_freed_list_is_empty_and_can_be_used_again)
{
    sim_list_t list = sim_list(sizeof(int));
    int item = 7;
    ck_assert(sim_list_add(&list, &item));
    sim_list_free(&list);
    ck_assert_uint_eq(list.count, 0u);
    ck_assert_ptr_null(sim_list_at(&list, 0));
    ck_assert(sim_list_add(&list, &item));
    ck_assert_int_eq(*(int *)sim_list_at(&list, 0), 7);
    sim_list_free(&list);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/list");
    suite_add(suite, "order", items_stay_in_order_while_it_grows);
    suite_add(suite, "end", there_is_nothing_past_the_end);
    suite_add(suite, "free", a_freed_list_is_empty_and_can_be_used_again);
    return suite;
}
