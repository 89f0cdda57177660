# SPDX-License-Identifier: MIT
# Cortex-M4F, bare metal; what is built runs under QEMU.
set(INSOLE_CORE m4)
set(core_flags "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/mps2_an386.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR ${INSOLE_QEMU})
