// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kappa::apps {
namespace {

/// In the child: the program with its streams in files. Does not return.
[[noreturn]] void execute(const Arguments& arguments, const std::string& out, const std::string& err) {
  const int out_file = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(out_file, STDOUT_FILENO);
  dup2(err_file, STDERR_FILENO);
  std::vector<std::string> words = {KAPPA_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(KAPPA_PROGRAM, argv.data());
  _exit(127);
}

/// What /proc tells about a process under a name such as "Threads:".
std::string process_status(pid_t process, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(name, 0) == 0) return line.substr(line.find_first_not_of(" \t", name.size()));
  }
  return "";
}

/// Until a window is open, the program has one thread or catches interrupts.
bool waits_for_its_user(pid_t program) {
  const unsigned long long caught = std::stoull("0" + process_status(program, "SigCgt:"), nullptr, 16);
  return (caught >> (SIGINT - 1) & 1) == 0 && std::stoi("0" + process_status(program, "Threads:")) > 1;
}

bool has_ended(pid_t program) {
  return process_status(program, "State:").rfind('Z', 0) == 0;
}

/// Runs the program; `meet` gets its process meanwhile.
Outcome run_and_meet(const Arguments& arguments, const std::function<void(pid_t)>& meet) {
  const Folder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) execute(arguments, out, err);
  meet(child);
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = contents(out);
  outcome.err = contents(err);
  return outcome;
}

}  // namespace

Outcome run_and_interrupt_window(const Arguments& arguments) {
  return run_and_meet(arguments, [](pid_t program) {
    while (!waits_for_its_user(program) && !has_ended(program))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(program, SIGINT);
  });
}

Outcome run(const Arguments& arguments, int interrupt_after) {
  return run_and_meet(arguments, [interrupt_after](pid_t program) {
    if (interrupt_after < 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after));
    kill(program, SIGINT);
  });
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "kappa-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string shared_file(const std::string& name) {
  const auto path = std::filesystem::path(KAPPA_SHARED_DATA) / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace kappa::apps
