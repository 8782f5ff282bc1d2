#pragma once

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Another source, all of it; tests override what they change.
class WrappedSource : public HermiteSource {
 public:
  explicit WrappedSource(const HermiteSource& source) : mSource(source) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    return mSource.surfaceBlocks(monitor);
  }
  [[nodiscard]] const LatticeMap& map() const override { return mSource.map(); }
  [[nodiscard]] SourceKnowledge knowledge() const override { return mSource.knowledge(); }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    mSource.fillHermite(block, hermite);
  }

 private:
  const HermiteSource& mSource;
};

}  // namespace pdc
