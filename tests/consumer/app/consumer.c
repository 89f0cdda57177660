/* SPDX-License-Identifier: MIT
 * A stranger's program: valid C99 and C++11. */
#include <insole/insole.h>

#include <stdio.h>
#include <string.h>

static int check(int holds, const char *what)
{
    if (!holds) {
        printf("wrong: %s\n", what);
    }
    return !holds;
}

int main(void)
{
    const insole_real_t yaw_rad = INSOLE_R(0.5);
    insole_quat_t q = insole_quat_from_yaw(yaw_rad);
    insole_real_t error_rad = insole_abs(insole_quat_yaw(q) - yaw_rad);
    int wrong = 0;
    wrong += check(strcmp(INSOLE_VERSION, PACKAGE_VERSION) == 0, "version of package and header");
    wrong += check(strcmp(insole_status_text(INSOLE_OK), "ok") == 0, "text of a status");
    wrong += check(error_rad < INSOLE_R(1e-6), "yaw there and back");
    return wrong;
}
