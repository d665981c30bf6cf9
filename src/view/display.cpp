// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/display.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

constexpr const char* kRemedy = "install it with 'apt-get install xvfb', or set DISPLAY to a running X server";
constexpr int kStartTimeout = 30000;  // milliseconds; a busy machine takes a second

/// Asks the server through Xlib itself: only that covers sockets, hosts and permissions as VTK will meet them. Xlib
/// is loaded at run time, VTK brings it anyway.
bool server_answers(const char* name) {
  void* xlib = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  if (xlib == nullptr) return false;
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  using QueryExtension = int (*)(void*, const char*, int*, int*, int*);
  const auto open = reinterpret_cast<Open>(dlsym(xlib, "XOpenDisplay"));
  const auto close = reinterpret_cast<Close>(dlsym(xlib, "XCloseDisplay"));
  const auto query = reinterpret_cast<QueryExtension>(dlsym(xlib, "XQueryExtension"));
  bool usable = false;
  void* display = open != nullptr && close != nullptr && query != nullptr ? open(name) : nullptr;
  if (display != nullptr) {
    int opcode = 0, event = 0, error = 0;
    usable = query(display, "GLX", &opcode, &event, &error) != 0;
    close(display);
  }
  dlclose(xlib);
  return usable;
}

/// Path of an executable program, looked up in PATH; empty if there is none.
std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + name;
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

/// Runs in the child between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void become_server(const char* program, char* const* arguments, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nowhere = open("/dev/null", O_RDWR);
  // The parent may have died before prctl. The server's own chatter is of no use to a user.
  if (getppid() == parent && nowhere >= 0 && dup2(nowhere, 0) >= 0 && dup2(nowhere, 1) >= 0 && dup2(nowhere, 2) >= 0) {
    // A group of its own, so that Ctrl-C at the terminal does not kill it under our feet.
    setpgid(0, 0);
    execv(program, arguments);
  }
  _exit(127);
}

/// Starts Xvfb, which writes the number of its display to `number_pipe` when it is ready.
pid_t start_server(const std::string& program, int number_pipe) {
  std::vector<std::string> words = {program,     "-displayfd", std::to_string(number_pipe),
                                    "-screen",   "0",          "1600x1200x24",
                                    "-nolisten", "tcp",        "-noreset"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become_server(program.c_str(), arguments.data(), parent);
  return child;
}

/// The line the server writes; empty if it ended or took too long.
std::string read_line(int pipe) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(kStartTimeout);
  std::string line;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{pipe, POLLIN, 0};
    const int ready = left > 0 ? poll(&wait, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char c = 0;
    if (ready <= 0 || read(pipe, &c, 1) != 1) return {};
    if (c == '\n') return line;
    line += c;
  }
}

void stop_server(pid_t server) {
  kill(server, SIGTERM);
  while (waitpid(server, nullptr, 0) < 0 && errno == EINTR) {
  }
}

[[noreturn]] void no_display(const std::string& reason) {
  throw Error(ErrorCode::Unavailable, "drawing needs an X display: " + reason + "; " + kRemedy);
}

}  // namespace

bool display_is_usable() {
  const char* name = std::getenv("DISPLAY");
  return name != nullptr && *name != '\0' && server_answers(name);
}

VirtualDisplay::VirtualDisplay() {
  if (const char* old = std::getenv("DISPLAY")) {
    had_display_ = true;
    old_display_ = old;
  }
  if (display_is_usable()) {
    name_ = old_display_;
    return;
  }
  const std::string reason = old_display_.empty()
                                 ? "DISPLAY is not set"
                                 : "DISPLAY is '" + old_display_ + "', which does not answer or lacks GLX";
  const std::string program = find_program("Xvfb");
  if (program.empty()) no_display(reason + ", and Xvfb is not installed");
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) no_display(reason + ", and no pipe could be made (" + std::strerror(errno) + ")");
  const int inherited = dup(ends[1]);  // without O_CLOEXEC
  const pid_t server = start_server(program, inherited);
  close(ends[1]);
  close(inherited);
  const std::string number = server > 0 ? read_line(ends[0]) : std::string();
  close(ends[0]);
  if (number.empty()) {
    if (server > 0) stop_server(server);
    no_display(reason + ", and " + program + " did not start");
  }
  server_ = server;
  name_ = ":" + number;
  setenv("DISPLAY", name_.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (!started()) return;
  stop_server(server_);
  if (had_display_) {
    setenv("DISPLAY", old_display_.c_str(), 1);
  } else {
    unsetenv("DISPLAY");
  }
}

}  // namespace kappa
