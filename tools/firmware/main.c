/* SPDX-License-Identifier: MIT
 * The image of a device: frames are put together in the interrupt and worked in by the main loop.
 */
#include "board.h"
#include "core.h"
#include "device.h"
#include "insole/base/ring.h"
#include "startup.h"

enum { FRAMES = 8 /* that can wait */ };

static wire_t wire;
static wire_frame_t frames[FRAMES];
static insole_ring_t ring;

/* While no frame more can wait the line has to: what a sender says that does not wait is lost, and
 * the check of the frame tells. */
void startup_interrupt(void)
{
    int byte = 0;
    while (!insole_ring_is_full(&ring) && (byte = board_read()) >= 0) {
        if (wire_push(&wire, (uint8_t)byte)) {
            frames[insole_ring_push(&ring)] = wire.frame;
        }
    }
    if (byte >= 0) {
        core_interrupt_off(BOARD_INTERRUPT);
    }
}

/* Asleep until a frame waits. */
static const wire_frame_t *oldest(void)
{
    core_mask();
    while (insole_ring_count(&ring) == 0u) {
        core_sleep();
        core_unmask();
        core_mask();
    }
    core_unmask();
    return &frames[insole_ring_slot(&ring, ring.begin)];
}

static void let_go(void)
{
    core_mask();
    insole_ring_pop(&ring);
    core_unmask();
    core_interrupt_on(BOARD_INTERRUPT);
}

static device_answer_t run(void)
{
    device_answer_t answer = DEVICE_GOES_ON;
    while (answer == DEVICE_GOES_ON) {
        answer = device_take(oldest());
        let_go();
    }
    return answer;
}

int main(void)
{
    ring = insole_ring(FRAMES);
    board_start();
    device_start(core_image());
    core_interrupt_on(BOARD_INTERRUPT);
    if (run() == DEVICE_RESETS && device_save()) {
        core_reset();
    }
    board_end(device_end(wire.bad, core_stack_used()));
}
