#pragma once

#include <openvdb/openvdb.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "field/finite_voxels.h"
#include "math/float_lanes.h"
#include "sample/stencils/pack_flags.h"
#include "sample/stencils/value_reading.h"

namespace pdc::detail {

/// Turns stored values into those of the function that is negative inside.
template <typename ValueT>
class ValueReader {
 public:
  explicit ValueReader(const ValueReading& r)
      : mIso(r.iso),
        mHigher(r.insideIsHigher),
        mSign(r.insideIsHigher ? -1.0F : 1.0F),
        mIsoFloat(float(r.iso)),
        mIsoIsFloat(static_cast<double>(mIsoFloat) == mIso),
        mIsoIsValue(isValue(r.iso)),
        mIsoValue(mIsoIsValue ? static_cast<ValueT>(r.iso) : ValueT{}) {}

  /// False for values that are not finite.
  [[nodiscard]] bool inside(ValueT v) const {
    const auto d = static_cast<double>(v);
    return (mHigher ? d > mIso : d < mIso) && isFiniteValue(v);
  }
  /// Whether a value is the isovalue.
  [[nodiscard]] bool onIso(ValueT v) const { return mIsoIsValue && v == mIsoValue; }
  [[nodiscard]] float value(ValueT v) const { return static_cast<float>(static_cast<double>(v) - mIso) * mSign; }

  /// value() of `count` values.
  template <int count>
  void copy(const ValueT* from, float* to) const {
    if (std::is_same_v<ValueT, float> && mIsoIsFloat) {
      // Single precision gives what double precision would, as the isovalue is a float. Vectors load whole registers,
      // so that none waits for parts of one that were just stored.
      int i = 0;
      for (; i + 8 <= count; i += 8) {
        Float8 v;
        std::memcpy(&v, from + i, sizeof v);
        v = (v - mIsoFloat) * mSign;
        std::memcpy(to + i, &v, sizeof v);
      }
      for (; i < count; ++i) to[i] = (static_cast<float>(from[i]) - mIsoFloat) * mSign;
    } else {
      for (int i = 0; i < count; ++i) to[i] = value(from[i]);
    }
  }

  /// What is remarkable among values.
  struct Remarks {
    bool allFinite = true;
    bool anyOnIso = false;
  };

  /// inside() of 64 values, one per bit. \param remarks is added to.
  [[nodiscard]] std::uint64_t insideBits(const ValueT* from, Remarks& remarks) const {
    std::uint8_t flag[64];
    const ValueT iso = mIsoValue;
    int bad = 0, on = 0;
    if constexpr (std::is_floating_point_v<ValueT>) {
      // This vectorises, unlike isfinite().
      for (int i = 0; i < 64; ++i) bad |= !(std::abs(from[i]) <= std::numeric_limits<ValueT>::max());
    }
    for (int i = 0; i < 64; ++i) on |= from[i] == iso;
    remarks.allFinite = remarks.allFinite && bad == 0;
    remarks.anyOnIso = remarks.anyOnIso || (mIsoIsValue && on != 0);
    if (std::is_same_v<ValueT, float> && mIsoIsFloat) {
      if (mHigher) {
        for (int i = 0; i < 64; ++i) flag[i] = (from[i] > iso) & (from[i] <= std::numeric_limits<ValueT>::max());
      } else {
        for (int i = 0; i < 64; ++i) flag[i] = (from[i] < iso) & (from[i] >= std::numeric_limits<ValueT>::lowest());
      }
    } else {
      for (int i = 0; i < 64; ++i) flag[i] = inside(from[i]);
    }
    return packFlags(flag);
  }

 private:
  static bool isValue(double iso) {
    using Limits = std::numeric_limits<ValueT>;
    return iso >= static_cast<double>(Limits::lowest()) && iso <= static_cast<double>(Limits::max()) &&
           static_cast<double>(static_cast<ValueT>(iso)) == iso;
  }

  double mIso;
  bool mHigher;
  float mSign, mIsoFloat;
  bool mIsoIsFloat;
  bool mIsoIsValue;  ///< Whether values can equal the isovalue.
  ValueT mIsoValue;
};

}  // namespace pdc::detail
