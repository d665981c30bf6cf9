// SPDX-License-Identifier: BSD-3-Clause
#include "pace.hpp"

namespace kappa::io {

namespace {

constexpr std::chrono::milliseconds kBetweenReports(100);

void report(const Execution& run, double done) {
  if (run.progress) run.progress(done);
}

}  // namespace

Pace::Pace(const Execution& run, std::size_t total, std::size_t step)
    : run_(run), total_(total), step_(step), next_(step), last_report_() {}

void Pace::pause(std::size_t done) {
  next_ = done + step_;
  check_cancelled(run_);
  if (!run_.progress) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_report_ < kBetweenReports) return;
  last_report_ = now;
  run_.progress(static_cast<double>(std::min(done, total_)) / static_cast<double>(total_));
  check_cancelled(run_);
}

Execution part(const Execution& run, std::size_t k, std::size_t parts) {
  const auto count = static_cast<double>(parts);
  return stage(run, static_cast<double>(k) / count, static_cast<double>(k + 1) / count);
}

Execution silent(const Execution& run) {
  Execution quiet = run;
  quiet.progress = nullptr;
  return quiet;
}

void begin_progress(const Execution& run) {
  report(run, 0.0);
  check_cancelled(run);
}

void end_progress(const Execution& run) {
  report(run, 1.0);
}

}  // namespace kappa::io
