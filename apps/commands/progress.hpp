// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "kappa/pipeline/stages.hpp"

namespace kappa::app {

/// From now on Ctrl-C cancels what runs, once; a second time it ends the program.
void catch_interrupts();

/// Raised by Ctrl-C.
const std::atomic<bool>& interrupted();

/// Wipes the bar, if one is shown.
void clear_progress();

/// Says `warning` on the standard error, if it is not empty.
void warn_user(const std::string& warning);

/// Times the stages of a command, shows a bar for each on a terminal, and cancels them on Ctrl-C.
class Stages final : public StageWatch {
 public:
  struct Timed {
    std::string name;
    double seconds;
  };

  /// `quiet`: never a bar, never a warning. `threads` as in Execution.
  Stages(int threads, bool quiet);

  Execution begin(const std::string& name) override;
  void end() override;
  void warn(const std::string& sentence) override;

  /// Runs `body(execution)` as the stage `name` and returns what it returns.
  template <class Body>
  auto run(const std::string& name, Body&& body) {
    return run_stage(*this, name, std::forward<Body>(body));
  }

  const std::vector<Timed>& timed() const { return timed_; }

 private:
  int threads_;
  bool quiet_, bar_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
  std::vector<Timed> timed_;
};

}  // namespace kappa::app
