#pragma once

#include "pdc/simplify/quadric_kind.h"
#include "terminal/choice_option.h"

namespace pdc {

/// What the kinds of quadrics are called on command lines and in reports.
inline const Choices<QuadricKind> kQuadricWords{{"plane", QuadricKind::kPlane},
                                                {"triangle", QuadricKind::kTriangle},
                                                {"probabilistic-plane", QuadricKind::kProbabilisticPlane},
                                                {"probabilistic-triangle", QuadricKind::kProbabilisticTriangle},
                                                {"point", QuadricKind::kPoint}};

}  // namespace pdc
