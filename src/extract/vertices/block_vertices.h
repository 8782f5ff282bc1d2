#pragma once

#include <cstddef>
#include <memory>

#include "extract/topology/surface.h"
#include "extract/topology/suspect_vertex.h"
#include "extract/vertices/placed_quadrics.h"
#include "extract/vertices/vertex_solver.h"
#include "pdc/math/simd_level.h"
#include "sample/normal_noise_histogram.h"

namespace pdc::detail {

struct VertexCounts {
  std::size_t crossings = 0, withoutNormal = 0, outOfCell = 0, moved = 0;
  std::size_t creases = 0;  ///< Patches with several planes from distances.
  // Where σn comes from the data:
  NormalNoiseHistogram agreement{};  ///< How well normals agree with chords.
  RootHistogram sigmas{};            ///< The σn of all patches.

  VertexCounts& operator+=(const VertexCounts& c) {
    crossings += c.crossings;
    withoutNormal += c.withoutNormal;
    outOfCell += c.outOfCell;
    moved += c.moved;
    creases += c.creases;
    agreement += c.agreement;
    sigmas += c.sigmas;
    return *this;
  }
};

/// Where solved vertices go: vertex i to positions[i], normals[i] (unless null) and quadrics[i].
struct VertexOutput {
  Vec3f* positions;
  Vec3f* normals;
  PlacedQuadrics* quadrics;
  Suspects* suspects;  ///< Null: wherever a vertex comes to lie is right.
};

/// Samples and solves the vertices of one block after another. For one thread; large: keep it off the stack.
class BlockVertexSolver {
 public:
  /// \param halfSize see VertexSolver.
  BlockVertexSolver(const HermiteSource& source, const SigmaNormal& sigma, double halfSize, SimdLevel level);
  ~BlockVertexSolver();
  BlockVertexSolver(const BlockVertexSolver&) = delete;
  BlockVertexSolver& operator=(const BlockVertexSolver&) = delete;

  /// Block `index` of the list.
  void run(std::size_t index, const Surface& surface, const VertexOutput& out, VertexCounts& counts);

 private:
  struct Scratch;
  const HermiteSource& mSource;
  std::unique_ptr<Scratch> mScratch;
};

}  // namespace pdc::detail
