# SPDX-License-Identifier: MIT
# Cortex-M4F, bare metal; what is built runs under QEMU's mps2-an386 with a clock that counts
# instructions (one takes 2^6 ns of virtual time).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_C_FLAGS_INIT
  "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffunction-sections -fdata-sections -fcallgraph-info=su,da")
set(CMAKE_C_FLAGS_RELEASE "-O2" CACHE STRING "")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-system-arm -machine mps2-an386 -nographic -monitor none
  -serial none -semihosting-config enable=on,target=native -icount shift=6 -kernel)
