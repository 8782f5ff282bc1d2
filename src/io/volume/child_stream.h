#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace pdc::detail {

/// What a child process writes. Only the child's work() has one.
class ChildOutput {
 public:
  explicit ChildOutput(int descriptor) : mDescriptor(descriptor) {}
  void write(const void* data, std::size_t bytes);

 private:
  int mDescriptor;
};

/// Bytes that a function writes in a child process, read from front to back by one thread. Whatever the function does
/// to its memory stays there, so that a library that damaged files crash is an error and no more.
class ChildStream {
 public:
  /// \param what is done, as in "reading TIFF". \throws Error if no process can be made.
  ChildStream(std::string what, const std::function<void(ChildOutput&)>& work);
  /// Ends the child if it still runs.
  ~ChildStream();
  ChildStream(const ChildStream&) = delete;
  ChildStream& operator=(const ChildStream&) = delete;

  /// \throws Error with what the child threw; or if it crashed, or wrote fewer bytes.
  void read(std::span<char> to);

 private:
  [[noreturn]] void fail();

  std::string mWhat;
  pid_t mChild = -1;
  int mData = -1, mMessage = -1;
};

}  // namespace pdc::detail
