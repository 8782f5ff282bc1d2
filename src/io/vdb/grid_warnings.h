#pragma once

#include <string>
#include <vector>

#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc::detail {

/// How a remedy is written: `--inside high` on the command line, `inside: high` in a scene.
enum class OptionStyle { kProgram, kScene };

/// A line for each doubt: what the data shows, how it was taken, and what mends it.
[[nodiscard]] std::vector<std::string> gridWarnings(const GridMeaning& meaning, OptionStyle style);

}  // namespace pdc::detail
