// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/core/execution.hpp"

namespace kappa {

/// Watches the stages of a pipeline as they run, one after the other: what a program shows a bar and a time for.
class StageWatch {
 public:
  virtual ~StageWatch() = default;

  /// Called before the stage `name` ("filter", "surface", "measures", "curvatures", "regions"). The stage runs with
  /// what is returned.
  virtual Execution begin(const std::string& name) = 0;
  /// Called when the stage has ended, also by an exception.
  virtual void end() {}
  /// Called with a sentence that a user should read, such as of heights in another unit than x and y.
  virtual void warn(const std::string& /*sentence*/) {}
};

/// Runs `body(execution)` as the stage `name` and returns what it returns.
template <class Body>
auto run_stage(StageWatch& watch, const std::string& name, Body&& body) {
  const Execution execution = watch.begin(name);
  struct Ender {
    StageWatch& watch;
    ~Ender() { watch.end(); }
  } ender{watch};
  return body(execution);
}

/// A watch that runs the first `stages` stages with equal shares of the progress of one execution.
class EvenStages final : public StageWatch {
 public:
  EvenStages(const Execution& run, int stages) : run_(run), stages_(stages) {}
  Execution begin(const std::string& name) override;

 private:
  const Execution& run_;
  int stages_, begun_ = 0;
};

}  // namespace kappa
