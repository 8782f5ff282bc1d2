#include "points/finish_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>

namespace pdc::detail {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Loops of more vertices become fans at once, since the time for ears grows with the square of their number.
constexpr std::size_t kMostEars = 4096;

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// Appends a copy of a Gaussian. \returns its number.
std::uint32_t addCopy(GaussianMixture& mixture, std::uint32_t v) {
  const auto copy = [v](auto& list) {
    if (!list.empty()) list.push_back(list[v]);
  };
  copy(mixture.means);
  copy(mixture.covariances);
  copy(mixture.weights);
  copy(mixture.normals);
  copy(mixture.colours);
  return static_cast<std::uint32_t>(mixture.size() - 1);
}

/// Appends the mean of some Gaussians. \returns its number.
std::uint32_t addMiddle(GaussianMixture& mixture, const std::vector<std::uint32_t>& loop) {
  const double share = 1 / static_cast<double>(loop.size());
  Vec3d mean{0, 0, 0}, normal{0, 0, 0}, colour{0, 0, 0};
  SymMat3<double> covariance = SymMat3<double>::zero();
  for (const std::uint32_t v : loop) {
    mean += mixture.means[v] * share;
    covariance += mixture.covariances[v] * share;
    if (!mixture.normals.empty()) normal += vecCast<double>(mixture.normals[v]);
    if (!mixture.colours.empty()) colour += vecCast<double>(mixture.colours[v]) * share;
  }
  const std::uint32_t added = addCopy(mixture, loop.front());
  mixture.means[added] = mean;
  mixture.covariances[added] = covariance;
  const double size = length(normal);
  if (!mixture.normals.empty()) mixture.normals[added] = vecCast<float>(size > 0 ? normal * (1 / size) : normal);
  if (!mixture.colours.empty()) mixture.colours[added] = vecCast<float>(colour);
  return added;
}

/// The edges of a mesh in both directions, for ears that must not give one a third triangle.
class EarCutter {
 public:
  EarCutter(const GaussianMixture& mixture, std::vector<Triangle>& triangles)
      : mMixture(mixture), mTriangles(triangles) {
    for (const Triangle& t : triangles) note(t);
  }

  /// Cuts ears off a loop until three vertices or no ear are left; three become the last triangle and none.
  void cut(std::vector<std::uint32_t>& loop) {
    while (loop.size() > 3) {
      std::size_t best = loop.size();
      double shortest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t before = loop[(i + loop.size() - 1) % loop.size()], after = loop[(i + 1) % loop.size()];
        if (hasEdge(before, after)) continue;
        const double size = length(mMixture.means[after] - mMixture.means[before]);
        if (size < shortest) {
          shortest = size;
          best = i;
        }
      }
      if (best == loop.size()) return;
      add({loop[(best + loop.size() - 1) % loop.size()], loop[best], loop[(best + 1) % loop.size()]});
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
    }
    add({loop[0], loop[1], loop[2]});
    loop.clear();
  }
  void add(const Triangle& t) {
    mTriangles.push_back(t);
    note(t);
  }

 private:
  [[nodiscard]] bool hasEdge(std::uint32_t a, std::uint32_t b) const {
    return mEdges.contains(edgeKey(std::min(a, b), std::max(a, b)));
  }
  void note(const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k)
      mEdges.insert(edgeKey(std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])));
  }

  const GaussianMixture& mMixture;
  std::vector<Triangle>& mTriangles;
  std::unordered_set<std::uint64_t> mEdges;
};

}  // namespace

