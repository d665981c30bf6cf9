// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"

/// Extensions of files in one line, for the help.
namespace kappa::app {

inline std::string readable() {
  return CLI::detail::join(readable_extensions(), " ");
}

inline std::string writable() {
  return CLI::detail::join(writable_extensions(), " ");
}

/// Those that keep faces.
inline std::string writable_meshes() {
  return CLI::detail::join(writable_mesh_extensions(), " ");
}

}  // namespace kappa::app
