#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pdc/points/gaussian_mixture.h"
#include "pdc/points/point_cloud.h"

namespace pdc {

/// What the command lines of `pdc mixture` and `pdc reconstruct` say of the mixture.
struct MixtureRequest {
  std::optional<double> sigma0, alpha;
  std::optional<int> levels, iterations;
};

void addMixtureOptions(CLI::App& command, MixtureRequest& request);

/// The request with defaults for what it does not say.
[[nodiscard]] MixtureOptions mixtureOptions(const MixtureRequest& request);

/// Reads points with a sign that it is at work, unless `quiet`, and puts warnings into `warnings` and, unless `quiet`,
/// on standard error. \throws Error.
[[nodiscard]] PointCloud readPointsFile(const std::filesystem::path& path, bool quiet,
                                        std::vector<std::string>& warnings);

}  // namespace pdc
