// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkRenderWindow;

namespace kappa::view_detail {

/// Keeps VTK from printing while it lives: what goes wrong is found by looking at the results and thrown.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int before_;
};

/// @throws Error FileWrite if a file of that name cannot be made: to be called before drawing.
void check_picture_path(const std::string& path);

/// Writes what a window shows as a PNG, under a temporary name that is then renamed. Each pixel of the file is the
/// mean of `reduction` x `reduction` pixels of the window.
/// @throws Error FileWrite with the system's reason, Unavailable if the window has no picture.
void write_picture(const std::string& path, vtkRenderWindow* window, int reduction);

}  // namespace kappa::view_detail
