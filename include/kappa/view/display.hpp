// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace kappa {

/// Whether the X server that the environment variable `DISPLAY` names answers and can draw (has the extension GLX).
/// False if `DISPLAY` is not set.
bool display_is_usable();

/// Provides an X server to draw on for as long as the object lives.
///
/// If `DISPLAY` names a usable server, the object does nothing. Otherwise it starts Xvfb on a free number and sets
/// `DISPLAY` to that. The destructor ends the server and restores `DISPLAY`. The server also ends when the thread that
/// made the object ends.
///
/// Constructor and destructor change the environment: call them while no other thread reads it. To draw several figures
/// on one server, hold an object around them.
class VirtualDisplay {
 public:
  /// @throws Error Unavailable if a server is needed and Xvfb is not installed, ends at once, or is not ready after 30
  /// seconds.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Whether this object started a server.
  bool started() const { return server_ > 0; }
  /// Name of the display that is drawn on, such as ":99".
  const std::string& name() const { return name_; }

 private:
  int server_ = 0;  // process id
  std::string name_;
  bool had_display_ = false;
  std::string old_display_;
};

}  // namespace kappa
