/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "forest_writer.h"
#include "memory.h"
#include "output.h"
#include "pack_writer.h"
#include "platform.h"

/* Windows half over each other. */
#define CARRY_NEXT_US 1100000u

/* All that a run knows. */
typedef struct {
    const arguments_t *arguments;
    carry_index_t index, test;
    carry_windows_t windows;
    forest_settings_t settings;
    size_t learnt; /* logs of the index; those of the test come behind */
    bool *is_used; /* per log */
    FILE *report;
} training_t;

/* ---- settings --------------------------------------------------------------------------- */

static const struct {
    const char *name;
    int64_t count;
} feature_sets[] = {
    {"all", INSOLE_CARRY_FEATURES}, {"accel", INSOLE_CARRY_ACCEL}, {"paper", INSOLE_CARRY_PAPER}};

enum { FEATURE_SETS = sizeof feature_sets / sizeof feature_sets[0], NOT_ASKED = 0 };

static bool read_features(const arguments_t *arguments, int64_t *features, failure_t *failure)
{
    const char *text = options_value(arguments, "features");
    *features = NOT_ASKED;
    for (int i = 0; i < FEATURE_SETS && text != NULL; i++) {
        *features = strcmp(text, feature_sets[i].name) == 0 ? feature_sets[i].count : *features;
    }
    return text == NULL || *features != NOT_ASKED ||
           failure_usage(
               failure, "insole train-carry: --features %.40s: expected paper, accel or all", text);
}

static const char *name_of_features(int64_t count)
{
    int i = 0;
    while (feature_sets[i].count != count) {
        i++;
    }
    return feature_sets[i].name;
}

/* Where nobody asks, all that every log has. */
static bool settle_features(const carry_windows_t *windows, int64_t *features, failure_t *failure)
{
    if (*features == NOT_ASKED) {
        *features = windows->without_gyro == 0u ? INSOLE_CARRY_FEATURES : INSOLE_CARRY_ACCEL;
    }
    return *features <= INSOLE_CARRY_ACCEL || windows->without_gyro == 0u ||
           failure_input(failure,
                         "insole train-carry: --features all: %lu windows are without gyroscope: "
                         "expected logs that have one, or --features accel",
                         (unsigned long)windows->without_gyro);
}

static bool read_settings(const arguments_t *arguments, forest_settings_t *settings,
                          failure_t *failure)
{
    int64_t seed = 1;
    *settings = forest_defaults;
    if (!options_whole(arguments, "trees", 1, FOREST_MOST_TREES, &settings->trees, failure) ||
        !options_whole(arguments, "depth", 1, FOREST_MOST_DEPTH, &settings->depth, failure) ||
        !options_whole(arguments, "min-leaf", 1, 10000, &settings->min_leaf, failure) ||
        !options_whole(arguments, "bag", 2, 100000, &settings->bag, failure) ||
        !options_whole(arguments, "seed", 0, INT64_MAX, &seed, failure) ||
        !read_features(arguments, &settings->features, failure)) {
        return false;
    }
    settings->seed = (uint64_t)seed;
    return true;
}

static bool check_usage(const arguments_t *arguments, failure_t *failure)
{
    const char *out = options_value(arguments, "out"), *test = options_value(arguments, "test");
    const char *name = options_value(arguments, "name");
    if (arguments->operand_count != 1u) {
        return failure_usage(failure, "insole train-carry: expected one INDEX");
    }
    if (name != NULL && !pack_is_name(name)) {
        return failure_usage(failure,
                             "insole train-carry: --name %.40s: expected a letter, then letters, "
                             "digits and underscores, at most %d",
                             name, PACK_NAME_LENGTH);
    }
    if (out != NULL && (platform_is_same_file(out, arguments->operands[0]) ||
                        (test != NULL && platform_is_same_file(out, test)))) {
        return failure_usage(failure, "insole train-carry: --out %s would overwrite what is read",
                             out);
    }
    return true;
}

/* ---- held out --------------------------------------------------------------------------- */

static bool leave_out(training_t *training, const char *person, failure_t *failure)
{
    uint32_t number;
    if (!id_table_find(&training->windows.persons, person, &number)) {
        return failure_usage(failure, "insole train-carry: --leave-out %.40s: nobody of that name",
                             person);
    }
    for (size_t i = 0u; i < training->learnt; i++) {
        training->is_used[i] = training->is_used[i] && training->windows.logs[i].person != number;
    }
    return true;
}

static bool leave_all_out(training_t *training, const char *persons, failure_t *failure)
{
    char *copy = memory_text(persons), *rest = copy, *person;
    bool is_good = true;
    while (is_good && (person = fields_next(&rest)) != NULL) {
        is_good = leave_out(training, person, failure);
    }
    free(copy);
    return is_good;
}

