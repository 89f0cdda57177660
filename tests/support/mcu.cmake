# SPDX-License-Identifier: MIT
# The tests mcu.build_CORE: library, bench and images of devices for a Cortex-M. What looks at the
# results needs the fixture mcu_CORE and finds them in INSOLE_MCU_BUILD_CORE, which is not set where
# the compiler is missing; those of the Cortex-M4F, for gates and bench, also by the names `mcu` and
# INSOLE_MCU_BUILD.
find_program(INSOLE_MCU_COMPILER arm-none-eabi-gcc)
find_package(Python3 COMPONENTS Interpreter)

# Images have the tables of a building, which mcu/ lets the program make, and compute in float. It is
# simulated, which takes a minute in builds that look after themselves.
set(INSOLE_MCU_SITE "")
if(TARGET insole_program AND TARGET insole_sim AND Python3_FOUND AND NOT INSOLE_DOUBLE
   AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(INSOLE_MCU_SITE ${PROJECT_BINARY_DIR}/mcu/site.c)
endif()

function(insole_mcu_build core) # FIXTURES... [OPTIONS ...]
  cmake_parse_arguments(PARSE_ARGV 1 mcu "" "" "FIXTURES;OPTIONS")
  set(name mcu.build_${core})
  if(INSOLE_MCU_COMPILER)
    set(build ${PROJECT_BINARY_DIR}/${core})
    set(INSOLE_MCU_BUILD_${core} ${build} PARENT_SCOPE)
    add_test(NAME ${name} COMMAND ${CMAKE_CTEST_COMMAND}
      --build-and-test ${PROJECT_SOURCE_DIR} ${build}
      --build-generator ${CMAKE_GENERATOR} --build-noclean
      --build-options -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/tools/cmake/cortex-${core}.cmake
        -DINSOLE_FIRMWARE_SITE=${INSOLE_MCU_SITE} ${mcu_OPTIONS})
    set_tests_properties(${name} PROPERTIES FIXTURES_SETUP "${mcu_FIXTURES}" TIMEOUT 900)
  else()
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo
      "SKIPPED: arm-none-eabi-gcc is not installed, nothing is tried on a Cortex-M")
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION SKIPPED)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS mcu)
endfunction()

insole_mcu_build(m4 FIXTURES mcu mcu_m4)
set(INSOLE_MCU_BUILD ${INSOLE_MCU_BUILD_m4})
if(INSOLE_MCU_SITE)
  insole_mcu_build(m7 FIXTURES mcu_m7 OPTIONS -DINSOLE_BUILD_TESTS=OFF)
  insole_mcu_build(m33 FIXTURES mcu_m33 OPTIONS -DINSOLE_BUILD_TESTS=OFF)
endif()
