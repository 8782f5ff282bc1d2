#include "simplify/clustering/clean_faces.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

using Faces = Buffer<Triangle>;

TEST(CleanFaces, OfDuplicatesTheFirstStays) {
  Faces faces{{3, 1, 2}, {4, 5, 6}, {1, 2, 3}, {2, 3, 1}};
  const DroppedFaces dropped = cleanFaces(faces);
  EXPECT_EQ(faces, (Faces{{3, 1, 2}, {4, 5, 6}}));
  EXPECT_EQ(dropped.duplicate, 2u);
  EXPECT_EQ(dropped.folded, 0u);
}

TEST(CleanFaces, FoldedPairsCancel) {
  Faces faces{{1, 2, 3}, {4, 5, 6}, {3, 2, 1}};
  const DroppedFaces dropped = cleanFaces(faces);
  EXPECT_EQ(faces, (Faces{{4, 5, 6}}));
  EXPECT_EQ(dropped.folded, 2u);
  EXPECT_EQ(dropped.duplicate, 0u);
}

TEST(CleanFaces, WhatIsMoreThanPairsStaysOnce) {
  Faces faces{{1, 3, 2}, {1, 2, 3}, {2, 3, 1}, {3, 1, 2}};
  const DroppedFaces dropped = cleanFaces(faces);
  EXPECT_EQ(faces, (Faces{{1, 2, 3}}));
  EXPECT_EQ(dropped.folded, 2u);
  EXPECT_EQ(dropped.duplicate, 1u);
}

TEST(CleanFaces, OthersKeepTheirOrder) {
  Faces faces{{9, 8, 7}, {1, 2, 3}, {1, 2, 4}, {1, 4, 3}};
  const Faces before = faces;
  const DroppedFaces dropped = cleanFaces(faces);
  EXPECT_EQ(faces, before);
  EXPECT_EQ(dropped.duplicate + dropped.folded, 0u);
  Faces none;
  cleanFaces(none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace pdc::detail
