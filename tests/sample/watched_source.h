#pragma once

#include <functional>
#include <utility>

#include "sample/wrapped_source.h"

namespace pdc::test {

/// Another source without planes beyond its crossings', which says each time that it is asked.
class WatchedSource final : public WrappedSource {
 public:
  struct Watch {
    std::function<void()> hermite{}, planes{};  ///< Called before each block is filled, from any thread.
  };

  WatchedSource(const HermiteSource& source, Watch watch) : WrappedSource(source), mWatch(std::move(watch)) {}

  [[nodiscard]] SourceKnowledge knowledge() const override { return {}; }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    if (mWatch.hermite) mWatch.hermite();
    WrappedSource::fillHermite(block, hermite);
  }
  void fillFeaturePlanes(const SurfaceBlock&, const HermiteBlock&, std::span<const SurfacePatch>,
                         FeaturePlanes&) const override {
    if (mWatch.planes) mWatch.planes();
  }

 private:
  Watch mWatch;
};

}  // namespace pdc::test
