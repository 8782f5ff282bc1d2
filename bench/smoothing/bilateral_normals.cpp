#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "smoothing/smoothing_peers.h"

namespace pdc::eval {
namespace {

class BilateralNormals {
 public:
  explicit BilateralNormals(const Mesh& mesh) : mFaces(mesh.triangles), mVertexFaces(mesh.positions.size()) {
    for (const Vec3f& p : mesh.positions) mPositions.push_back(vecCast<double>(p));
    for (std::uint32_t f = 0; f < mFaces.size(); ++f)
      for (const std::uint32_t v : mFaces[f]) mVertexFaces[v].push_back(f);
    for (std::uint32_t f = 0; f < mFaces.size(); ++f) {
      const Triangle& t = mFaces[f];
      const Vec3d n = cross(mPositions[t[1]] - mPositions[t[0]], mPositions[t[2]] - mPositions[t[0]]);
      mAreas.push_back(0.5 * length(n));
      mNormals.push_back(n * (1 / std::max(length(n), 1e-300)));
      mMiddles.push_back(middle(f));
    }
    findNeighbours();
    setSpacing();
  }

  void filterNormals(double sigma) {
    std::vector<Vec3d> next(mFaces.size());
    for (std::size_t f = 0; f < mFaces.size(); ++f) {
      Vec3d sum = mNormals[f] * mAreas[f];
      for (const std::uint32_t g : mNeighbours[f]) {
        const Vec3d away = mMiddles[g] - mMiddles[f], turn = mNormals[g] - mNormals[f];
        const double exponent = dot(away, away) / (mSpacing * mSpacing) + dot(turn, turn) / (sigma * sigma);
        sum += mNormals[g] * (mAreas[g] * std::exp(-0.5 * exponent));
      }
      next[f] = sum * (1 / std::max(length(sum), 1e-300));
    }
    mNormals.swap(next);
  }

  /// A step of the vertices towards planes of these normals through the middles of their faces (Sun et al. 2007).
  void moveVertices() {
    for (std::uint32_t f = 0; f < mFaces.size(); ++f) mMiddles[f] = middle(f);
    std::vector<Vec3d> next = mPositions;
    for (std::size_t v = 0; v < mPositions.size(); ++v) {
      Vec3d sum{};
      for (const std::uint32_t f : mVertexFaces[v]) sum += mNormals[f] * dot(mNormals[f], mMiddles[f] - mPositions[v]);
      if (!mVertexFaces[v].empty()) next[v] += sum * (1 / static_cast<double>(mVertexFaces[v].size()));
    }
    mPositions.swap(next);
  }

  [[nodiscard]] const std::vector<Vec3d>& positions() const { return mPositions; }

 private:
  [[nodiscard]] Vec3d middle(std::uint32_t f) const {
    const Triangle& t = mFaces[f];
    return (mPositions[t[0]] + mPositions[t[1]] + mPositions[t[2]]) * (1.0 / 3);
  }

  void findNeighbours() {
    mNeighbours.resize(mFaces.size());
    for (std::uint32_t f = 0; f < mFaces.size(); ++f) {
      std::vector<std::uint32_t>& around = mNeighbours[f];
      for (const std::uint32_t v : mFaces[f])
        for (const std::uint32_t g : mVertexFaces[v])
          if (g != f) around.push_back(g);
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
    }
  }

  /// The mean distance between the middles of faces that share an edge.
  void setSpacing() {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> firstFace;
    double sum = 0, count = 0;
    for (std::uint32_t f = 0; f < mFaces.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(mFaces[f][k], mFaces[f][(k + 1) % 3]);
        const auto [it, isNew] = firstFace.try_emplace({a, b}, f);
        if (isNew) continue;
        sum += length(mMiddles[f] - mMiddles[it->second]);
        count += 1;
      }
    mSpacing = sum / count;
  }

  Buffer<Triangle> mFaces;
  std::vector<std::vector<std::uint32_t>> mVertexFaces, mNeighbours;
  std::vector<Vec3d> mPositions, mNormals, mMiddles;
  std::vector<double> mAreas;
  double mSpacing = 1;
};

}  // namespace

Mesh bilateralNormals(const Mesh& mesh, double sigma, int normalIterations, int vertexIterations) {
  BilateralNormals filter(mesh);
  for (int i = 0; i < normalIterations; ++i) filter.filterNormals(sigma);
  for (int i = 0; i < vertexIterations; ++i) filter.moveVertices();
  Mesh out = mesh;
  for (std::size_t v = 0; v < out.positions.size(); ++v) out.positions[v] = vecCast<float>(filter.positions()[v]);
  return out;
}

}  // namespace pdc::eval
