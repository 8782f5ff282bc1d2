#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "extract/certify/working_mesh.h"
#include "math/hash128.h"

namespace pdc::detail {

/// A sum of hashes, 128 bits of them: equal for equal sets, whatever their order.
struct LayerHash {
  Hash128 sum{};

  void add(std::span<const std::uint64_t> words);
  friend bool operator==(const LayerHash&, const LayerHash&) = default;
};

/// What certifying did in some layers, each the blocks of one x: the state of every face that was tested first, and of
/// each that changed, after the round in which it did.
///
/// A round decides on a face from the states of the faces about it. So if two runs over parts of a surface have the
/// same history in so many layers that none beyond is looked at, what each made of its own part is what one run over
/// the whole makes of it (docs/tiles.md).
class CertifyHistory {
 public:
  /// \param first the lowest of `layers` layers.
  CertifyHistory(int first, std::size_t layers) : mFirst(first), mLayers(layers) {}

  /// Begins the first testing, or a pass that restores creases: rounds count from here.
  void beginPhase() {
    ++mPhase;
    mRound = 0;
  }
  /// Ends a round. \param faces those that changed in it.
  void record(const WorkingMesh& mesh, std::span<const EdgeRef> faces);

  [[nodiscard]] int first() const { return mFirst; }
  [[nodiscard]] const std::vector<LayerHash>& layers() const { return mLayers; }

 private:
  int mFirst;
  std::vector<LayerHash> mLayers;
  std::uint64_t mPhase = 0, mRound = 0;
};

}  // namespace pdc::detail
