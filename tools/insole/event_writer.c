/* SPDX-License-Identifier: MIT */
#include "event_writer.h"

#include "number.h"

void event_writer_head(FILE *file)
{
    fputs("event,begin,end,length,height,heading,turn,model_length\n", file);
}

static void write_number(FILE *file, double value, int decimals)
{
    char number[NUMBER_ROOM];
    fprintf(file, ",%s", number_fixed(number, value, decimals));
}

void event_writer_row(FILE *file, const event_t *event)
{
    char begin[NUMBER_ROOM], end[NUMBER_ROOM];
    fprintf(file, "%s,%s,%s", event_name(event->kind), number_time(begin, event->begin_us),
            number_time(end, event->end_us));
    if (event->kind == EVENT_STRIDE) {
        write_number(file, event->length_m, 4);
        write_number(file, event->height_m, 4);
        write_number(file, event->heading_rad, 5);
        write_number(file, event->turn_rad, 5);
        write_number(file, event->model_length_m, 4);
    } else if (event->kind == EVENT_STEP) {
        write_number(file, event->length_m, 4);
        fputc(',', file);
        write_number(file, event->heading_rad, 5);
        fputs(",,", file);
    } else {
        fputs(",,,,,", file);
    }
    putc('\n', file);
}
