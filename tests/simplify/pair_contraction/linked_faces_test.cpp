#include "simplify/pair_contraction/linked_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pdc::detail {
namespace {

std::vector<std::uint32_t> facesAt(LinkedFaces& faces, std::uint32_t vertex) {
  std::vector<StarCorner> star;
  faces.findStar(vertex, star);
  std::vector<std::uint32_t> numbers;
  for (const StarCorner& c : star) numbers.push_back(c.face);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

TEST(LinkedFaces, VerticesTakeOverFaces) {
  const std::vector<Triangle> given{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  LinkedFaces faces(given, 8);
  EXPECT_EQ(facesAt(faces, 0), (Numbers{0, 1}));
  Numbers common;
  faces.forEachCommon(0, 2, [&](std::uint32_t f) { common.push_back(f); });
  EXPECT_EQ(common, (Numbers{0, 1}));

  faces.merge(0, 4);
  EXPECT_EQ(facesAt(faces, 0), (Numbers{0, 1, 2, 3}));
  EXPECT_FALSE(faces.hasFaces(4));
  EXPECT_EQ(faces[2], (Triangle{0, 5, 6}));

  faces.remove(0);
  faces.remove(2);
  EXPECT_EQ(faces.size(), 2u);
  EXPECT_FALSE(faces.hasFaces(1));
  EXPECT_EQ(facesAt(faces, 0), (Numbers{1, 3}));
  faces.merge(1, 0);
  EXPECT_EQ(facesAt(faces, 1), (Numbers{1, 3}));
  EXPECT_EQ(faces.left(), (Buffer<Triangle>{{1, 2, 3}, {1, 6, 7}}));
}

TEST(LinkedFaces, DuplicatesAreFacesWithTheSameVertices) {
  Buffer<Triangle> faces{{0, 1, 2}, {3, 1, 2}, {2, 0, 1}, {1, 0, 2}, {2, 1, 3}};
  EXPECT_EQ(removeDuplicates(faces), 3u);
  EXPECT_EQ(faces, (Buffer<Triangle>{{0, 1, 2}, {3, 1, 2}}));
}

}  // namespace
}  // namespace pdc::detail
