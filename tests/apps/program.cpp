#include "apps/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "folders.h"

namespace pdc::test {
namespace {

std::filesystem::path makeTemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "pdc_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  return name;
}

pid_t start(const Arguments& arguments, const std::string& out, const std::string& err) {
  std::string program = PDC_PROGRAM;
  Arguments copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t pid = 0;
  const int failure = ::posix_spawn(&pid, program.c_str(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) throw std::runtime_error("cannot run " + program);
  return pid;
}

/// Waits until the process catches SIGINT; before that the signal would end it like any other program.
void waitUntilInterruptible(pid_t pid) {
  constexpr unsigned long long kInterrupt = 1ull << (SIGINT - 1);
  for (int tries = 0; tries < 2000; ++tries) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) & kInterrupt) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() : mPath(makeTemporaryFolder()) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(mPath, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream(mPath / name, std::ios::binary) << content;
  return mPath / name;
}

std::vector<std::string> TemporaryFolder::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(mPath)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

Outcome runPdc(const Arguments& arguments, const RunOptions& options) {
  const TemporaryFolder captured;
  const std::string out = options.standardOutput.empty() ? (captured / "out").string() : options.standardOutput;
  const std::string err = options.standardError.empty() ? (captured / "err").string() : options.standardError;
  const pid_t pid = start(arguments, out, err);
  auto signalled = std::chrono::steady_clock::now();
  if (options.interruptAfter > 0) {
    waitUntilInterruptible(pid);
    std::this_thread::sleep_for(std::chrono::duration<double>(options.interruptAfter));
    signalled = std::chrono::steady_clock::now();
    ::kill(pid, SIGINT);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - signalled;
  return {.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = options.standardOutput.empty() ? readFile(out) : std::string(),
          .err = options.standardError.empty() ? readFile(err) : std::string(),
          .secondsAfterSignal = passed.count()};
}

void expectOneLineRefusal(const Outcome& outcome, int exitCode, const std::vector<std::string>& mentions) {
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("pdc: ", 0), 0U) << outcome.err;
  for (const std::string& text : mentions) EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
}

std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::filesystem::path bulletGrid() { return sourceFolder() / "tests/data/mpm_bullet.vdb"; }

}  // namespace pdc::test
