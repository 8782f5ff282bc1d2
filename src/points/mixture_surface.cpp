#include "points/mixture_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/field/grid_field.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"
#include "points/finish_surface.h"
#include "sample/forwarding_source.h"

namespace pdc::detail {
namespace {

/// What is assumed of all normals beside the noise of each: with less, flat parts follow every plane.
constexpr double kSigmaNormal = 0.02;
/// Parts smaller than this many σ0 are noise.
constexpr double kSmallPart = 8;
/// A sheet that was closed upon itself has a mean thickness below this many σ0.
constexpr double kLeastThickness = 0.4;

/// A source of a mixture's field that tells the deviations of its normals.
class MixtureSource final : public ForwardingSource {
 public:
  MixtureSource(const FieldSource& source, const MixtureField& field) : ForwardingSource(source), mField(field) {}

  [[nodiscard]] SourceKnowledge knowledge() const override {
    SourceKnowledge knowledge = ForwardingSource::knowledge();
    knowledge.noise = SourceKnowledge::Noise::kSigma;
    return knowledge;
  }
  void fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const override {
    block.edges.forEach([&](int i, int axis, int x, int y, int z) {
      Vec3d p{double(x), double(y), double(z)};
      for (int a = 0; a < 3; ++a) p[a] += kBlockSize * block.coord[a];
      p[axis] += double{hermite.t[i]};
      noise.sigma[i] = static_cast<float>(mField.normalDeviation(map().position(p)));
      noise.weight[i] = 1;
    });
  }

 private:
  const MixtureField& mField;
};

/// The multiples of the voxel size about a mesh, with room for the surface to lie outside of it.
Box latticeBox(const Mesh& mesh, double voxelSize, double room) {
  Box box = Box::empty();
  for (const Vec3f& p : mesh.positions) box.include(mesh.origin + vecCast<double>(p));
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = voxelSize * (std::floor((box.lo[a] - room) / voxelSize) - 1);
    box.hi[a] = voxelSize * (std::ceil((box.hi[a] + room) / voxelSize) + 1);
  }
  return box;
}

/// The vertices that triangles use, in their order.
Mesh onlyUsed(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) number[v] = 0;
  Mesh result;
  result.origin = mesh.origin;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(result.positions.size());
    result.positions.push_back(mesh.positions[v]);
  }
  for (const Triangle& t : triangles) result.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return result;
}

/// Leaves out the parts whose boxes have sides below `least`, unless all are as small. \returns how many.
std::size_t dropSmallParts(Mesh& mesh, double least) {
  const std::vector<Triangle> all(mesh.triangles.begin(), mesh.triangles.end());
  const auto part = componentsOf(mesh.positions.size(), all);
  std::vector<Box> boxes(mesh.positions.size(), Box::empty());
  for (std::size_t v = 0; v < part.size(); ++v) boxes[part[v]].include(vecCast<double>(mesh.positions[v]));
  const auto isSmall = [&](std::uint32_t p) { return 2 * largestEntry(boxes[p].halfSize()) < least; };
  std::vector<Triangle> kept;
  std::vector<bool> dropped(mesh.positions.size(), false);
  for (const Triangle& t : all) {
    if (isSmall(part[t[0]]))
      dropped[part[t[0]]] = true;
    else
      kept.push_back(t);
  }
  if (kept.empty() || kept.size() == all.size()) return 0;
  mesh = onlyUsed(mesh, kept);
  return static_cast<std::size_t>(std::count(dropped.begin(), dropped.end(), true));
}

}  // namespace

Mesh contourMixture(const GaussianMixture& mixture, const MixtureScale& scale, const Mesh& rough, double voxelSize,
                    std::size_t& dropped, const Monitor& monitor) {
  const double room = 2 * scale.sigma0 + 2 * voxelSize;
  const GridVolume distances = meshToLevelSet(rough, {.voxelSize = voxelSize, .halfWidth = room}, nullptr, monitor);
  const auto field = std::make_shared<MixtureField>(mixture, scale, gridField(distances.grid, 0, false));
  const FieldSource source(field, {.box = latticeBox(rough, voxelSize, room), .voxelSize = voxelSize});
  Mesh mesh =
      contour(MixtureSource(source, *field), {.sigmaNormal = kSigmaNormal, .triangles = true}, nullptr, monitor);
  dropped = dropSmallParts(mesh, kSmallPart * scale.sigma0);
  const MeshReport facts = analyze(mesh);
  if (!(2 * facts.volume > kLeastThickness * scale.sigma0 * facts.area))
    throw Error("the points enclose nothing, as those of a plane do: leave out the voxel size");
  return mesh;
}

}  // namespace pdc::detail
