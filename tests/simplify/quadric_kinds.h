#pragma once

#include "pdc/simplify/quadric_kind.h"

namespace pdc::test {

inline constexpr QuadricKind kQuadricKinds[] = {QuadricKind::kPlane, QuadricKind::kTriangle,
                                                QuadricKind::kProbabilisticPlane, QuadricKind::kProbabilisticTriangle,
                                                QuadricKind::kPoint};

}  // namespace pdc::test
