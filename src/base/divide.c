/* SPDX-License-Identifier: MIT */
#include "insole/base/divide.h"

uint64_t insole_divide(uint64_t number, uint32_t by)
{
    uint64_t quotient = 0u;
    uint32_t rest = 0u; /* below `by`: with the next byte it is below 2^32 */
    for (uint32_t bytes = 0u; bytes < 8u; bytes++) {
        uint32_t part = rest << 8 | (uint32_t)(number >> 56);
        quotient = quotient << 8 | part / by;
        rest = part % by;
        number <<= 8;
    }
    return quotient;
}
