#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "math/lane_loops.h"
#include "pdc/math/quadric_lanes.h"
#include "simplify/edge_collapse.h"
#include "simplify/edge_quadrics.h"

namespace pdc::detail {

/// Sixteen edges whose costs are found at once, one per lane. Must be compiled into a function of a SimdLevel.
class EdgeLanes {
 public:
  [[nodiscard]] bool full() const { return mSize == kLanes; }
  [[nodiscard]] int size() const { return mSize; }
  [[nodiscard]] std::uint32_t tag(int lane) const { return mTag[lane]; }

  /// \param tag what the caller knows the edge by. \param between see CollapseRule.
  void add(const CollapseRule& rule, std::uint32_t a, std::uint32_t b, const Vec3d& between, std::uint32_t tag) {
    mA.set(mSize, rule.quadric(a));
    mB.set(mSize, rule.quadric(b));
    mHalf.set(mSize, (rule.position(b) - rule.position(a)) * 0.5);
    mBetween.set(mSize, between);
    mTag[mSize++] = tag;
  }

  /// Fills costs of the edges that are in, negative where CollapseRule has to find them, and forgets the edges.
  /// \returns how many there were.
  int solve(double* costs) {
    forEachLane([this, costs](int i) {
      const EdgeMinimum m = minimizeOnEdge(mA.get(i), mB.get(i), mHalf.get(i), mBetween.get(i));
      const double cost = m.cost > 0 ? m.cost : 0;
      costs[i] = m.found ? cost : -1;
    });
    return std::exchange(mSize, 0);
  }

 private:
  struct Ends {
    QuadricLanes<double> q;
    alignas(64) double weight[kLanes];
    Vec3Lanes<double> vectorArea;

    void set(int lane, const VertexQuadric& v) {
      q.set(lane, v.q);
      weight[lane] = v.weight;
      vectorArea.set(lane, v.vectorArea);
    }
    [[nodiscard]] VertexQuadric get(int lane) const { return {q.get(lane), weight[lane], vectorArea.get(lane)}; }
  };

  Ends mA{}, mB{};
  Vec3Lanes<double> mHalf{}, mBetween{};
  std::uint32_t mTag[kLanes];
  int mSize = 0;
};

}  // namespace pdc::detail
