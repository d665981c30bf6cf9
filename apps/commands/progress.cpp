// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <csignal>
#include <cstdio>

#include <unistd.h>

namespace kappa::app {
namespace {

std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
std::atomic<bool> g_bar_shown{false};

void on_interrupt(int) {
  g_interrupted.store(true);
  std::signal(SIGINT, SIG_DFL);
}

void draw_bar(const std::string& name, double done) {
  constexpr int kWidth = 40;
  const int filled = static_cast<int>(done * kWidth);
  std::fprintf(stderr, "\r\033[K%-12s [%.*s%*s] %3.0f %%", name.c_str(), filled,
               "########################################", kWidth - filled, "", done * 100);
  std::fflush(stderr);
  g_bar_shown.store(true);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
}

const std::atomic<bool>& interrupted() {
  return g_interrupted;
}

void clear_progress() {
  if (g_bar_shown.exchange(false)) std::fputs("\r\033[K", stderr);
}

void warn_user(const std::string& warning) {
  if (warning.empty()) return;
  clear_progress();
  std::fprintf(stderr, "kappa: warning: %s\n", warning.c_str());
}

Stages::Stages(int threads, bool quiet)
    : threads_(threads), quiet_(quiet), bar_(!quiet && isatty(STDERR_FILENO) == 1) {}

Execution Stages::begin(const std::string& name) {
  name_ = name;
  start_ = std::chrono::steady_clock::now();
  Execution execution;
  execution.threads = threads_;
  execution.cancel = &g_interrupted;
  if (bar_) execution.progress = [name](double done) { draw_bar(name, done); };
  return execution;
}

void Stages::end() {
  clear_progress();
  timed_.push_back({name_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count()});
}

void Stages::warn(const std::string& sentence) {
  if (!quiet_) warn_user(sentence);
}

}  // namespace kappa::app
