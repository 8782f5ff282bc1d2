#pragma once

#include <optional>
#include <span>
#include <string>

#include "pdc/study/sweep.h"

namespace pdc::detail {

/// One figure of each step, under the names that files and readers know it by.
struct SweepColumn {
  const char* key;    ///< In .csv and .json.
  const char* label;  ///< On the page.
  std::optional<double> (*get)(const SweepStep&);
};

/// In the order of the table; the swept value itself is not among them.
[[nodiscard]] std::span<const SweepColumn> sweepColumns();
[[nodiscard]] const SweepColumn& sweepColumn(const std::string& key);

/// Six significant digits at most; "inf" for infinity.
[[nodiscard]] std::string sweepNumber(double value);
/// How the page calls what is swept: "σn", "isovalue", "voxel size".
[[nodiscard]] std::string sweepParameterLabel(const std::string& parameter);

}  // namespace pdc::detail
