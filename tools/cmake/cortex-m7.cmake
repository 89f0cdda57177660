# SPDX-License-Identifier: MIT
# Cortex-M7 with floating point of single precision, bare metal.
set(INSOLE_CORE m7)
set(core_flags "-mcpu=cortex-m7 -mfpu=fpv5-sp-d16")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
