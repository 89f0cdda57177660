# SPDX-License-Identifier: MIT
# The test mcu.build: library and bench for a Cortex-M4F. What looks at the result needs the fixture
# `mcu` and finds it in INSOLE_MCU_BUILD, which is not set where the compiler is missing.
find_program(INSOLE_MCU_COMPILER arm-none-eabi-gcc)
if(INSOLE_MCU_COMPILER)
  set(INSOLE_MCU_BUILD ${PROJECT_BINARY_DIR}/m4)
  add_test(NAME mcu.build COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${PROJECT_SOURCE_DIR} ${INSOLE_MCU_BUILD}
    --build-generator ${CMAKE_GENERATOR} --build-noclean
    --build-options -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/tools/cmake/cortex-m4.cmake)
  set_tests_properties(mcu.build PROPERTIES FIXTURES_SETUP mcu)
else()
  add_test(NAME mcu.build COMMAND ${CMAKE_COMMAND} -E echo
    "SKIPPED: arm-none-eabi-gcc is not installed, nothing is tried on a Cortex-M")
  set_tests_properties(mcu.build PROPERTIES SKIP_REGULAR_EXPRESSION SKIPPED)
endif()
set_tests_properties(mcu.build PROPERTIES LABELS mcu)
