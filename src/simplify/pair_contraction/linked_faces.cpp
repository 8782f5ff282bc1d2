#include "simplify/pair_contraction/linked_faces.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <utility>

namespace pdc::detail {

LinkedFaces::LinkedFaces(std::span<const Triangle> faces, std::size_t vertices)
    : mFaces(faces.begin(), faces.end()), mFirst(vertices, kNone), mNext(3 * faces.size()), mSize(faces.size()) {
  // From the last on, so that lists begin with the first.
  for (std::size_t c = mNext.size(); c-- > 0;)
    mNext[c] = std::exchange(mFirst[mFaces[c / 3][c % 3]], static_cast<std::uint32_t>(c));
}

void LinkedFaces::findStar(std::uint32_t vertex, std::vector<StarCorner>& star) {
  star.clear();
  for (std::uint32_t* link = &mFirst[vertex]; *link != kNone;) {
    const std::uint32_t c = *link, f = c / 3, k = c % 3;
    if (isRemoved(f)) {
      *link = mNext[c];
      continue;
    }
    star.push_back({f, mFaces[f][(k + 1) % 3], mFaces[f][(k + 2) % 3]});
    link = &mNext[c];
  }
}

bool LinkedFaces::hasFaces(std::uint32_t vertex) const {
  std::uint32_t c = mFirst[vertex];
  while (c != kNone && isRemoved(c / 3)) c = mNext[c];
  return c != kNone;
}

void LinkedFaces::remove(std::uint32_t face) {
  mFaces[face] = {0, 0, 0};
  --mSize;
}

void LinkedFaces::merge(std::uint32_t a, std::uint32_t b) {
  std::uint32_t* link = &mFirst[b];
  while (*link != kNone) {
    const std::uint32_t c = *link;
    if (isRemoved(c / 3)) {
      *link = mNext[c];
      continue;
    }
    mFaces[c / 3][c % 3] = a;
    link = &mNext[c];
  }
  *link = mFirst[a];
  mFirst[a] = std::exchange(mFirst[b], kNone);
}

Buffer<Triangle> LinkedFaces::left() const {
  Buffer<Triangle> faces;
  faces.reserve(mSize);
  for (std::uint32_t f = 0; f < mFaces.size(); ++f)
    if (!isRemoved(f)) faces.push_back(mFaces[f]);
  return faces;
}

std::size_t removeDuplicates(Buffer<Triangle>& faces) {
  struct Key {
    Triangle sorted;
    std::uint32_t face;
    bool operator<(const Key& o) const { return sorted != o.sorted ? sorted < o.sorted : face < o.face; }
  };
  std::vector<Key> keys(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    keys[f] = {faces[f], f};
    std::sort(keys[f].sorted.begin(), keys[f].sorted.end());
  }
  tbb::parallel_sort(keys.begin(), keys.end());
  const std::size_t before = faces.size();
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].sorted == keys[i - 1].sorted) faces[keys[i].face] = {0, 0, 0};
  std::erase_if(faces, [](const Triangle& t) { return t[0] == t[1]; });
  return before - faces.size();
}

}  // namespace pdc::detail
