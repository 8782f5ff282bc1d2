#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "pdc/math/quadric_batch.h"
#include "pdc/math/triangle_quadric.h"

namespace pdc::bench {

/// Random planes, triangles, covariances and systems, each held twice: one by one and in batches.
template <typename T>
struct QuadricInputs {
  std::vector<Vec3<T>> p, q, r, n;
  std::vector<SymMat3<T>> Sp, Sq, Sr;
  std::vector<Quadric<T>> quadrics;
  std::vector<PlaneLanes<T>> planes;
  std::vector<TriangleLanes<T>> triangles;
  std::vector<TriangleCovarianceLanes<T>> Sigmas;
  std::vector<SymMat3Lanes<T>> Sigma_n, Sigma_q;
  std::vector<QuadricLanes<T>> systems;

  /// \param count a multiple of kLanes.
  explicit QuadricInputs(std::size_t count)
      : planes(batchCount(count)),
        triangles(batchCount(count)),
        Sigmas(batchCount(count)),
        Sigma_n(batchCount(count)),
        Sigma_q(batchCount(count)),
        systems(batchCount(count)) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<T> uniform(-1, 1);
    const auto point = [&] { return Vec3<T>{uniform(engine), uniform(engine), uniform(engine)}; };
    const auto covariance = [&] { return (outer(point()) + outer(point()) + outer(point())) * T(0.01); };
    for (std::size_t i = 0; i < count; ++i) {
      for (auto* v : {&p, &q, &r, &n}) v->push_back(point());
      for (auto* m : {&Sp, &Sq, &Sr}) m->push_back(covariance());
      quadrics.push_back(probabilisticTriangleQuadric(p[i], q[i], r[i], T(0.1)));
      const std::size_t batch = i / kLanes;
      const int lane = static_cast<int>(i % kLanes);
      planes[batch].q.set(lane, q[i]);
      planes[batch].n.set(lane, n[i]);
      triangles[batch].p.set(lane, p[i]);
      triangles[batch].q.set(lane, q[i]);
      triangles[batch].r.set(lane, r[i]);
      Sigmas[batch].p.set(lane, Sp[i]);
      Sigmas[batch].q.set(lane, Sq[i]);
      Sigmas[batch].r.set(lane, Sr[i]);
      Sigma_n[batch].set(lane, Sp[i]);
      Sigma_q[batch].set(lane, Sq[i]);
      systems[batch].set(lane, quadrics[i]);
    }
  }
};

}  // namespace pdc::bench
