/** @file board.h  What a board gives: four functions. Everything else is the same on all of them.
 *
 *  A board whose bytes come by interrupt is linked with main.c, any other with main_polled.c.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_BOARD_H
#define INSOLE_FIRMWARE_BOARD_H

/** Switches on the line, and its interrupt for received bytes (BOARD_INTERRUPT) in the peripheral,
 *  not in the core. */
void board_start(void);

/** The next byte received. With main.c -1 means that none is there; with main_polled.c it waits,
 *  and -1 means that none will come. */
int board_read(void);

/** Sends a byte, once there is room. */
void board_write(char byte);

/** Nothing is left to do: 0 all is well. */
void board_end(int code) __attribute__((noreturn));

#endif
