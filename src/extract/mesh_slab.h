#pragma once

#include <cstdint>
#include <vector>

#include "extract/certify/certify_history.h"
#include "extract/mesh_origin.h"
#include "pdc/extract/contour.h"

namespace pdc::detail {

/// Layers of blocks, each the blocks of one x: from `begin` up to, but without, `end`.
struct LayerRange {
  int begin = 0, end = 0;

  friend bool operator==(const LayerRange&, const LayerRange&) = default;
};

/// Layers on each side of a cut whose histories two slabs compare. A round looks three layers far at most.
inline constexpr int kSeamLayers = 4;
/// Layers about a slab that are contoured with it: those that are compared, and two that the cut may spoil.
inline constexpr int kLeastHalo = kSeamLayers + 2;

struct SlabRequest {
  LayerRange layers;
  int halo = kLeastHalo;
  MeshOrigin place;  ///< That of the whole mesh.
};

/// A piece of the mesh that contour() makes of a whole surface: vertices and faces of some layers.
///
/// The whole mesh has the solved vertices of all layers, then those that certifying added, each in the order of the
/// layers; likewise quads and triangles. So it is its slabs, joined array by array, with numbers moved. The corners of
/// a slab's faces are numbers in a list of, one after the other, the solved vertices of the layer before the slab, its
/// own, the added ones of the layer before, and its own.
struct MeshSlab {
  /// What some layers have.
  struct Counts {
    std::uint64_t solved = 0, added = 0;
    friend bool operator==(const Counts&, const Counts&) = default;
  };
  using Seam = std::vector<LayerHash>;

  Mesh mesh;  ///< The slab's own vertices, solved ones first.
  Counts own, layerBefore, lastLayer;
  Seam low, high;  ///< Of kSeamLayers layers before and as many behind the slab's first cut, and its last.
  std::uint64_t blocks = 0, multiVertexCells = 0, boundaryEdges = 0, uncertified = 0;
};

/// The blocks that lie in some layers. \param all sorted.
[[nodiscard]] SurfaceBlocks blocksOfLayers(const SurfaceBlocks& all, LayerRange layers);

/// Contours a slab with the layers about it, and leaves these out. The same as contour() of the whole as far as the
/// histories of neighbouring slabs agree (see CertifyHistory). \param source all of it. \param blocks those of the
/// source that lie in the slab and its halo at least, sorted. \param options without `adaptive`, `quadrics` and
/// `triangles`, which are for whole meshes; origin and exactSums are those of the request. \throws as contour().
[[nodiscard]] MeshSlab contourSlab(const HermiteSource& source, const SurfaceBlocks& blocks, const SlabRequest& request,
                                   const ContourOptions& options, const Monitor& monitor);

}  // namespace pdc::detail
