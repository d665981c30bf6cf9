# SPDX-License-Identifier: BSD-3-Clause

# Warnings of our own code; headers of other projects are SYSTEM.
add_library(kappa_warnings INTERFACE)
target_compile_options(kappa_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual -Wunused -Woverloaded-virtual
  -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough $<$<BOOL:${KAPPA_WERROR}>:-Werror>)

# kappa_add_library(<component> SOURCES ...) makes the library kappa_<component>, alias kappa::<component>.
function(kappa_add_library component)
  cmake_parse_arguments(arg "" "" "SOURCES" ${ARGN})
  add_library(kappa_${component} ${arg_SOURCES})
  add_library(kappa::${component} ALIAS kappa_${component})
  target_compile_features(kappa_${component} PUBLIC cxx_std_17)
  target_include_directories(kappa_${component} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(kappa_${component} PRIVATE $<BUILD_INTERFACE:kappa_warnings>)
  # Contracted products would make results depend on the compiler and the machine.
  target_compile_options(kappa_${component} PRIVATE -ffp-contract=off)
  set_target_properties(kappa_${component} PROPERTIES
    EXPORT_NAME ${component} POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
  set_property(GLOBAL APPEND PROPERTY KAPPA_COMPONENTS ${component})
endfunction()

# kappa_add_test(<name> SOURCES ... LIBRARIES ...) makes a GoogleTest program and registers it with ctest as one test.
function(kappa_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} kappa_warnings GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE KAPPA_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
  set_target_properties(${name} PROPERTIES CXX_STANDARD 17 CXX_EXTENSIONS OFF)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 900)
endfunction()
