// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kappa::apps {

/// What a run of the program left.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal if a signal ended it
  std::string out, err;
};

using Arguments = std::vector<std::string>;

/// Runs the program and sends it SIGINT as soon as it waits for its user in a window: it has threads of its own and no
/// longer catches interrupts. A program that ends before is not interrupted.
Outcome run_and_interrupt_window(const Arguments& arguments);

/// Runs the program to its end. With `interrupt_after` >= 0, sends it SIGINT that many milliseconds after its start.
Outcome run(const Arguments& arguments, int interrupt_after = -1);

/// A fresh folder, removed with all it holds.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string contents(const std::string& path);

/// A file of ../shared/data, empty if it is not there.
std::string shared_file(const std::string& name);

}  // namespace kappa::apps
