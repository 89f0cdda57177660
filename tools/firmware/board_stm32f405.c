/* SPDX-License-Identifier: MIT
 * USART 1 of an STM32F405 on its pins PA9 and PA10, one megabaud from the oscillator it wakes with.
 * Addresses and bits: the part's reference manual RM0090. */
#include <stdint.h>

#include "board.h"
#include "semihost.h"

typedef struct {
    volatile uint32_t status, data, baud, control1, control2, control3;
} usart_t;

#define USART1       ((usart_t *)0x40011000u)
#define RCC_AHB1ENR  (*(volatile uint32_t *)0x40023830u)
#define RCC_APB2ENR  (*(volatile uint32_t *)0x40023844u)
#define GPIOA_MODER  (*(volatile uint32_t *)0x40020000u)
#define GPIOA_AFRH   (*(volatile uint32_t *)0x40020024u)
#define GPIOA_CLOCK  (1u << 0)
#define USART1_CLOCK (1u << 4)

/* Pins 9 and 10: two bits of mode each, 2 for a peripheral's; four of function each, 7 for USART 1.
 */
#define MODES_MASK      (0xFu << 18)
#define MODES_USART     (0xAu << 18)
#define FUNCTIONS_MASK  (0xFFu << 4)
#define FUNCTIONS_USART (0x77u << 4)

enum { STATUS_RX = 1 << 5, STATUS_TX_EMPTY = 1 << 7 };
enum {
    CONTROL_RX = 1 << 2,
    CONTROL_TX = 1 << 3,
    CONTROL_RX_INTERRUPT = 1 << 5,
    CONTROL_ON = 1 << 13
};
enum { CLOCK_HZ = 16000000, BAUD = 1000000 };

void board_start(void)
{
    RCC_AHB1ENR |= GPIOA_CLOCK;
    RCC_APB2ENR |= USART1_CLOCK;
    GPIOA_MODER = (GPIOA_MODER & ~MODES_MASK) | MODES_USART;
    GPIOA_AFRH = (GPIOA_AFRH & ~FUNCTIONS_MASK) | FUNCTIONS_USART;
    USART1->baud = CLOCK_HZ / BAUD;
    USART1->control1 = CONTROL_ON | CONTROL_TX | CONTROL_RX | CONTROL_RX_INTERRUPT;
}

int board_read(void)
{
    return (USART1->status & STATUS_RX) != 0u ? (int)(USART1->data & 0xffu) : -1;
}

void board_write(char byte)
{
    while ((USART1->status & STATUS_TX_EMPTY) == 0u) {
    }
    USART1->data = (uint8_t)byte;
}

void board_end(int code)
{
    semihost_exit(code);
}
