# SPDX-License-Identifier: BSD-3-Clause
# Every package the build uses, found once, only for the layers that are built.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

if(kappa_top_level)
  find_program(KAPPA_CCACHE ccache)
  if(KAPPA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${KAPPA_CCACHE})
  endif()
endif()

if(KAPPA_SEARCH)
  find_path(KAPPA_FLANN_INCLUDE_DIR flann/flann.hpp REQUIRED)
  find_library(KAPPA_LZ4_LIBRARY lz4 REQUIRED)
endif()

if(KAPPA_IO)
  find_package(ZLIB REQUIRED)
endif()

if(KAPPA_VIEW OR (KAPPA_IO AND KAPPA_TESTS))
  # One look-up for both layers: asking for different components twice in one project fails in VTK 9.1.
  find_package(VTK 9.1 QUIET REQUIRED COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersGeneral FiltersSources IOCore IOXML
    IOImage InteractionStyle InteractionWidgets RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2
    RenderingUI)
endif()

if(KAPPA_PCL OR (KAPPA_IO AND KAPPA_TESTS))
  # Components features and io would pull all of VTK into CMake; their libraries are linked by name.
  find_package(PCL 1.13 QUIET REQUIRED COMPONENTS common kdtree octree search sample_consensus filters)
  find_library(KAPPA_PCL_FEATURES_LIBRARY pcl_features REQUIRED)
  find_library(KAPPA_PCL_IO_LIBRARY pcl_io REQUIRED)
endif()

if(KAPPA_TESTS)
  find_package(GTest REQUIRED)
endif()
if(KAPPA_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()

if(KAPPA_APPS)
  find_path(KAPPA_CLI11_INCLUDE_DIR CLI/CLI.hpp REQUIRED)
endif()
