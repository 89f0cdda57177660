# SPDX-License-Identifier: MIT
# Cortex-M33 with floating point, bare metal, in the secure world.
set(INSOLE_CORE m33)
set(core_flags "-mcpu=cortex-m33 -mfpu=fpv5-sp-d16")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
