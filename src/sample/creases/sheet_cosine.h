#pragma once

namespace pdc::detail {

/// Normals belong to one smooth sheet of a surface where their cosine is larger: they are within 26° of each other.
inline constexpr float kSheetCosine = 0.9F;

/// Sheets whose normals' cosine is below are the two sides of something thin.
inline constexpr double kBackToBack = -0.95;

}  // namespace pdc::detail
