#pragma once

#include <cstddef>

namespace pdc::detail {

/// What takes bytes, from front to back, from one thread at a time.
class ByteOutput {
 public:
  ByteOutput() = default;
  ByteOutput(const ByteOutput&) = delete;
  ByteOutput& operator=(const ByteOutput&) = delete;

  /// Appends bytes. \throws Error if they cannot be written.
  virtual void write(const void* data, std::size_t size) = 0;

 protected:
  ~ByteOutput() = default;
};

}  // namespace pdc::detail
