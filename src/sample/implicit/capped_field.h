#pragma once

#include "pdc/field/field.h"

namespace pdc::detail {

/// max(f - iso, d) with d = max over the axes of (lo - p, p - hi): f's solid at an isovalue, cut off sharply at a box.
/// d is exactly zero on the box. Without a box just f - iso. NaN wherever f is not finite.
class CappedField final : public Field {
 public:
  CappedField(FieldPtr field, double iso);
  CappedField(FieldPtr field, double iso, const Box& box);

  void values(PointSpan points, double* values) const override;
  void gradients(PointSpan points, double* values, GradientSpan gradients) const override;
  [[nodiscard]] Interval bound(const Box& box) const override;
  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }
  [[nodiscard]] FieldPtr simplified(const Box& box) const override;

 private:
  FieldPtr mField;
  double mIso;
  Box mBox;
};

}  // namespace pdc::detail
