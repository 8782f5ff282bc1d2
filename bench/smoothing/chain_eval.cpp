// The table of docs/smoothing.md on the whole way from a volume: distances with noise on one half of the solid are
// contoured, and the mesh is smoothed by the standard deviations that contouring gives its vertices.

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "eval/inputs.h"
#include "eval/metrics.h"
#include "eval/shapes.h"
#include "pdc/extract/contour.h"
#include "pdc/sample/vdb/grid_source.h"
#include "pdc/smooth/smooth.h"

namespace {

using pdc::Mesh;
using pdc::eval::GridInput;
using pdc::eval::Pose;
using pdc::eval::Shape;

/// Exact distances with noise that grows along x from the middle of the solid on, up to `noise` voxels where it ends,
/// and a σ grid that says so.
GridInput noisyHalf(const Shape& shape, const Pose& pose, double noise, unsigned seed) {
  GridInput out = pdc::eval::makeGrid("exact", shape, pose, 0, seed);
  out.sigma = openvdb::FloatGrid::create(0);
  out.sigma->setTransform(out.grid->transformPtr());
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double middle = pose.offset.x, end = out.grid->evalActiveVoxelBoundingBox().max().x();
  auto accessor = out.sigma->getAccessor();
  for (auto it = out.grid->beginValueOn(); it; ++it) {
    const double sigma = noise * std::max(0.0, (it.getCoord().x() - middle) / (end - middle));
    const double added = sigma * normal(random);
    if (sigma > 0) it.setValue(*it + static_cast<float>(added));
    accessor.setValue(it.getCoord(), static_cast<float>(sigma));
  }
  return out;
}

/// Root mean squares of the distance of vertices from the true surface, and of the true creases of the clean half from
/// the mesh, in voxels.
struct Figures {
  double clean = 0, noisy = 0, creases = 0;

  Figures& operator+=(const Figures& o) { return *this = {clean + o.clean, noisy + o.noisy, creases + o.creases}; }
};

Figures measureHalves(const Mesh& mesh, const Shape& shape, const Pose& pose) {
  const std::vector<double> errors = pdc::eval::vertexErrors(mesh, shape, pose);
  std::array<double, 2> squares{}, count{};
  for (std::size_t v = 0; v < errors.size(); ++v) {
    const std::size_t half = double{mesh.positions[v].x} > pose.offset.x ? 1 : 0;
    squares[half] += errors[v] * errors[v];
    count[half] += 1;
  }
  Figures f{std::sqrt(squares[0] / count[0]), std::sqrt(squares[1] / count[1])};
  if (!shape.edges.empty()) f.creases = measureEdges(mesh, shape, pose, pdc::eval::Part::kHalves).edgeRms;
  return f;
}

void printRows(const Shape& shape, double noise, double size, unsigned seeds, int iterations) {
  struct Row {
    const char* name;
    Figures sum{};
  };
  std::vector<Row> rows{{"contoured"}, {"smoothed by `sigma`"}, {"contoured with a σ grid"}, {"smoothed by `sigma`"}};
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Pose pose = pdc::eval::randomPose(910'000 + seed, size);
    const GridInput input = noisyHalf(shape, pose, noise, seed);
    for (std::size_t known = 0; known < 2; ++known) {
      pdc::GridSourceOptions options;
      if (known == 1) options.sigma = input.sigma;
      const Mesh mesh = contour(pdc::GridSource(input.grid, options), {.triangles = true, .confidence = true});
      rows[2 * known].sum += measureHalves(mesh, shape, pose);
      rows[2 * known + 1].sum +=
          measureHalves(smooth(mesh, {.iterations = iterations, .sigmaProperty = "sigma"}), shape, pose);
    }
  }
  for (const auto& [name, sum] : rows)
    fmt::print("| {} | {} | {} | {:.4f} | {:.4f} | {:.4f} |\n", shape.name, noise, name, sum.noisy / seeds,
               sum.clean / seeds, sum.creases / seeds);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Smoothing of contours by the standard deviations of their vertices");
  double size = 24;
  unsigned seeds = 10;
  int iterations = 20;
  std::vector<std::string> names{"box", "cylinder", "box_minus_cylinder", "sphere"};
  app.add_option("--size", size, "Half the size of the solids, in voxels");
  app.add_option("--seeds", seeds, "How many noises and poses figures are the means of");
  app.add_option("--iterations", iterations, "Of smoothing (20)");
  app.add_option("--solids", names, "Which of the solids of eval/shapes.h")->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  fmt::print("| solid | noise | | noisy half | clean half | creases of the clean half |\n|---|---|---|---|---|---|\n");
  for (const Shape& shape : pdc::eval::makeShapes(size))
    if (std::find(names.begin(), names.end(), shape.name) != names.end())
      for (const double noise : {0.2, 0.5}) printRows(shape, noise, size, seeds, iterations);
}
