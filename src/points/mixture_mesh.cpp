#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "mesh/mesh_checks.h"
#include "pdc/error.h"
#include "pdc/math/box.h"
#include "pdc/mesh/vertex_covariances.h"
#include "pdc/points/gaussian_mixture.h"

namespace pdc {
namespace {

constexpr std::array<const char*, 3> kColours{"red", "green", "blue"};

/// Single precision resolves a millionth of the box from an origin in its middle; without need the origin is zero.
Vec3d originFor(const Buffer<Vec3d>& points) {
  constexpr double kFar = 16;
  Box box = Box::empty();
  for (const Vec3d& p : points) box.include(p);
  if (points.empty() || largestEntry(box) <= kFar * 2 * largestEntry(box.halfSize())) return {0, 0, 0};
  const Vec3d centre = box.center();
  return {std::round(centre.x), std::round(centre.y), std::round(centre.z)};
}

}  // namespace

Mesh mixtureMesh(const GaussianMixture& mixture) {
  Mesh mesh;
  mesh.origin = originFor(mixture.means);
  for (const Vec3d& mean : mixture.means) mesh.positions.push_back(vecCast<float>(mean - mesh.origin));
  mesh.normals = mixture.normals;
  setVertexCovariances(mesh, mixture.covariances);
  mesh.properties.push_back({"weight", 1, mixture.weights});
  for (int c = 0; c < 3 && !mixture.colours.empty(); ++c) {
    Buffer<std::uint8_t> bytes;
    for (const Vec3f& colour : mixture.colours) bytes.push_back(static_cast<std::uint8_t>(std::lround(colour[c])));
    mesh.properties.push_back({kColours[static_cast<std::size_t>(c)], 1, std::move(bytes)});
  }
  return mesh;
}

GaussianMixture mixtureOf(const Mesh& mesh) {
  if (mesh.positions.empty()) throw Error("there are no Gaussians");
  GaussianMixture mixture;
  mixture.covariances = vertexCovariances(mesh, CovarianceKind::kDefinite);
  detail::checkFinite(mesh);
  for (const Vec3f& p : mesh.positions) mixture.means.push_back(mesh.origin + vecCast<double>(p));
  mixture.normals = mesh.normals;
  mixture.weights.assign(mixture.size(), 1.0);
  if (mesh.property("weight") != nullptr) {
    const std::vector<double> weights = detail::scalarNumbers(mesh, "weight");
    mixture.weights.assign(weights.begin(), weights.end());
  }
  double sum = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    if (!(mixture.weights[i] > 0 && std::isfinite(mixture.weights[i])))
      throw Error(fmt::format("the weight of Gaussian {} is {}; it must be above 0 and finite", i, mixture.weights[i]));
    sum += mixture.weights[i];
  }
  for (double& weight : mixture.weights) weight /= sum;
  const std::array bytes{mesh.values<std::uint8_t>(kColours[0]), mesh.values<std::uint8_t>(kColours[1]),
                         mesh.values<std::uint8_t>(kColours[2])};
  const auto isFull = [&](const auto& values) { return values.size() == mixture.size(); };
  if (isFull(bytes[0]) && isFull(bytes[1]) && isFull(bytes[2]))
    for (std::size_t i = 0; i < mixture.size(); ++i)
      mixture.colours.push_back({float(bytes[0][i]), float(bytes[1][i]), float(bytes[2][i])});
  return mixture;
}

}  // namespace pdc
