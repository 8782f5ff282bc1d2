#pragma once

#include <optional>
#include <span>
#include <string>

#include "pdc/study/sweep.h"

namespace pdc::detail {

/// One figure of each step, under the names that files and readers know it by.
struct SweepColumn {
  const char* key;    ///< Its name in .csv and .json.
  const char* label;  ///< Its name on the page.
  std::optional<double> (*get)(const SweepStep&);
};

/// All columns, in the order of the table; the swept value itself is not among them.
[[nodiscard]] std::span<const SweepColumn> sweepColumns();
/// \throws std::invalid_argument for an unknown key.
[[nodiscard]] const SweepColumn& sweepColumn(const std::string& key);

/// A number for readers: six significant digits at most, "inf" for infinity.
[[nodiscard]] std::string sweepNumber(double value);

}  // namespace pdc::detail
