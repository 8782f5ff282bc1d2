#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pdc/grid/clip.h"
#include "pdc/grid/combine.h"
#include "pdc/grid/grid_volume.h"
#include "pdc/grid/keep_components.h"
#include "pdc/grid/resample.h"
#include "pdc/grid/smooth.h"
#include "pdc/monitor.h"

namespace pdc {

/// Another grid, and how it is combined with the one that is processed.
struct CombineStep {
  CombineKind kind = CombineKind::kUnion;
  GridVolume other{};
  std::string name{};  ///< What the report calls the other grid.
};

/// What is done to a grid, in the order of the members; what is empty is left out.
struct GridSteps {
  std::optional<double> fogToLevelSet{};  ///< The isovalue; see fogToLevelSet().
  std::optional<ClipOptions> clip{};
  std::optional<ResampleOptions> resample{};
  std::optional<SmoothGridOptions> smooth{};
  std::optional<double> offset{};      ///< World units; see offsetGrid().
  std::optional<double> openClose{};   ///< World units; see openCloseGrid().
  std::vector<CombineStep> combine{};  ///< One after the other.
  std::optional<KeepOptions> keep{};
  bool fillCavities = false;

  [[nodiscard]] bool empty() const;
};

/// Takes the steps one after the other. \param reports gets one report a step, if it is not null.
/// \throws what the functions of the steps throw.
void applyGridSteps(GridVolume& volume, const GridSteps& steps, std::vector<GridStepReport>* reports = nullptr,
                    const Monitor& monitor = {});

}  // namespace pdc
