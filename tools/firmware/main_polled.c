/* SPDX-License-Identifier: MIT
 * The same device without interrupts: at a desk, and on a chip whose bytes come from a debugger. */
#include "board.h"
#include "device.h"

static wire_t wire;

/* Nothing is reset, but the state goes the same way. */
static device_answer_t restart(void)
{
    if (!device_save()) {
        return DEVICE_ENDS;
    }
    device_start(0u);
    return DEVICE_GOES_ON;
}

int main(void)
{
    device_answer_t answer = DEVICE_GOES_ON;
    int byte = 0;
    board_start();
    device_start(0u);
    while (answer != DEVICE_ENDS && (byte = board_read()) >= 0) {
        if (wire_push(&wire, (uint8_t)byte)) {
            answer = device_take(&wire.frame);
            answer = answer == DEVICE_RESETS ? restart() : answer;
        }
    }
    int code = device_end(wire.bad, 0u);
    board_end(answer == DEVICE_ENDS ? code : 1);
}
