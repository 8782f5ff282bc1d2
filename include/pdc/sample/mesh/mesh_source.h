#pragma once

#include <cstddef>
#include <memory>

#include "pdc/mesh/mesh.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

struct MeshSourceOptions {
  double voxelSize = 0;  ///< World units, finite and > 0.
};

/// What a MeshSource has found out about its mesh.
struct MeshSourceFacts {
  std::size_t triangles = 0;  ///< With three finite corners that differ.
  /// Edges that are left without a partner which runs against them, after vertices that differ by rounding were welded:
  /// 0 for a closed mesh. Edges where three faces meet, or two that are turned against each other, count too.
  std::size_t openEdges = 0;
};

/// The solid that a mesh encloses, on a uniform lattice: any mesh, also one that is open, intersects itself, is inside
/// out or has faces twice.
///
/// A point is inside where the size of the mesh's generalised winding number is above 1/2 (Jacobson, Kavan &
/// Sorkine-Hornung 2013, Robust Inside-Outside Segmentation Using Generalized Winding Numbers). Crossings and normals
/// are those of the triangles that lattice edges pass through (Ju, Losasso, Schaefer & Warren 2002, Dual Contouring of
/// Hermite Data, section 3): of several on an edge the one that counts is that at which inside becomes outside, and
/// where there is none, at a hole, both come from the winding number's level 1/2. Which side of a triangle a lattice
/// point is on is decided exactly, ties included. The winding number of a closed mesh is a whole number and exact; that
/// of an open one is exact to about 0.003.
///
/// The lattice begins 1.5 voxels below the mesh's box, so that faces along its sides lie amid lattice points. Time and
/// memory grow with the surface, and where the mesh is open with the number of its open edges.
class MeshSource final : public HermiteSource {
 public:
  /// Quads and polygons count as the triangles that they stand for. Triangles with a coordinate that is not finite do
  /// not count. Keeps what it needs of the mesh. Runs in parallel. \throws std::invalid_argument and Error as Mesh
  /// says; Error for a mesh without a triangle that counts, a voxel size that is not positive and finite, is below
  /// 2^-32 of the coordinates or makes more than kMaxVoxelsPerAxis voxels; Cancelled.
  MeshSource(const Mesh& mesh, const MeshSourceOptions& options, const Monitor& monitor = {});
  ~MeshSource() override;

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override;
  [[nodiscard]] const LatticeMap& map() const override;
  [[nodiscard]] SourceKnowledge knowledge() const override { return {.exactNormals = true}; }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override;

  [[nodiscard]] const MeshSourceFacts& facts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> mImpl;
};

}  // namespace pdc