std::size_t splitVertices(GaussianMixture& mixture, std::vector<Triangle>& triangles) {
  struct Corner {
    std::size_t triangle;
    std::uint32_t to, third;
  };
  const std::size_t before = mixture.size();
  std::vector<std::vector<Corner>> corners(before);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      corners[triangles[t][k]].push_back({t, triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]});
  for (std::uint32_t v = 0; v < before; ++v) {
    std::vector<Corner>& left = corners[v];
    for (bool first = true; !left.empty(); first = false) {
      // One fan, from any of its corners on to both sides.
      std::vector<Corner> fan{left.back()};
      left.pop_back();
      std::uint32_t lo = fan[0].to, hi = fan[0].third;
      const auto take = [&](auto&& continues) {
        const auto at = std::find_if(left.begin(), left.end(), continues);
        if (at == left.end()) return false;
        fan.push_back(*at);
        left.erase(at);
        return true;
      };
      while (take([&](const Corner& c) { return c.to == hi; })) hi = fan.back().third;
      while (take([&](const Corner& c) { return c.third == lo; })) lo = fan.back().to;
      if (first) continue;
      const std::uint32_t added = addCopy(mixture, v);
      for (const Corner& corner : fan)
        std::replace(triangles[corner.triangle].begin(), triangles[corner.triangle].end(), v, added);
    }
  }
  return mixture.size() - before;
}

std::vector<std::uint32_t> componentsOf(std::size_t gaussians, const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> parent(gaussians);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) {
      const std::uint32_t p = root(t[0]), q = root(v);
      parent[std::max(p, q)] = std::min(p, q);
    }
  for (std::uint32_t v = 0; v < gaussians; ++v) parent[v] = root(v);
  return parent;
}

std::size_t dropSmallComponents(std::size_t gaussians, std::vector<Triangle>& triangles, std::size_t least) {
  const std::vector<std::uint32_t> component = componentsOf(gaussians, triangles);
  std::vector<std::size_t> size(gaussians, 0);
  for (const Triangle& t : triangles) ++size[component[t[0]]];
  return std::erase_if(triangles, [&](const Triangle& t) { return size[component[t[0]]] < least; });
}

std::vector<std::vector<std::uint32_t>> boundaryLoops(std::size_t gaussians, const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edgeKey(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> next(gaussians, kNone);
  for (const std::uint64_t edge : edges) {
    const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
    if (!std::binary_search(edges.begin(), edges.end(), edgeKey(b, a))) next[b] = a;
  }
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::uint32_t v = 0; v < gaussians; ++v) {
    if (next[v] == kNone) continue;
    loops.emplace_back();
    for (std::uint32_t w = v; next[w] != kNone;) {
      loops.back().push_back(w);
      w = std::exchange(next[w], kNone);
    }
  }
  return loops;
}

std::size_t fillLoops(GaussianMixture& mixture, std::vector<Triangle>& triangles,
                      const std::vector<std::vector<std::uint32_t>>& loops) {
  const std::size_t before = mixture.size();
  if (loops.empty()) return 0;
  EarCutter cutter(mixture, triangles);
  for (std::vector<std::uint32_t> loop : loops) {
    if (loop.size() <= kMostEars) cutter.cut(loop);
    if (loop.empty()) continue;
    const std::uint32_t middle = addMiddle(mixture, loop);
    for (std::size_t i = 0; i < loop.size(); ++i) cutter.add({loop[i], loop[(i + 1) % loop.size()], middle});
  }
  return mixture.size() - before;
}

void orient(const GaussianMixture& mixture, std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> component = componentsOf(mixture.size(), triangles);
  std::vector<double> byNormals(mixture.size(), 0), volume(mixture.size(), 0);
  // The middle of all: open sheets face away from it.
  Vec3d sum{0, 0, 0};
  for (const Vec3d& mean : mixture.means) sum += mean - mixture.means.front();
  const Vec3d apex = mixture.means.front() + sum * (1 / static_cast<double>(mixture.size()));
  for (const Triangle& t : triangles) {
    const std::uint32_t c = component[t[0]];
    const Vec3d p = mixture.means[t[0]], q = mixture.means[t[1]], r = mixture.means[t[2]];
    const Vec3d normal = cross(q - p, r - p);
    volume[c] += dot(p - apex, normal);
    for (const std::uint32_t v : t)
      if (!mixture.normals.empty()) byNormals[c] += dot(normal, vecCast<double>(mixture.normals[v]));
  }
  for (Triangle& t : triangles) {
    const std::uint32_t c = component[t[0]];
    if ((byNormals[c] != 0 ? byNormals[c] : volume[c]) < 0) std::swap(t[1], t[2]);
  }
}

}  // namespace pdc::detail
