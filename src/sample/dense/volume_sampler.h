#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "pdc/sample/dense/volume_view.h"
#include "pdc/sample/lattice.h"
#include "sample/stencils/value_reading.h"

namespace pdc::detail {

/// The most values of a run; see VolumeSampler::insideBits().
inline constexpr int kMostRun = 2048;

/// What is remarkable among the values of a run.
struct RunRemarks {
  bool allFinite = true;
  /// Bit i is set if a value from 64 i to 64 i + 63 is the isovalue.
  std::uint64_t onIso = 0;
};

/// Where values are read to: rows along z of a box of points.
struct PointRows {
  Coord low;                  ///< The first point.
  std::array<int, 3> size;    ///< Points along each axis, at most 16.
  const std::uint16_t* rows;  ///< For each x of the box, a bit for each y whose row is needed.
  float* to;                  ///< Where the first point's value is put; z runs fastest,
  std::array<int, 2> step;    ///< along x and y the next one is so far away.
};

/// The part of DenseSource that depends on the type of the values. Points given to it lie in the volume, except where
/// it says something else.
class VolumeSampler {
 public:
  explicit VolumeSampler(const VolumeView& view) : mView(view) {}
  virtual ~VolumeSampler() = default;

  [[nodiscard]] const VolumeView& view() const { return mView; }
  [[nodiscard]] bool holds(const Coord& p) const {
    return p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < mView.size[0] && p[1] < mView.size[1] && p[2] < mView.size[2];
  }
  [[nodiscard]] const std::byte* at(const Coord& p) const {
    return mView.data + (mView.stride[0] * p[0] + mView.stride[1] * p[1] + mView.stride[2] * p[2]);
  }

  /// Which of `count` values along an axis, at most kMostRun, are inside: bit by bit, as many words as it takes, the
  /// rest of the last one cleared.
  virtual RunRemarks insideBits(const Coord& first, Axis axis, int count, std::uint64_t* bits) const = 0;
  [[nodiscard]] virtual bool onIso(const Coord& point) const = 0;
  /// What a value means.
  [[nodiscard]] virtual double meaning(const Coord& point) const = 0;
  /// Reads values as those of the function that is negative inside; NaN for points outside of the volume.
  virtual void read(const PointRows& box) const = 0;

 private:
  VolumeView mView;
};

[[nodiscard]] std::unique_ptr<const VolumeSampler> makeVolumeSampler(const VolumeView& view,
                                                                     const ValueReading& reading);

/// The axis along which values lie closest in memory.
[[nodiscard]] Axis runAxis(const VolumeView& view);

}  // namespace pdc::detail
