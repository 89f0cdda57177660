# SPDX-License-Identifier: MIT
# Cortex-M4F, bare metal; what is built runs under QEMU.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_C_FLAGS_INIT
  "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffunction-sections -fdata-sections -fcallgraph-info=su,da")
set(CMAKE_C_FLAGS_RELEASE "-O2" CACHE STRING "")
include(${CMAKE_CURRENT_LIST_DIR}/mps2_an386.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR ${INSOLE_QEMU})
