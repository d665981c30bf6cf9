// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace kappa {

/// True if the X server that `DISPLAY` names answers and can draw (has GLX). False if `DISPLAY` is not set.
bool display_is_usable();

/// Sees to it that there is an X server to draw on for as long as the object lives.
///
/// If `DISPLAY` names a usable server, nothing is done; else Xvfb is started on a free number and `DISPLAY` set to
/// it. The destructor ends that server and restores `DISPLAY`; the server also ends with the thread that started it.
/// Changes the environment: to be made while no other thread reads it. Hold one around several figures to start
/// one server for all.
class VirtualDisplay {
 public:
  /// @throws Error Unavailable if a server is needed and Xvfb is not installed or does not start.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Whether this object started a server.
  bool started() const { return server_ > 0; }
  /// Name of the display, such as ":99".
  const std::string& name() const { return name_; }

 private:
  int server_ = 0;  // process id
  std::string name_;
  bool had_display_ = false;
  std::string old_display_;
};

}  // namespace kappa
