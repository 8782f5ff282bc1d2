// Decimates what is flat wherever it is not sharp as far as that goes, and prints how fast that is, how many triangles
// are left, and how far the corners then are from their places: a markdown table.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "best_rates.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/simplify/decimate.h"
#include "simplify/shapes.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;
using pdc::Vec3f;

struct Solid {
  std::string name;
  Mesh mesh;
  std::vector<Vec3d> corners;
  std::size_t leastFaces;  ///< In which it can be had without error.
};

/// Names the corners that the mesh has them at.
Solid cube(int n) {
  Solid solid{"cube", pdc::test::cube(n), {}, 12};
  for (int i = 0; i < 8; ++i) solid.corners.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  return solid;
}

Solid plate(int n) { return {"square", pdc::test::plate(n), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 2}; }

/// So many squares that do not touch, each above the last.
Solid plates(int count, int n) {
  Solid solid{fmt::format("{} squares", count), {}, {}, 2 * static_cast<std::size_t>(count)};
  const Mesh one = pdc::test::plate(n);
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(solid.mesh.positions.size());
    const float z = static_cast<float>(i) / 8;
    for (const Vec3f& p : one.positions) solid.mesh.positions.push_back({p.x, p.y, z});
    for (const auto& [a, b, c] : one.triangles) solid.mesh.triangles.push_back({a + first, b + first, c + first});
    for (int k = 0; k < 4; ++k) solid.corners.push_back({double(k % 2), double(k / 2), z});
  }
  return solid;
}

double cornerError(const Solid& solid, const Mesh& mesh) {
  double most = 0;
  for (const Vec3d& corner : solid.corners) {
    double nearest = 1e300;
    for (const Vec3f& p : mesh.positions) nearest = std::min(nearest, length(pdc::vecCast<double>(p) - corner));
    most = std::max(most, nearest);
  }
  return most;
}

void printRow(const Solid& solid, const std::string& kind, pdc::DecimateOptions options) {
  options.faces = solid.leastFaces;
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const double start = pdc::bench::threadSeconds();
  const Mesh mesh = pdc::decimate(solid.mesh, options);
  const double seconds = pdc::bench::threadSeconds() - start;
  fmt::print("| {} | {} | {} | {:.0f} | {} | {:.1e} |\n", solid.name, solid.mesh.triangles.size(), kind,
             1e-3 * static_cast<double>(solid.mesh.triangles.size()) / seconds, mesh.triangles.size(),
             cornerError(solid, mesh));
  std::fflush(stdout);
}

void printRows(const Solid& solid) {
  printRow(solid, "default", {});
  printRow(solid, "plane", {.quadric = pdc::QuadricKind::kPlane});
}

}  // namespace

int main() {
  fmt::print(
      "| shape | faces | quadrics | k faces/s | faces left | largest distance of a corner "
      "|\n|---|---|---|---|---|---|\n");
  for (const int n : {9, 29, 91, 289}) printRows(cube(n));
  for (const int n : {22, 71, 224, 707}) printRows(plate(n));
  printRows(plates(100, 71));
}
