/* SPDX-License-Identifier: MIT */
#include "suite.h"
Suite *insole_suite(void){return suite_create("x");}
