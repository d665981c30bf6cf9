# SPDX-License-Identifier: BSD-3-Clause
# Run by ctest, see CMakeLists.txt for the variables.
cmake_minimum_required(VERSION 3.20)

set(prefix ${WORK_DIR}/prefix)

# run(<what> COMMAND...) ends the test if the command fails.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result}):\n${output}")
  endif()
  message(STATUS "${what}: ok")
endfunction()

function(configure_command folder binary out)
  set(${out} ${CMAKE_COMMAND} -S ${SOURCE_DIR}/${folder} -B ${binary} -G ${GENERATOR}
    -D CMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} -D CMAKE_C_COMPILER=${C_COMPILER} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
    -D "CMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER}" -D "CMAKE_CXX_FLAGS=${CXX_FLAGS}"
    -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D kappa_ROOT=${prefix} ${ARGN} PARENT_SCOPE)
endfunction()

function(try_consumer name)
  set(binary ${WORK_DIR}/${name})
  configure_command(${name} ${binary} configure)
  run("configure ${name}" ${configure})
  run("build ${name}" ${CMAKE_COMMAND} --build ${binary} --config ${BUILD_TYPE})
  run("run ${name}" ${binary}/${name})
endfunction()

# Configures a project that calls find_package(kappa <arguments>): REFUSED or FOUND, with `message` in the output.
function(try_request label arguments verdict message)
  configure_command(request ${WORK_DIR}/request_${label} configure -D "ARGUMENTS=${arguments}" ${ARGN})
  execute_process(COMMAND ${configure} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if((verdict STREQUAL FOUND) AND NOT (result EQUAL 0))
    message(FATAL_ERROR "request ${label} was refused:\n${output}")
  elseif((verdict STREQUAL REFUSED) AND (result EQUAL 0))
    message(FATAL_ERROR "request ${label} was not refused:\n${output}")
  elseif(NOT output MATCHES "${message}")
    message(FATAL_ERROR "request ${label} does not say \"${message}\":\n${output}")
  endif()
  message(STATUS "request ${label}: ok")
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
# Moved after the installation: the package must not remember where it was put.
run("install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${BUILD_TYPE} --prefix ${WORK_DIR}/staging)
file(RENAME ${WORK_DIR}/staging ${prefix})

foreach(consumer ${CONSUMERS})
  try_consumer(${consumer})
endforeach()

try_request(unknown "REQUIRED COMPONENTS core nosuch" REFUSED "There is no component nosuch, installed are: core")
try_request(optional "REQUIRED COMPONENTS core OPTIONAL_COMPONENTS nosuch" FOUND "has core.*lacks nosuch")
try_request(version "99 REQUIRED COMPONENTS core" REFUSED "compatible with requested version \"99\"")
try_request(everything "REQUIRED" FOUND "has core" -D "LANGUAGES=C CXX")

set(without_pcl -D CMAKE_DISABLE_FIND_PACKAGE_PCL=ON)
if(pcl IN_LIST COMPONENTS)
  try_request(pcl_missing "REQUIRED COMPONENTS pcl" REFUSED "Component pcl needs PCL 1.13 with" ${without_pcl})
  try_request(pcl_left_out "REQUIRED" FOUND "has core.*has search.*lacks pcl" ${without_pcl})
endif()
foreach(component io view)
  if(component IN_LIST COMPONENTS)
    try_request(${component} "REQUIRED COMPONENTS ${component}" FOUND "has ${component}" -D "LANGUAGES=C CXX")
  endif()
endforeach()
if(view IN_LIST COMPONENTS)
  try_request(view_in_cxx "REQUIRED COMPONENTS view" REFUSED "needs the language C")
endif()
