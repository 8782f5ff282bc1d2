#include "commands/points/point_options.h"

#include <cmath>

#include "pdc/io/points/points_reader.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/warning.h"

namespace pdc {

void addMixtureOptions(CLI::App& command, MixtureRequest& request) {
  const auto group = "Mixture";
  addReal(
      command, "--sigma0", request.sigma0, [](double v) { return v > 0 && std::isfinite(v); },
      "a finite number above 0",
      "Deviation of the Gaussian about each point, in world units:\nlarger is smoother (from the spacing of the "
      "points)")
      ->type_name("S")
      ->group(group);
  addReal(
      command, "--alpha", request.alpha, [](double v) { return v > 0 && std::isfinite(v); }, "a finite number above 0",
      "Gaussians merge up to a divergence of A^2 / 2 (2)")
      ->type_name("A")
      ->group(group);
  addInteger(command, "--levels", request.levels, 0, 100, "At most how many times Gaussians merge (2)")
      ->type_name("L")
      ->group(group);
  addInteger(command, "--iterations", request.iterations, 1, 1000, "Steps of expectation maximisation in a level (1)")
      ->type_name("N")
      ->group(group);
}

MixtureOptions mixtureOptions(const MixtureRequest& request) {
  MixtureOptions options;
  options.sigma0 = request.sigma0;
  options.alpha = request.alpha.value_or(options.alpha);
  options.levels = request.levels.value_or(options.levels);
  options.iterations = request.iterations.value_or(options.iterations);
  return options;
}

PointCloud readPointsFile(const std::filesystem::path& path, bool quiet, std::vector<std::string>& warnings) {
  const ExitOnInterrupt scope;
  const BusySign sign(!quiet, "reading " + path.filename().string());
  return readPoints(path, {.warn = [&](const std::string& warning) {
                      warnings.push_back(warning);
                      if (!quiet) printWarning(warning);
                    }});
}

}  // namespace pdc