/* What the forest says of the logs that it did not see, by each window and by two in a row. */
typedef struct {
    confusion_t single, twin;
} judgement_t;

static void judge(const training_t *training, const grown_t *grown, judgement_t *judgement)
{
    const carry_windows_t *windows = &training->windows;
    insole_carry_votes_t votes, before;
    const carry_row_t *last = NULL;
    memset(judgement, 0, sizeof *judgement);
    for (size_t i = 0u; i < windows->row_count; i++) {
        const carry_row_t *row = &windows->rows[i];
        if (row->variant != 0u || training->is_used[row->log] ||
            insole_carry_forest_vote(&grown->forest, &row->features, &votes) != INSOLE_OK) {
            continue;
        }
        int class_number = windows->logs[row->log].class_number, both = 0;
        judgement->single.count[class_number][votes.winner]++;
        if (last != NULL && last->log == row->log &&
            row->features.t_us - last->features.t_us <= CARRY_NEXT_US) {
            for (int k = 0; k < INSOLE_CARRY_CLASSES; k++) {
                insole_real_t sum = votes.share[k] + before.share[k];
                both = sum > votes.share[both] + before.share[both] ? k : both;
            }
            judgement->twin.count[class_number][both]++;
        }
        last = row;
        before = votes;
    }
}

static void use_index(training_t *training)
{
    for (size_t i = 0u; i < training->windows.log_count; i++) {
        training->is_used[i] = i < training->learnt;
    }
}

static void print(const training_t *training, const char *title, const confusion_t *confusion)
{
    fprintf(training->report, "%s\n", title);
    confusion_print(training->report, confusion,
                    (const char *const *)training->windows.classes.names.names,
                    training->windows.classes.names.count);
}

static void print_judgement(const training_t *training, const char *title,
                            const judgement_t *judgement)
{
    print(training, title, &judgement->single);
    fprintf(training->report, "  by two windows in a row: %.1f %% of %lu\n",
            100.0 * confusion_accuracy(&judgement->twin), confusion_total(&judgement->twin));
}

/* A forest without each person in turn, judged by that person. */
static bool judge_each(training_t *training, failure_t *failure)
{
    bool is_good = true;
    for (uint32_t p = 0u; p < training->windows.persons.count && is_good; p++) {
        char title[128];
        grown_t grown;
        judgement_t judgement;
        const char *person = training->windows.persons.names[p];
        use_index(training);
        is_good = leave_out(training, person, failure) &&
                  forest_grow(&grown, &training->windows, training->is_used, &training->settings,
                              NULL, failure);
        if (is_good) {
            judge(training, &grown, &judgement);
            snprintf(title, sizeof title, "Held out: %s", person);
            print_judgement(training, title, &judgement);
            forest_free(&grown);
        } else {
            failure_add(failure, " (without %s)", person);
        }
    }
    use_index(training);
    return is_good;
}

/* ---- forest ----------------------------------------------------------------------------- */

static void describe(const training_t *training, char *text, size_t room)
{
    const forest_settings_t *s = &training->settings;
    const char *classes = options_value(training->arguments, "classes");
    size_t used = 0u;
    for (size_t i = 0u; i < training->windows.log_count; i++) {
        used += training->is_used[i];
    }
    snprintf(text, room,
             "Made by `insole train-carry` from %lu logs: grow it again, do not change it.\n"
             " * --trees %d --depth %d --min-leaf %d --bag %d --features %s%s --seed %llu\n"
             " * Classes: %s.",
             (unsigned long)used, (int)s->trees, (int)s->depth, (int)s->min_leaf, (int)s->bag,
             name_of_features(s->features),
             options_has(training->arguments, "plain") ? " --plain" : "",
             (unsigned long long)s->seed, classes != NULL ? classes : "the positions");
}

static bool write_table(const training_t *training, const grown_t *grown, failure_t *failure)
{
    char head[1000];
    FILE *file;
    const char *path = options_value(training->arguments, "out");
    const char *name = options_value(training->arguments, "name");
    if (path == NULL) {
        return true;
    }
    if (!output_open(&file, path, failure)) {
        return false;
    }
    describe(training, head, sizeof head);
    for (char *end; (end = strstr(head, "*/")) != NULL;) {
        *end = '_';
    }
    forest_write(file, grown, name != NULL ? name : "carry", head);
    return output_close(file, path, failure);
}

static bool grow(training_t *training, failure_t *failure)
{
    grown_t grown;
    confusion_t out_of_bag;
    judgement_t held_out;
    if (!forest_grow(&grown, &training->windows, training->is_used, &training->settings,
                     &out_of_bag, failure)) {
        return false;
    }
    judge(training, &grown, &held_out);
    print(training, "Out of bag: other minutes of the same people, which flatters", &out_of_bag);
    if (confusion_total(&held_out.single) > 0u) {
        print_judgement(training, "Held out", &held_out);
    }
    fprintf(training->report, "%u trees, %lu nodes, %lu bytes\n", (unsigned)grown.forest.tree_count,
            (unsigned long)grown.node_count, (unsigned long)forest_bytes(&grown));
    bool is_good = write_table(training, &grown, failure);
    forest_free(&grown);
    return is_good;
}

