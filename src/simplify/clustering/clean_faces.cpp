#include "simplify/clustering/clean_faces.h"

#include <algorithm>
#include <tuple>

namespace pdc::detail {
namespace {

/// A face by its vertices, and which way it looks.
struct FaceKey {
  Triangle sorted;
  std::size_t face;
  bool turned;

  explicit FaceKey(const Triangle& t, std::size_t number) : sorted(t), face(number) {
    std::sort(sorted.begin(), sorted.end());
    const std::size_t least = t[0] == sorted[0] ? 0 : t[1] == sorted[0] ? 1 : 2;
    turned = t[(least + 1) % 3] != sorted[1];
  }
  friend bool operator<(const FaceKey& a, const FaceKey& b) {
    return std::tie(a.sorted, a.face) < std::tie(b.sorted, b.face);
  }
};

}  // namespace

DroppedFaces cleanFaces(Buffer<Triangle>& faces) {
  DroppedFaces dropped;
  Buffer<FaceKey> keys;
  keys.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) keys.emplace_back(faces[i], i);
  std::sort(keys.begin(), keys.end());
  std::vector<bool> stays(faces.size(), true);
  for (auto begin = keys.begin(); begin != keys.end();) {
    const auto end = std::find_if(begin, keys.end(), [&](const FaceKey& k) { return k.sorted != begin->sorted; });
    const auto count = static_cast<std::size_t>(end - begin);
    const auto turned = static_cast<std::size_t>(std::count_if(begin, end, [](const FaceKey& k) { return k.turned; }));
    const std::size_t pairs = std::min(turned, count - turned);
    dropped.folded += 2 * pairs;
    dropped.duplicate += count == 2 * pairs ? 0 : count - 2 * pairs - 1;
    const bool moreTurned = 2 * turned > count;
    bool mayStay = count > 2 * pairs;
    for (auto k = begin; k != end; ++k) {
      stays[k->face] = mayStay && k->turned == moreTurned;
      mayStay &= !stays[k->face];
    }
    begin = end;
  }
  std::size_t size = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (stays[i]) faces[size++] = faces[i];
  faces.resize(size);
  return dropped;
}

}  // namespace pdc::detail
