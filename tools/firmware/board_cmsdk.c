/* SPDX-License-Identifier: MIT
 * UART 0 of Arm's MPS2 boards, at BOARD_UART. */
#include <stdint.h>

#include "board.h"
#include "semihost.h"

typedef struct {
    volatile uint32_t data, state, control, interrupt, divider;
} uart_t;

#define UART ((uart_t *)BOARD_UART)

enum { STATE_TX_FULL = 1, STATE_RX_FULL = 2 };
enum { CONTROL_TX = 1, CONTROL_RX = 2, CONTROL_RX_INTERRUPT = 8 };
enum { INTERRUPT_RX = 2 };
enum { CLOCK_HZ = 25000000, BAUD = 921600 };

void board_start(void)
{
    UART->divider = CLOCK_HZ / BAUD;
    UART->control = CONTROL_TX | CONTROL_RX | CONTROL_RX_INTERRUPT;
}

int board_read(void)
{
    UART->interrupt = INTERRUPT_RX;
    return (UART->state & STATE_RX_FULL) != 0u ? (int)(UART->data & 0xffu) : -1;
}

void board_write(char byte)
{
    while ((UART->state & STATE_TX_FULL) != 0u) {
    }
    UART->data = (uint8_t)byte;
}

void board_end(int code)
{
    semihost_exit(code);
}
