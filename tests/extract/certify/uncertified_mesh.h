#pragma once

#include <numeric>
#include <random>
#include <vector>

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"
#include "extract/conflicts/round_progress.h"
#include "extract/faces/fill_mesh.h"
#include "extract/sign_source.h"
#include "extract/vertices/vertex_solver.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc::detail {

/// Never stops; lives as long as whatever keeps a reference to it.
inline const Monitor kUnstopped{};

/// A mesh as certify() gets it, with freely placed vertices, and all that its certifying refers to.
struct UncertifiedMesh {
  explicit UncertifiedMesh(const HermiteSource& source, double sigma = 0.05, const Monitor& monitor = kUnstopped,
                           bool normals = false)
      : blocks(source.surfaceBlocks({})),
        topology(buildTopology(blocks, {})),
        surface{source, blocks, topology},
        mesh(fill(sigma, normals)),
        working(surface, suspects.vertices, mesh, monitor),
        progress(monitor, "certify") {}

  /// The edges whose faces have a suspect vertex.
  [[nodiscard]] std::vector<EdgeRef> active() const {
    std::vector<std::size_t> all(suspects.vertices.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return working.quadsAt(all);
  }
  /// The edges of all faces, sorted.
  [[nodiscard]] std::vector<EdgeRef> edges() const {
    std::vector<EdgeRef> all;
    for (std::size_t block = 0; block < topology.blocks.size(); ++block)
      for (std::uint16_t edge = 0; edge < 3 * 512; ++edge) {
        const EdgeRef e{static_cast<std::int32_t>(block), edge};
        if (topology.blocks[block].edges[e.axis()].test(e.x(), e.y(), e.z())) all.push_back(e);
      }
    return all;
  }
  [[nodiscard]] std::vector<Triangle> triangles(const EdgeRef& e) const {
    std::vector<Triangle> out;
    working.faces().triangles(e, working.edgeCells().face(e), out);
    return out;
  }

  Suspects suspects;
  SurfaceBlocks blocks;
  Topology topology;
  Surface surface;
  Mesh mesh;
  WorkingMesh working;
  RoundProgress progress;

 private:
  Mesh fill(double sigma, bool normals) {
    Mesh filled;
    fillMesh(surface, {.sigma = sigma, .halfSize = kFreeHalfSize, .normals = normals}, filled, &suspects, {});
    return filled;
  }
};

/// A grid of random signs with random crossings and planes.
inline SignSource randomGrid(std::mt19937& random, int size, bool exactNormals) {
  SignSource source(size + 2);
  for (int x = 1; x <= size; ++x)
    for (int y = 1; y <= size; ++y)
      for (int z = 1; z <= size; ++z) source.set(x, y, z, random() % 2 == 0);
  if (exactNormals) source.claimExactNormals();
  return source;
}

/// A solid with sharp convex and concave creases and corners, some closer to each other than a voxel.
inline FieldSource creasedSolid(int resolution) {
  const FieldPtr bar = rotate(box({}, {0.7, 0.5, 0.2}), {1, 2, 3}, 25);
  const FieldPtr notch = rotate(box({0.3, 0.2, 0.1}, {0.3, 0.4, 0.3}), {3, 1, 1}, 50);
  return FieldSource(subtract({bar, notch}), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 2.0 / resolution});
}

/// One inside point, (2, 2, 2): the mesh is a cube, of the six edges about the point.
inline SignSource singlePoint() {
  SignSource source(5);
  source.set(2, 2, 2, true);
  return source;
}
/// An edge of the only block of that source.
inline EdgeRef edgeOfOnlyBlock(int axis, int x, int y, int z) {
  return {0, static_cast<std::uint16_t>(512 * axis + 64 * x + 8 * y + z)};
}

}  // namespace pdc::detail
