/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>

#include "config_keys.h"
#include "output.h"

static bool run(const arguments_t *arguments, failure_t *failure)
{
    settings_t settings;
    if (arguments->operand_count > 0u) {
        return failure_usage(failure, "insole config: takes no operands, only --doc");
    }
    settings_init(&settings);
    if (options_has(arguments, "doc")) {
        config_print_table(stdout);
    } else {
        config_print(stdout, &settings);
    }
    return output_flush(stdout, "-", failure);
}

static const option_t options[] = {{"doc", NULL, "as a Markdown table"}, {NULL, NULL, NULL}};

const command_t command_config = {
    "config",
    "",
    "every setting with its default, range and unit",
    "What it prints is a config file: change what you like, leave out the rest, and give it to\n"
    "`replay --config FILE`. A single setting goes by `replay --set KEY=VALUE`.\n"
    "\n"
    "  insole config > my.conf\n",
    options,
    run};
