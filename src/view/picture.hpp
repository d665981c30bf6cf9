// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/core/execution.hpp"

class vtkRenderWindow;

namespace kappa::view_detail {

/// Keeps VTK from printing while it lives. Whoever draws looks at the results and throws what went wrong.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int before_;
};

/// Call this before drawing. @throws Error FileWrite if no picture of that name can be written.
void check_picture_path(const std::string& path);

/// Writes what a window shows as a PNG, under a temporary name that is then renamed. Each pixel of the file is the
/// mean of `reduction` x `reduction` pixels of the window.
/// @throws Error FileWrite with the system's reason, Unavailable if the window has no picture; Cancelled, without a
/// file.
void write_picture(const std::string& path, vtkRenderWindow* window, int reduction, const Execution& run);

}  // namespace kappa::view_detail
