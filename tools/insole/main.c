/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "help.h"
#include "nearest.h"

static const command_t *find_command(const char *name)
{
    for (const command_t *const *command = help_commands(); *command != NULL; command++) {
        if (strcmp((*command)->name, name) == 0) {
            return *command;
        }
    }
    return NULL;
}

static bool refuse_command(const char *name, failure_t *failure)
{
    nearest_t nearest;
    nearest_begin(&nearest, name);
    for (const command_t *const *command = help_commands(); *command != NULL; command++) {
        nearest_offer(&nearest, (*command)->name);
    }
    failure_usage(failure, "insole: unknown command %.40s", name);
    return nearest.best != NULL ? failure_add(failure, ": did you mean %s?", nearest.best)
                                : failure_add(failure, ": `insole --help` lists them");
}

static bool is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

static bool wants_help(int argc, char *const *argv)
{
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (is_help(argv[i])) {
            return true;
        }
    }
    return false;
}

static bool run_command(const command_t *command, int argc, char *const *argv, failure_t *failure)
{
    arguments_t arguments;
    if (wants_help(argc, argv)) {
        help_command(stdout, command);
        return true;
    }
    bool is_good =
        options_parse(&arguments, command->name, command->options, argc, argv, failure) &&
        command->run(&arguments, failure);
    options_free(&arguments);
    return is_good;
}

/* `insole help [COMMAND|files]` */
static bool run_help(const char *topic, failure_t *failure)
{
    if (topic == NULL) {
        help_program(stdout);
    } else if (strcmp(topic, "files") == 0) {
        help_files(stdout);
    } else {
        const command_t *command = find_command(topic);
        if (command == NULL) {
            return refuse_command(topic, failure);
        }
        help_command(stdout, command);
    }
    return true;
}

static bool run_program(int argc, char *const *argv, failure_t *failure)
{
    if (argc < 2) {
        help_program(stderr);
        failure->exit_code = EXIT_WRONG_USAGE;
        return false;
    }
    if (is_help(argv[1]) || strcmp(argv[1], "help") == 0) {
        return run_help(argc > 2 ? argv[2] : NULL, failure);
    }
    if (strcmp(argv[1], "--version") == 0) {
        help_version(stdout);
        return true;
    }
    const command_t *command = find_command(argv[1]);
    return command != NULL ? run_command(command, argc - 2, argv + 2, failure)
                           : refuse_command(argv[1], failure);
}

int main(int argc, char **argv)
{
    failure_t failure = {EXIT_DONE, ""};
    if (run_program(argc, argv, &failure)) {
        return EXIT_DONE;
    }
    return failure_report(&failure);
}
