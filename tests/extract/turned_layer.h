#pragma once

#include <utility>

#include "sample/forwarding_source.h"

namespace pdc::detail {

/// Another source whose normals are turned in one layer of blocks.
class TurnedLayer final : public ForwardingSource {
 public:
  TurnedLayer(const HermiteSource& source, int layer) : ForwardingSource(source), mLayer(layer) {}

  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    ForwardingSource::fillHermite(block, hermite);
    if (block.coord[0] != mLayer) return;
    for (int i = 0; i < block.edges.size(); ++i) std::swap(hermite.nx[i], hermite.ny[i]);
  }

 private:
  int mLayer;
};

}  // namespace pdc::detail
