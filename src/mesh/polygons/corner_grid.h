#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pdc::detail {

struct PlanePoint {
  double x, y;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// Points of a plane in the cells of a grid, about as many cells as points. Keeps its memory.
class CornerGrid {
 public:
  /// Takes the points of these numbers. They must be finite.
  void fill(std::span<const PlanePoint> points, std::span<const std::uint32_t> numbers) {
    measure(points, numbers);
    mBegin.assign(mColumns * mRows + 1, 0);
    for (const std::uint32_t i : numbers) ++mBegin[cellOf(points[i]) + 1];
    for (std::size_t c = 1; c < mBegin.size(); ++c) mBegin[c] += mBegin[c - 1];
    mNumbers.resize(numbers.size());
    mNext.assign(mBegin.begin(), mBegin.end() - 1);
    for (const std::uint32_t i : numbers) mNumbers[mNext[cellOf(points[i])]++] = i;
  }

  /// Calls visit(number) for all points in or on a triangle, and for others near it, until it returns true. \returns
  /// whether it did.
  template <typename Visit>
  bool visitNear(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const Visit& visit) const {
    if (mNumbers.empty()) return false;
    const std::size_t firstRow = row(std::min({a.y, b.y, c.y})), lastRow = row(std::max({a.y, b.y, c.y}));
    for (std::size_t r = firstRow; r <= lastRow; ++r) {
      Range xs;
      // A little more than the row, since the rows of points are rounded.
      const double lo = mLow.y + (static_cast<double>(r) - kRounding) * mHeight;
      const double hi = mLow.y + (static_cast<double>(r) + 1 + kRounding) * mHeight;
      xs.include(a, b, lo, hi);
      xs.include(b, c, lo, hi);
      xs.include(c, a, lo, hi);
      if (xs.lo > xs.hi) continue;
      const std::size_t first = column(xs.lo - kRounding * mWidth), last = column(xs.hi + kRounding * mWidth);
      const std::uint32_t end = mBegin[r * mColumns + last + 1];
      for (std::uint32_t k = mBegin[r * mColumns + first]; k < end; ++k)
        if (visit(mNumbers[k])) return true;
    }
    return false;
  }

 private:
  static constexpr double kRounding = 1e-6;  ///< In cells; much more than the error of a cell's number.

  struct Range {
    double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();

    /// Grows by the part of a segment that lies between two heights.
    void include(const PlanePoint& p, const PlanePoint& q, double from, double to) {
      const double low = std::max(from, std::min(p.y, q.y)), high = std::min(to, std::max(p.y, q.y));
      if (low > high) return;
      include(at(p, q, low));
      include(at(p, q, high));
      // A level segment lies there as a whole.
      if (p.y == q.y) include(q.x);
    }
    void include(double x) {
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
    static double at(const PlanePoint& p, const PlanePoint& q, double y) {
      if (p.y == q.y) return p.x;
      const double t = std::clamp((y - p.y) / (q.y - p.y), 0.0, 1.0);
      return p.x + t * (q.x - p.x);
    }
  };

  void measure(std::span<const PlanePoint> points, std::span<const std::uint32_t> numbers) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    PlanePoint high{-kInfinity, -kInfinity};
    mLow = {kInfinity, kInfinity};
    for (const std::uint32_t i : numbers) {
      mLow = {std::min(mLow.x, points[i].x), std::min(mLow.y, points[i].y)};
      high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
    }
    if (numbers.empty()) mLow = high = {0, 0};
    const double count = static_cast<double>(numbers.size()) + 1, w = high.x - mLow.x, h = high.y - mLow.y;
    const auto cells = [count](double along, double across) {
      const double n = along > 0 ? std::sqrt(count * along / std::max(across, along / count)) : 1;
      return static_cast<std::size_t>(std::clamp(n, 1.0, count));
    };
    mColumns = cells(w, h);
    mRows = cells(h, w);
    mWidth = w > 0 ? w / static_cast<double>(mColumns) : 1;
    mHeight = h > 0 ? h / static_cast<double>(mRows) : 1;
  }

  static std::size_t clamped(double number, std::size_t cells) {
    return static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(cells - 1)));
  }
  [[nodiscard]] std::size_t column(double x) const { return clamped((x - mLow.x) / mWidth, mColumns); }
  [[nodiscard]] std::size_t row(double y) const { return clamped((y - mLow.y) / mHeight, mRows); }
  [[nodiscard]] std::size_t cellOf(const PlanePoint& p) const { return row(p.y) * mColumns + column(p.x); }

  PlanePoint mLow{};
  double mWidth = 1, mHeight = 1;
  std::size_t mColumns = 1, mRows = 1;
  std::vector<std::uint32_t> mBegin, mNext, mNumbers;
};

}  // namespace pdc::detail
