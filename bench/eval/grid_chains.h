#pragma once

#include <string>

namespace pdc::eval {

/// What became of a chain of steps on an odd grid.
struct ChainOutcome {
  std::string what;     ///< The grid and the steps.
  std::string refusal;  ///< What the error said; empty if all steps were taken and the result contoured.
  std::string fault;    ///< What should not have been: another exception, an error of several lines, a broken mesh.
  int steps = 0;        ///< That were asked for.
};

/// Makes a grid that may be damaged or odd (values, signs, bands, classes, types, transforms, tiles), takes random
/// steps and contours the result. Depends on the number alone.
[[nodiscard]] ChainOutcome runRandomChain(unsigned seed);

}  // namespace pdc::eval
