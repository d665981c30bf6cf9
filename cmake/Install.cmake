# SPDX-License-Identifier: BSD-3-Clause
# The installed package: find_package(kappa COMPONENTS ...), one component a library that was built. What a component
# needs is read from its target, so that a layer cannot forget to say it here.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(kappa_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/kappa)

# Libraries that `component` links; those of the build alone stand in generator expressions and are left out.
function(kappa_links component out)
  get_target_property(links kappa_${component} LINK_LIBRARIES)
  if(NOT links)
    set(links "")
  endif()
  string(GENEX_STRIP "${links}" links)
  set(${out} ${links} PARENT_SCOPE)
endfunction()

# Names in `links` that match `pattern`, without `prefix`.
function(kappa_names_among links pattern prefix out)
  set(names ${links})
  list(FILTER names INCLUDE REGEX ${pattern})
  list(TRANSFORM names REPLACE ${prefix} "")
  list(REMOVE_DUPLICATES names)
  set(${out} ${names} PARENT_SCOPE)
endfunction()

# Lines of the package configuration that say what `component` needs.
function(kappa_needs component out)
  kappa_links(${component} links)
  kappa_names_among("${links}" "^kappa::" "^kappa::" kappa)
  kappa_names_among("${links}" "^VTK::" "^VTK::" vtk)
  kappa_names_among("${links}" "^pcl_[a-z_]+$" "^pcl_" pcl)
  kappa_names_among("${links}" "^ZLIB::" "::.*$" zlib)
  string(CONCAT lines
    "set(_kappa_${component}_kappa \"${kappa}\")\n"
    "set(_kappa_${component}_vtk \"${vtk}\")\n"
    "set(_kappa_${component}_pcl \"${pcl}\")\n"
    "set(_kappa_${component}_zlib \"${zlib}\")\n")
  set(${out} ${lines} PARENT_SCOPE)
endfunction()

function(kappa_install_component component)
  install(TARGETS kappa_${component} EXPORT kappa_${component}_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT kappa_${component}_targets NAMESPACE kappa:: FILE kappa-${component}-targets.cmake
    DESTINATION ${kappa_package_dir})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kappa/${component} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kappa
    FILES_MATCHING PATTERN "*.hpp")
endfunction()

# In the order in which they were made: each after those that it links.
get_property(kappa_components GLOBAL PROPERTY KAPPA_COMPONENTS)
set(KAPPA_COMPONENT_NEEDS "")
foreach(component ${kappa_components})
  kappa_install_component(${component})
  kappa_needs(${component} lines)
  string(APPEND KAPPA_COMPONENT_NEEDS "${lines}")
endforeach()

configure_package_config_file(cmake/kappaConfig.cmake.in kappaConfig.cmake INSTALL_DESTINATION ${kappa_package_dir})
write_basic_package_version_file(kappaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/kappaConfig.cmake ${PROJECT_BINARY_DIR}/kappaConfigVersion.cmake
  DESTINATION ${kappa_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
