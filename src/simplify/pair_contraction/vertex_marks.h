#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pdc::detail {

/// Values of some vertices, all of which are forgotten at once at no cost.
class VertexMarks {
 public:
  explicit VertexMarks(std::size_t vertices) : mMarks(vertices) {}

  void clear() {
    if (++mNow != 0) return;
    mMarks.assign(mMarks.size(), {});
    mNow = 1;
  }
  void set(std::uint32_t vertex, std::uint32_t value) { mMarks[vertex] = {mNow, value}; }
  [[nodiscard]] bool has(std::uint32_t vertex) const { return mMarks[vertex].time == mNow; }
  /// Only of vertices that have one.
  [[nodiscard]] std::uint32_t operator[](std::uint32_t vertex) const { return mMarks[vertex].value; }

 private:
  struct Mark {
    std::uint32_t time = 0, value = 0;
  };
  std::vector<Mark> mMarks;
  std::uint32_t mNow = 1;
};

}  // namespace pdc::detail
