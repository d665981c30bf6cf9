// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/display.hpp"
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/view/figure.hpp"
#include "picture_reader.hpp"

namespace kappa {
namespace {

/// An environment variable that is restored at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) { value != nullptr ? setenv(name_, value, 1) : unsetenv(name_); }
  const char* name_;
  std::optional<std::string> old_;
};

Scan three_points() {
  Scan scan;
  scan.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  return scan;
}

TEST(VirtualDisplay, StartsAServerAndRestoresTheEnvironment) {
  const Variable none("DISPLAY", nullptr);
  EXPECT_FALSE(display_is_usable());
  {
    const VirtualDisplay display;
    EXPECT_TRUE(display.started());
    EXPECT_TRUE(display_is_usable());
    EXPECT_STREQ(display.name().c_str(), std::getenv("DISPLAY"));
    const VirtualDisplay second;
    EXPECT_FALSE(second.started());
    EXPECT_EQ(display.name(), second.name());
  }
  EXPECT_EQ(nullptr, std::getenv("DISPLAY"));
  // Its number may be that of another server by now.
  EXPECT_EQ(-1, waitpid(-1, nullptr, WNOHANG));
  EXPECT_EQ(ECHILD, errno) << "the server still runs";
}

TEST(VirtualDisplay, ReplacesADeadDisplay) {
  const Variable dead("DISPLAY", ":31999");
  {
    const VirtualDisplay display;
    EXPECT_TRUE(display.started());
    EXPECT_TRUE(display_is_usable());
  }
  EXPECT_STREQ(":31999", std::getenv("DISPLAY"));
}

TEST(VirtualDisplay, MissingXvfbIsNamedWithTheRemedy) {
  const Variable none("DISPLAY", nullptr);
  const Variable path("PATH", "/nonexistent");
  const test::TemporaryFolder folder;
  try {
    draw_scalar(folder / "x.png", three_points(), {1, 2, 3}, {});
    FAIL() << "drew without a display";
  } catch (const Error& error) {
    EXPECT_EQ(ErrorCode::Unavailable, error.code());
    EXPECT_NE(std::string::npos, std::string(error.what()).find("apt-get install xvfb")) << error.what();
  }
  EXPECT_EQ(0U, folder.file_count());
}

TEST(VirtualDisplay, AServerThatDoesNotStartIsAnError) {
  const test::TemporaryFolder folder;
  const std::string program = folder / "Xvfb";
  ASSERT_EQ(0, symlink("/bin/false", program.c_str()));
  const Variable none("DISPLAY", nullptr);
  const Variable path("PATH", program.substr(0, program.rfind('/')).c_str());
  EXPECT_THROW(VirtualDisplay(), Error);
  EXPECT_EQ(nullptr, std::getenv("DISPLAY"));
}

TEST(VirtualDisplay, TheServerEndsWithItsProcess) {
  const Variable none("DISPLAY", nullptr);
  // The server, an orphan when its parent has died, becomes a child of this process, which can wait for its end.
  ASSERT_EQ(0, prctl(PR_SET_CHILD_SUBREAPER, 1));
  int ends[2];
  ASSERT_EQ(0, pipe(ends));
  const pid_t child = fork();
  if (child == 0) {
    const VirtualDisplay display;
    const auto length = static_cast<ssize_t>(display.name().size());
    const bool told = write(ends[1], display.name().data(), display.name().size()) == length;
    raise(told ? SIGKILL : SIGTERM);
  }
  char name[32] = {};
  ASSERT_GT(read(ends[0], name, sizeof name - 1), 0);
  int status = 0;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(SIGKILL, WTERMSIG(status));
  EXPECT_GT(waitpid(-1, &status, 0), 0) << "the server had ended before";
  while (waitpid(-1, &status, 0) > 0) {  // what the server itself had started
  }
  EXPECT_EQ(ECHILD, errno);
  ASSERT_EQ(0, prctl(PR_SET_CHILD_SUBREAPER, 0));
}

}  // namespace
}  // namespace kappa
