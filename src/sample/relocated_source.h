#pragma once

#include <utility>

#include "sample/forwarding_source.h"

namespace pdc::detail {

/// Another source with its lattice elsewhere in the world.
class RelocatedSource final : public ForwardingSource {
 public:
  RelocatedSource(const HermiteSource& source, LatticeMap map) : ForwardingSource(source), mMap(std::move(map)) {}

  [[nodiscard]] const LatticeMap& map() const override { return mMap; }

 private:
  LatticeMap mMap;
};

}  // namespace pdc::detail
