# SPDX-License-Identifier: MIT
# Runs an image of tools/firmware: the emulated board, told to let 2^6 ns pass per instruction; what
# the image writes comes out on standard output.
set(INSOLE_QEMU qemu-system-arm -machine mps2-an386 -display none -monitor none -serial none
  -chardev stdio,id=out -semihosting-config enable=on,target=native,chardev=out
  -icount shift=6 -kernel)
