#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pdc/mesh/buffer.h"
#include "pdc/monitor.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"
#include "pdc/sample/plane_noise.h"
#include "pdc/sample/surface_forecast.h"

namespace pdc {

/// The blocks that hold surface, with their signs; coords[i] belongs to signs[i].
struct SurfaceBlocks {
  std::vector<Coord> coords;
  Buffer<BlockSigns> signs;
  bool open = false;  ///< True if some cells may not take part; false promises that all do.
};

/// One block that holds surface. `edges` was made from `signs`.
struct SurfaceBlock {
  const Coord& coord;
  const BlockSigns& signs;
  const EdgeIndex& edges;
};

/// What a source tells beside where the surface crosses lattice edges and with which normals.
struct SourceKnowledge {
  enum class Noise {
    kNone,     ///< fillNoise() is not to be called.
    kWeights,  ///< fillNoise() tells how much each crossing counts; normals have no noise of their own.
    kSigma,    ///< fillNoise() tells the noise of each normal too.
  };

  /// Normals are the surface's own at each crossing, not means over the cells about it: where the planes of a cell's
  /// crossings meet, there is a crease or a corner.
  bool exactNormals = false;
  /// fillFeaturePlanes() tells of all creases that there are: patches without such planes are smooth, and normals that
  /// do not agree there are wrong.
  bool allCreases = false;
  Noise noise = Noise::kNone;
};

/// An input that can be contoured. Immutable; its functions may be called from many threads at once. They may run
/// parallel loops of their own: callers isolate them, so that a thread that waits in one does not begin another block.
class HermiteSource {
 public:
  virtual ~HermiteSource() = default;

  /// All blocks with a sign change, each once, sorted by coordinate (x, then y, then z). Signs of points that two
  /// blocks share agree. Closed under continuation: if points on the face between two blocks differ in sign, both
  /// blocks are there (unless no cell of the other one takes part). Runs in parallel on the calling thread's arena.
  /// \throws Cancelled, Error (non-finite input that was not accepted).
  [[nodiscard]] virtual SurfaceBlocks surfaceBlocks(const Monitor& monitor) const = 0;

  /// How large the surface is, in a small part of the time that finding it takes; nothing if that is not known.
  /// \throws Cancelled.
  [[nodiscard]] virtual std::optional<SurfaceForecast> forecast(const Monitor& /*monitor*/) const { return {}; }

  /// Lattice to world.
  [[nodiscard]] virtual const LatticeMap& map() const = 0;

  /// What it says does not change while the source lives.
  [[nodiscard]] virtual SourceKnowledge knowledge() const { return {}; }

  /// Fills crossings and normals of a block of surfaceBlocks(). Does not allocate.
  virtual void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const = 0;

  /// Fills what is known of the noise of each crossing in `hermite`, which was filled before. Does not allocate. Called
  /// only if knowledge() says so.
  virtual void fillNoise(const SurfaceBlock& /*block*/, const HermiteBlock& /*hermite*/, PlaneNoise& /*noise*/) const {}

  /// Fills planes that the source knows of some of a block's patches beyond `hermite`, which was filled before. Sources
  /// that know none leave `planes`, which comes empty, as it is. Allocates only while `planes` has not grown to its
  /// size.
  virtual void fillFeaturePlanes(const SurfaceBlock& /*block*/, const HermiteBlock& /*hermite*/,
                                 std::span<const SurfacePatch> /*patches*/, FeaturePlanes& /*planes*/) const {}

  /// A hint that a block will soon be filled, so that its data may be fetched meanwhile.
  virtual void prefetch(const Coord& block) const { static_cast<void>(block); }
};

}  // namespace pdc