static bool load(training_t *training, failure_t *failure)
{
    const arguments_t *a = training->arguments;
    const char *test = options_value(a, "test"), *unit = options_value(a, "accel-unit");
    if (!carry_windows_init(&training->windows, options_value(a, "classes"), failure) ||
        !carry_index_read(&training->index, a->operands[0], failure) ||
        !carry_windows_add(&training->windows, &training->index, !options_has(a, "plain"), unit,
                           failure)) {
        return false;
    }
    training->learnt = training->windows.log_count;
    if (test != NULL &&
        (!carry_index_read(&training->test, test, failure) ||
         !carry_windows_add(&training->windows, &training->test, false, unit, failure))) {
        return false;
    }
    training->is_used = memory_new(training->windows.log_count + 1u, sizeof *training->is_used);
    use_index(training);
    return settle_features(&training->windows, &training->settings.features, failure);
}

static void print_counts(const training_t *training)
{
    const carry_windows_t *w = &training->windows;
    fprintf(training->report,
            "%lu logs of %lu people; left out: %lu windows at rest, %lu bad samples, %lu logs in "
            "no class; features: %s\n",
            (unsigned long)w->log_count, (unsigned long)w->persons.count, w->still, w->refused,
            w->left_out, name_of_features(training->settings.features));
}

static bool train(training_t *training, failure_t *failure)
{
    const char *persons = options_value(training->arguments, "leave-out");
    if (!load(training, failure)) {
        return false;
    }
    print_counts(training);
    bool is_each = persons != NULL && strcmp(persons, "each") == 0;
    return (!is_each || judge_each(training, failure)) &&
           (persons == NULL || is_each || leave_all_out(training, persons, failure)) &&
           grow(training, failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    training_t training;
    const char *out = options_value(arguments, "out");
    memset(&training, 0, sizeof training);
    training.arguments = arguments;
    training.report = out != NULL && strcmp(out, "-") == 0 ? stderr : stdout;
    if (!check_usage(arguments, failure) ||
        !read_settings(arguments, &training.settings, failure)) {
        return false;
    }
    bool is_good = train(&training, failure);
    carry_windows_free(&training.windows);
    carry_index_free(&training.index);
    carry_index_free(&training.test);
    free(training.is_used);
    return is_good && output_flush(training.report, "-", failure);
}

static const option_t options[] = {
    {"out", "FILE", "write the table there, as C; - is standard output"},
    {"name", "NAME", "what the names of the table begin with; default carry"},
    {"classes", "LIST", "which positions are one class; default: each is"},
    {"leave-out", "PEOPLE", "judge by these, grow without them; each: everybody in turn"},
    {"test", "INDEX", "judge by the logs of another index"},
    {"trees", "N", "default 40"},
    {"depth", "N", "questions in a row, up to 7 (default)"},
    {"min-leaf", "N", "fewest windows on a side of a question; default 10"},
    {"bag", "N", "windows of each class that a tree sees; default 300"},
    {"features", "SET", "all, accel or paper (15); default: all that the logs give"},
    {"plain", NULL, "logs as they are, not as other people's as well"},
    {"accel-unit", "UNIT", "mps2 (default), g or mg"},
    {"seed", "N", "default 1"},
    {NULL, NULL, NULL}};

const command_t command_train_carry = {
    "train-carry",
    "INDEX [--out FILE.c]",
    "the forest that tells where a phone is carried, from labelled logs",
    "INDEX is a CSV with a header that names the columns file, person, position (others are\n"
    "passed over); files count from its folder. The logs need an accelerometer alone; where all "
    "have\n"
    "a gyroscope as well, the table asks about it, and is no use without one.\n"
    "\n"
    "  insole train-carry people.csv --leave-out each --out carry.c \\\n"
    "      --classes hand=hand+inhand,pocket=frontpocket+backpocket,bag=bag+purse\n"
    "\n"
    "A class may hold several positions; what no class names is left out. The table comes from\n"
    "the features that the library computes on the device, and gives the same answers there:\n"
    "\n"
    "  extern const insole_carry_forest_t carry_forest;\n"
    "\n"
    "Every window is also learned as somebody walks who is weaker, stronger, slower or faster.\n"
    "Windows at rest tell nothing and are left out. How good the forest is with people it has\n"
    "never seen, only people it has never seen can tell: use --leave-out or --test. Windows out\n"
    "of bag are of the same people and look better than that.\n",
    options,
    run};
