#pragma once

#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"
#include "pdc/sample/plane_noise.h"

namespace pdc {

/// The blocks that hold surface, with their signs; coords[i] belongs to signs[i].
struct SurfaceBlocks {
  std::vector<Coord> coords;
  Buffer<BlockSigns> signs;
  bool open = false;  ///< True if some cells may not take part; false promises that all do.
};

/// An input that can be contoured. Immutable; its functions may be called from many threads at once.
class HermiteSource {
 public:
  virtual ~HermiteSource() = default;

  /// All blocks with a sign change, each once, sorted by coordinate (x, then y, then z). Signs of points that two
  /// blocks share agree. Closed under continuation: if points on the face between two blocks differ in sign, both
  /// blocks are there (unless no cell of the other one takes part). Runs in parallel on the calling thread's arena.
  /// \throws Cancelled, Error (non-finite input that was not accepted).
  [[nodiscard]] virtual SurfaceBlocks surfaceBlocks(const Monitor& monitor) const = 0;

  /// Fills crossings and normals of one block for the edges of `edges`, which was made from `signs`. Does not allocate.
  virtual void fillHermite(const Coord& block, const BlockSigns& signs, const EdgeIndex& edges,
                           HermiteBlock& hermite) const = 0;

  /// True if normals are the surface's own at each crossing, not means over the cells about it: where the planes of a
  /// cell's crossings meet, there is a crease or a corner.
  [[nodiscard]] virtual bool exactNormals() const { return false; }

  /// A hint that fillHermite() will soon be called for `block`, so that its data may be fetched meanwhile.
  virtual void prefetch(const Coord& block) const { static_cast<void>(block); }
  /// Fills what the source knows of a block's patches beyond `hermite`, which it has filled before. Sources that know
  /// nothing more leave `planes`, which comes empty, as it is. Allocates only while `planes` has not grown to its size.
  virtual void fillFeaturePlanes(const Coord& /*block*/, const BlockSigns& /*signs*/, const EdgeIndex& /*edges*/,
                                 const HermiteBlock& /*hermite*/, std::span<const SurfacePatch> /*patches*/,
                                 FeaturePlanes& /*planes*/) const {}

  /// True if fillNoise() has something to say, about all blocks.
  [[nodiscard]] virtual bool knowsNoise() const { return false; }
  /// True if that says more of the normals than that they have no noise of their own.
  [[nodiscard]] virtual bool knowsSigma() const { return false; }
  /// Fills what is known of the noise of each crossing in `hermite`, which was filled before. Does not allocate. Called
  /// only if knowsNoise().
  virtual void fillNoise(const Coord& /*block*/, const EdgeIndex& /*edges*/, const HermiteBlock& /*hermite*/,
                         PlaneNoise& /*noise*/) const {}

  /// Lattice to world.
  [[nodiscard]] virtual const LatticeMap& map() const = 0;
};

}  // namespace pdc
