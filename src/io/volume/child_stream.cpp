#include "io/volume/child_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <utility>

#include "io/file/file_error.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// \returns false if nobody reads any more, or writing fails otherwise.
bool writeAll(int descriptor, const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t n = ::write(descriptor, data, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

/// Fills as much as there is.
std::size_t readAll(int descriptor, std::span<char> to) {
  std::size_t done = 0;
  while (done < to.size()) {
    const ssize_t n = ::read(descriptor, to.data() + done, to.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

[[noreturn]] void runChild(int data, int message, const std::function<void(ChildOutput&)>& work) {
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
  // Handlers of the parent would print, or remove the parent's files.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
    ::signal(signal, SIG_DFL);
  ::signal(SIGPIPE, SIG_DFL);
  try {
    ChildOutput out(data);
    work(out);
  } catch (const std::exception& error) {
    writeAll(message, error.what(), std::strlen(error.what()));
    ::_exit(1);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

}  // namespace

void ChildOutput::write(const void* data, std::size_t bytes) {
  if (!writeAll(mDescriptor, static_cast<const char*>(data), bytes)) ::_exit(0);
}

ChildStream::ChildStream(std::string what, const std::function<void(ChildOutput&)>& work) : mWhat(std::move(what)) {
  std::array<int, 2> data{-1, -1}, message{-1, -1};
  if (::pipe2(data.data(), O_CLOEXEC) != 0) throw systemError("no pipe", errno);
  if (::pipe2(message.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    for (const int end : data) ::close(end);
    throw systemError("no pipe", error);
  }
  mChild = ::fork();
  if (mChild == 0) runChild(data[1], message[1], work);
  const int error = errno;
  ::close(data[1]);
  ::close(message[1]);
  mData = data[0];
  mMessage = message[0];
  if (mChild > 0) return;
  ::close(mData);
  ::close(mMessage);
  throw systemError("no process", error);
}

ChildStream::~ChildStream() {
  ::close(mData);
  ::close(mMessage);
  if (mChild <= 0) return;
  ::kill(mChild, SIGKILL);
  ::waitpid(mChild, nullptr, 0);
}

void ChildStream::read(std::span<char> to) {
  if (readAll(mData, to) < to.size()) fail();
}

void ChildStream::fail() {
  constexpr std::size_t kMostMessage = 1000;
  std::string message(kMostMessage, '\0');
  message.resize(readAll(mMessage, message));
  int status = 0;
  ::waitpid(std::exchange(mChild, -1), &status, 0);
  if (WIFSIGNALED(status)) throw Error(fmt::format("{} crashed, signal {}", mWhat, WTERMSIG(status)));
  throw Error(message.empty() ? mWhat + " ended early" : oneLine(message));
}

}  // namespace pdc::detail
