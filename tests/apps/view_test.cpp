// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "kappa/view/display.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

TEST(View, OpensAWindowAndStaysUntilItIsInterrupted) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--slices", "40", "--sides", "24"}).exit_code, 0);
  const VirtualDisplay display;
  const Outcome closed = run({"view", f.file("t.ply"), "--radius", "0.4"}, 3000);
  EXPECT_EQ(closed.exit_code, 128 + SIGINT) << closed.err;
  EXPECT_EQ(closed.err, "");
}

TEST(View, SaysSoWithoutADisplay) {
  const Folder f;
  ASSERT_EQ(run({"generate", "sphere", f.file("s.ply")}).exit_code, 0);
  const char* display = std::getenv("DISPLAY");
  const std::string before = display ? display : "";
  unsetenv("DISPLAY");
  const Outcome failed = run({"view", f.file("s.ply")});
  if (display) setenv("DISPLAY", before.c_str(), 1);
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.err.find("display"), std::string::npos) << failed.err;
}

}  // namespace
}  // namespace kappa::apps
