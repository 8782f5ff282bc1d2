#pragma once

#include <functional>
#include <utility>

#include "pdc/sample/hermite_source.h"

namespace pdc::test {

/// Another source without what it knows beyond crossings and normals, which says each time that it is asked.
class WatchedSource final : public HermiteSource {
 public:
  struct Watch {
    std::function<void()> hermite{}, planes{};  ///< Called before each block is filled, from any thread.
  };

  WatchedSource(const HermiteSource& source, Watch watch) : mSource(source), mWatch(std::move(watch)) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    return mSource.surfaceBlocks(monitor);
  }
  void fillHermite(const Coord& block, const BlockSigns& signs, const EdgeIndex& edges,
                   HermiteBlock& hermite) const override {
    if (mWatch.hermite) mWatch.hermite();
    mSource.fillHermite(block, signs, edges, hermite);
  }
  void fillFeaturePlanes(const Coord&, const BlockSigns&, const EdgeIndex&, const HermiteBlock&,
                         std::span<const SurfacePatch>, FeaturePlanes&) const override {
    if (mWatch.planes) mWatch.planes();
  }
  [[nodiscard]] const LatticeMap& map() const override { return mSource.map(); }

 private:
  const HermiteSource& mSource;
  Watch mWatch;
};

}  // namespace pdc::test
