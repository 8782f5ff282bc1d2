#pragma once

#include <gtest/gtest.h>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc {

/// What a closed mesh must be whose placement promises soundness; orientation is checked by the sign of the volume.
inline void expectSound(const Mesh& mesh, const ContourReport& report) {
  EXPECT_EQ(report.uncertified, 0u);
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(facts.boundaryEdges, 0u);
  EXPECT_EQ(facts.nonManifoldEdges, 0u);
  EXPECT_EQ(facts.nonManifoldVertices, 0u);
  EXPECT_EQ(facts.misorientedEdges, 0u);
  EXPECT_EQ(facts.duplicateFaces, 0u);
  EXPECT_EQ(facts.unusedVertices, 0u);
  EXPECT_EQ(facts.eulerNumber % 2, 0);
  EXPECT_GT(facts.volume, 0);
  const SelfIntersections found = selfIntersections(mesh);
  EXPECT_EQ(found.pairs.size(), 0u);
  EXPECT_EQ(found.degenerateTriangles, 0u);
}

}  // namespace pdc
