# SPDX-License-Identifier: MIT
# What the toolchain files of all Cortex-M have in common; INSOLE_CORE and core_flags are theirs.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_C_FLAGS_INIT
  "${core_flags} -mthumb -mfloat-abi=hard -ffunction-sections -fdata-sections -fcallgraph-info=su,da")
set(CMAKE_C_FLAGS_RELEASE "-O2" CACHE STRING "")
