// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "kappa/core/execution.hpp"

namespace kappa::app {

/// From now on Ctrl-C cancels what runs, once; a second time it ends the program.
void catch_interrupts();

/// Raised by Ctrl-C.
const std::atomic<bool>& interrupted();

/// Wipes the bar, if one is shown.
void clear_progress();

/// Says `warning` on the standard error, if it is not empty.
void warn(const std::string& warning);

/// Times the stages of a command and shows a bar for each on a terminal.
class Stages {
 public:
  struct Timed {
    std::string name;
    double seconds;
  };

  /// `quiet`: never a bar. `threads` and `seed` as in Execution.
  Stages(int threads, std::uint64_t seed, bool quiet);

  /// Runs `body(execution)` as the stage `name` and returns what it returns.
  template <class Body>
  auto run(const std::string& name, Body&& body) {
    const Execution execution = begin(name);
    struct Ender {
      Stages& stages;
      ~Ender() { stages.end(); }
    } ender{*this};
    return body(execution);
  }

  const std::vector<Timed>& timed() const { return timed_; }

 private:
  Execution begin(const std::string& name);
  void end();

  int threads_;
  std::uint64_t seed_;
  bool bar_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
  std::vector<Timed> timed_;
};

}  // namespace kappa::app
