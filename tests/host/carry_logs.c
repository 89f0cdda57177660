/* SPDX-License-Identifier: MIT */
/* Logs that the suite of train-carry has its table grown from.  usage: carry_logs FOLDER */
#include "carry_people.h"

int main(int argc, char **argv)
{
    return argc == 2 && people_make(argv[1]) ? 0 : 1;
}
