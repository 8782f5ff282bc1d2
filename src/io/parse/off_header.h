#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace pdc::detail {

/// What the keyword of an OFF file says: [ST][C][N][4][n]OFF.
struct OffKind {
  bool normals = false;       ///< N: a normal after each position.
  bool homogeneous = false;   ///< 4: a fourth coordinate that the others are to be divided by.
  bool anyDimension = false;  ///< n: the dimension comes before the counts.
  std::string_view after;     ///< What follows without a blank, as in OFF8.
};

/// Nothing if the word is no keyword of OFF. It may be in lower case, and then n stands for N.
[[nodiscard]] std::optional<OffKind> offKind(std::string_view word);

}  // namespace pdc::detail
