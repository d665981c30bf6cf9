// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "kappa/view/display.hpp"
#include "kappa/view/viewer.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

TEST(View, OpensAWindowAndStaysUntilItIsInterrupted) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--slices", "40", "--sides", "24"}).exit_code, 0);
  const VirtualDisplay display;
  const Outcome closed = run_and_interrupt_window({"view", f.file("t.ply"), "--radius", "0.4"});
  EXPECT_EQ(closed.exit_code, 128 + SIGINT) << closed.err;
  EXPECT_EQ(closed.err, "");
}

TEST(View, OpensAResult) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--slices", "40", "--sides", "24"}).exit_code, 0);
  ASSERT_EQ(run({"segment", f.file("t.ply"), f.file("r.ply"), "--radius", "0.4"}).exit_code, 0);
  const VirtualDisplay display;
  const Outcome closed = run_and_interrupt_window({"view", f.file("r.ply")});
  EXPECT_EQ(closed.exit_code, 128 + SIGINT) << closed.err;
  EXPECT_EQ(closed.err, "");
}

TEST(View, HelpListsTheKeys) {
  const Outcome help = run({"view", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find(viewer_keys()), std::string::npos) << help.out;
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
