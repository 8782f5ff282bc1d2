#include "pdc/subdivide/subdivide.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "folders.h"
#include "parallel/machine_memory.h"
#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"
#include "subdivide/control_meshes.h"

namespace pdc {
namespace {

using namespace test;

constexpr auto kCatmullClark = SubdivisionScheme::kCatmullClark;

/// Options for covariances that the mesh has.
SubdivideOptions ownCovariances(int levels, SubdivisionScheme scheme = SubdivisionScheme::kLoop) {
  return {.levels = levels,
          .scheme = scheme,
          .covariances = InferenceOptions{.source = CovarianceSource::kProperties},
          .keepPlaces = true};
}

Buffer<Vec3d> placesOf(const Mesh& mesh, const SubdivideOptions& options) {
  SubdivideReport report;
  const Mesh refined = subdivide(mesh, options, &report);
  EXPECT_EQ(refined.positions.size(), report.places.size());
  return report.places;
}

std::vector<Eigen::Matrix3d> toEigen(const std::vector<SymMat3<double>>& all) {
  std::vector<Eigen::Matrix3d> result;
  for (const SymMat3<double>& m : all) result.push_back(test::toEigen(m));
  return result;
}

double largestDifference(const Buffer<Vec3d>& a, const Buffer<Vec3d>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

std::string complaint(const Mesh& mesh, const SubdivideOptions& options = {}) {
  try {
    (void)subdivide(mesh, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Subdivide, LinearSchemesMatchAnotherEvaluation) {
  for (const Mesh& mesh : {octahedron(), fan(3, false), fan(5, false), fan(8, false), singleFace(3), torus(6)}) {
    for (const LoopWeights weights : {LoopWeights::kLoop, LoopWeights::kWarren}) {
      NaiveMesh naive = naivePoints(mesh);
      for (int i = 0; i < 3; ++i) naive = naiveLoop(naive, weights == LoopWeights::kWarren);
      const auto places = placesOf(mesh, {.levels = 3, .weights = weights, .covariances = {}, .keepPlaces = true});
      EXPECT_LT(distanceOfSets(places, meansOf(naive)), 1e-13);
    }
  }
  for (const Mesh& mesh : {quadCube(), fan(3, true), fan(5, true), singleFace(4), octahedron(), mixedFaces()}) {
    NaiveMesh naive = naivePoints(mesh);
    for (int i = 0; i < 3; ++i) naive = naiveCatmullClark(naive);
    const auto places = placesOf(mesh, {.levels = 3, .scheme = kCatmullClark, .covariances = {}, .keepPlaces = true});
    EXPECT_LT(distanceOfSets(places, meansOf(naive)), 1e-13);
  }
}

TEST(Subdivide, GaussianProductsMatchAnotherEvaluation) {
  unsigned seed = 1;
  for (Mesh mesh : {octahedron(), fan(5, false), torus(5)}) {
    const auto covariances = randomCovariances(mesh.positions.size(), 1e-5, seed++);
    setVertexCovariances(mesh, covariances);
    NaiveMesh naive = naiveGaussians(mesh, toEigen(covariances));
    for (int i = 0; i < 3; ++i) naive = naiveLoop(naive, false);
    EXPECT_LT(distanceOfSets(placesOf(mesh, ownCovariances(3)), meansOf(naive)), 1e-9);
  }
  for (Mesh mesh : {quadCube(), fan(5, true), mixedFaces()}) {
    const auto covariances = randomCovariances(mesh.positions.size(), 1e-5, seed++);
    setVertexCovariances(mesh, covariances);
    NaiveMesh naive = naiveGaussians(mesh, toEigen(covariances));
    for (int i = 0; i < 3; ++i) naive = naiveCatmullClark(naive);
    EXPECT_LT(distanceOfSets(placesOf(mesh, ownCovariances(3, kCatmullClark)), meansOf(naive)), 1e-9);
  }
}

/// Figure 7 of Preiner et al. 2019, as the authors' own program makes it.
TEST(Subdivide, TweetyMatchesAnotherEvaluation) {
  const std::filesystem::path file = test::dataFolder() / "mesh/tweety.off";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Mesh mesh = readMesh(file);
  NaiveMesh naive = naiveGaussians(mesh, naiveFaceCovariances(pointsOf(mesh), facesOf(mesh), 0.05));
  for (int i = 0; i < 4; ++i) naive = naiveLoop(naive, true);
  const auto places = placesOf(mesh, {.levels = 4, .weights = LoopWeights::kWarren, .keepPlaces = true});
  EXPECT_LT(distanceOfSets(places, meansOf(naive)), 1e-9);
}

/// Figure 10 there.
TEST(Subdivide, ConesMatchAnotherEvaluation) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const std::vector<Eigen::Matrix3d> apexes{0.01 * one, 1e-5 * one, Eigen::Vector3d(1e-3, 1e-2, 1e-2).asDiagonal(),
                                            Eigen::Vector3d(1e-2, 1e-3, 1e-2).asDiagonal(),
                                            Eigen::Vector3d(1, 1e-5, 1).asDiagonal()};
  for (const Eigen::Matrix3d& apex : apexes) {
    Mesh mesh = cone();
    std::vector<Eigen::Matrix3d> covariances(mesh.positions.size(), 0.01 * one);
    covariances[0] = apex;
    std::vector<SymMat3<double>> all;
    for (const Eigen::Matrix3d& m : covariances) all.push_back(toSymmetric(m));
    setVertexCovariances(mesh, all);
    NaiveMesh naive = naiveGaussians(mesh, covariances);
    for (int i = 0; i < 5; ++i) naive = naiveLoop(naive, true);
    SubdivideOptions options = ownCovariances(5);
    options.weights = LoopWeights::kWarren;
    EXPECT_LT(distanceOfSets(placesOf(mesh, options), meansOf(naive)), 1e-9);
  }
}

TEST(Subdivide, EqualCovariancesMakeTheLinearScheme) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark}) {
    Mesh mesh = fan(5, scheme == kCatmullClark);
    setVertexCovariances(mesh, std::vector(mesh.positions.size(), randomCovariances(1, 0.1, 7)[0]));
    SubdivideOptions linear = ownCovariances(4, scheme);
    linear.covariances.reset();
    EXPECT_LT(largestDifference(placesOf(mesh, ownCovariances(4, scheme)), placesOf(mesh, linear)), 1e-12);
    setVertexCovariances(mesh, randomCovariances(mesh.positions.size(), 0.1, 7));
    EXPECT_GT(largestDifference(placesOf(mesh, ownCovariances(4, scheme)), placesOf(mesh, linear)), 1e-2);
  }
}

TEST(Subdivide, AFactorOfAllCovariancesChangesNothing) {
  Mesh mesh = torus(6);
  auto covariances = randomCovariances(mesh.positions.size(), 1e-3, 3);
  setVertexCovariances(mesh, covariances);
  const auto before = placesOf(mesh, ownCovariances(3));
  for (SymMat3<double>& m : covariances) m = m * 1234.5;
  setVertexCovariances(mesh, covariances);
  EXPECT_LT(largestDifference(before, placesOf(mesh, ownCovariances(3))), 1e-12);
}

TEST(Subdivide, FollowsAffineMaps) {
  Mesh mesh = mixedFaces();
  auto covariances = randomCovariances(mesh.positions.size(), 1e-2, 5);
  setVertexCovariances(mesh, covariances);
  Buffer<Vec3d> moved = placesOf(mesh, ownCovariances(3, kCatmullClark));
  // Numbers that keep the mapped coordinates exact in single precision.
  Eigen::Matrix3d map;
  map << 2, 0.5, 0, -1, 1, 0.25, 0, 3, 4;
  for (Vec3f& p : mesh.positions)
    p = {std::round(p.x * 256) / 256, std::round(p.y * 256) / 256, std::round(p.z * 256) / 256};
  moved = placesOf(mesh, ownCovariances(3, kCatmullClark));
  for (Vec3d& p : moved) p = toVec(map * test::toEigen(p)) + Vec3d{8, -4, 16};
  for (Vec3f& p : mesh.positions) p = vecCast<float>(toVec(map * test::toEigen(vecCast<double>(p))) + Vec3d{8, -4, 16});
  for (SymMat3<double>& m : covariances) m = toSymmetric(map * test::toEigen(m) * map.transpose());
  setVertexCovariances(mesh, covariances);
  EXPECT_LT(largestDifference(moved, placesOf(mesh, ownCovariances(3, kCatmullClark))), 1e-11);
}

/// What is flat to 1 : 1e-5 loses nothing a thousand sizes away from the origin.
TEST(Subdivide, FlatCovariancesKeepTheirDigitsFarFromTheOrigin) {
  Mesh mesh = octahedron();
  setVertexCovariances(mesh, randomCovariances(mesh.positions.size(), 1e-5, 11));
  Buffer<Vec3d> near = placesOf(mesh, ownCovariances(4));
  const Vec3f far{4096, -2048, 8192};
  for (Vec3f& p : mesh.positions) p += far;
  for (Vec3d& p : near) p += vecCast<double>(far);
  // Coordinates of 8192 in double precision have steps of 1.8e-12.
  EXPECT_LT(largestDifference(near, placesOf(mesh, ownCovariances(4))), 5e-12);
}

TEST(Subdivide, CountsAndTopologyFollow) {
  SubdivideReport report;
  const Mesh refined = subdivide(sphere(3), {.levels = 2}, &report);
  EXPECT_EQ(report.facesBefore, 108u);
  EXPECT_EQ(refined.triangles.size(), 108u * 16);
  EXPECT_EQ(report.verticesAfter, 108u * 16 / 2 + 2);
  const MeshReport facts = analyze(refined);
  EXPECT_EQ(facts.eulerNumber, 2);
  EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.misorientedEdges + facts.nonManifoldVertices, 0u);
  EXPECT_GT(facts.volume, 0);

  const Mesh quads = subdivide(mixedFaces(), {.levels = 3, .scheme = kCatmullClark}, &report);
  EXPECT_EQ(report.facesBefore, 13u);
  EXPECT_EQ(quads.quads.size(), 48u * 16) << "one for each corner, then four for each";
  EXPECT_EQ(analyze(quads).eulerNumber, 2);
  EXPECT_EQ(analyze(quads).misorientedEdges, 0u);

  const Mesh split = subdivide(quadCube(), {.levels = 1}, &report);
  EXPECT_EQ(report.triangulatedFaces, 6u);
  EXPECT_EQ(split.triangles.size(), 48u);
  const Mesh open = subdivide(fan(5, false), {.levels = 2}, &report);
  EXPECT_EQ(report.boundaryEdges, 5u);
  EXPECT_EQ(report.extraordinaryVertices, 1u);
  EXPECT_EQ(analyze(open).boundaryEdges, 20u);
}

TEST(Subdivide, CreasesStaySharpAndMatchAnotherEvaluation) {
  const Mesh mesh = quadCube();
  NaiveMesh naive = naivePoints(mesh);
  for (const auto& f : naive.faces)
    for (std::size_t k = 0; k < 4; ++k) naive.creases.insert(naive::key(f[k], f[(k + 1) % 4]));
  for (int i = 0; i < 3; ++i) naive = naiveCatmullClark(naive);
  SubdivideReport report;
  SubdivideOptions options{
      .levels = 3, .scheme = kCatmullClark, .covariances = {}, .creaseAngle = 80, .keepPlaces = true};
  (void)subdivide(mesh, options, &report);
  EXPECT_EQ(report.creaseEdges, 12u);
  EXPECT_LT(distanceOfSets(report.places, meansOf(naive)), 1e-13);
  // Every edge is a crease, so it stays the cube.
  for (const Vec3d& p : report.places) EXPECT_NEAR(largestEntry(p), 1, 1e-13);
  options.creaseAngle = 95;
  (void)subdivide(mesh, options, &report);
  EXPECT_EQ(report.creaseEdges, 0u);
}

TEST(Subdivide, KeptCovariancesSubdivideOn) {
  Mesh mesh = torus(5);
  setVertexCovariances(mesh, randomCovariances(mesh.positions.size(), 0.05, 2));
  SubdivideOptions once = ownCovariances(1);
  once.keepCovariances = true;
  const Mesh half = subdivide(mesh, once);
  EXPECT_EQ(half.properties.size(), 6u);
  // Positions between are rounded to single precision, which flat covariances make more of.
  const auto twice = placesOf(mesh, ownCovariances(2));
  EXPECT_LT(distanceOfSets(placesOf(half, ownCovariances(1)), {twice.begin(), twice.end()}), 1e-5);
}

TEST(Subdivide, TheSameBytesForAnyNumberOfThreads) {
  const Mesh ball = sphere(32);
  const Mesh one = detail::withThreads(1, [&] { return subdivide(ball, {.levels = 3}); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(sameBytes(one, detail::withThreads(threads, [&] { return subdivide(ball, {.levels = 3}); })));
}

TEST(Subdivide, UnusedVerticesAreDropped) {
  Mesh mesh = octahedron();
  const Mesh refined = subdivide(mesh);
  mesh.positions.insert(mesh.positions.begin(), Vec3f{9, 9, 9});
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) ++v;
  SubdivideReport report;
  EXPECT_TRUE(sameBytes(subdivide(mesh, {}, &report), refined));
  EXPECT_EQ(report.unusedVertices, 1u);
}

TEST(Subdivide, RefusesWhatIsNoOrientedManifold) {
  EXPECT_EQ(complaint({}), "the mesh has no faces");
  Mesh mesh = octahedron();
  mesh.triangles.push_back({0, 2, 5});
  EXPECT_EQ(complaint(mesh), "the edge of vertices 0 and 2 has 3 faces, not 1 or 2");
  mesh = octahedron();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(complaint(mesh), "both faces at the edge of vertices 0 and 2 run through it the same way");
  mesh = octahedron();
  mesh.triangles[3] = {3, 0, 3};
  EXPECT_EQ(complaint(mesh, {.covariances = {}}), "face 3 names vertex 3 twice");
  mesh = octahedron();
  mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {5, 1, 0}});
  mesh.triangles.push_back({0, 6, 7});
  EXPECT_EQ(complaint(mesh), "the faces at vertex 0 do not form one fan");
  mesh = octahedron();
  mesh.positions[4].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(complaint(mesh), "vertex 4 has a coordinate that is not finite");
  EXPECT_EQ(complaint(mesh, {.covariances = {}}), "vertex 4 has a coordinate that is not finite");
}

TEST(Subdivide, RefusesBadCovariances) {
  Mesh mesh = octahedron();
  auto covariances = randomCovariances(6, 0.1, 1);
  const auto complaintFor = [&](const SymMat3<double>& covariance) {
    auto all = covariances;
    all[3] = covariance;
    setVertexCovariances(mesh, all);
    return complaint(mesh, ownCovariances(1));
  };
  EXPECT_EQ(complaintFor({1, 0, 0, 1, 0, 1}), "");
  EXPECT_EQ(complaintFor({1, 0, 0, std::nan(""), 0, 1}), "the covariance of vertex 3 is not finite");
  EXPECT_EQ(complaintFor({1, 0, 0, 1, 0, -2}), "the covariance of vertex 3 has the eigenvalue -2; the limit is 0");
  EXPECT_NE(complaintFor({1, 0, 0, 1, 0, 0}).find("covariance of vertex 3 has the eigenvalues 0 and 1"),
            std::string::npos);
  mesh.properties.pop_back();
  EXPECT_EQ(complaint(mesh, ownCovariances(1)), "the vertices have no property 'covzz'");
}

TEST(Subdivide, RefusesTooManyFacesBeforeItBegins) {
  const std::string said = complaint(octahedron(), {.levels = 15});
  EXPECT_EQ(said, "15 levels make 8.59e+09 faces; the limit is 2^32 - 1");
  EXPECT_NE(complaint(quadCube(), {.levels = 16, .scheme = kCatmullClark}).find("faces"), std::string::npos);
}

TEST(Subdivide, RefusesWhatTheMemoryCannotHold) {
  constexpr double kNeeded = 160e9;  // Of a billion Gaussians.
  const auto left = static_cast<double>(detail::availableMemory());
  if (left == 0 || left > kNeeded / 2) GTEST_SKIP() << "this machine may hold it";
  EXPECT_NE(
      complaint(octahedron(), {.levels = 14}).find("14 levels make 1.074e+09 vertices, which take some 161061 MB"),
      std::string::npos);
}

/// Two quads back to back share two edges in a row, so the vertex between those lies inside with two faces.
TEST(Subdivide, RefusesTwoFacesAboutAVertex) {
  Mesh mesh = quadCube();
  const auto v = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({0.2F, 0.1F, 1});
  mesh.quads.erase(mesh.quads.begin() + 1);
  mesh.quads.push_back({4, 5, 7, v});
  mesh.quads.push_back({4, v, 7, 6});
  EXPECT_EQ(
      complaint(mesh, {.scheme = kCatmullClark}),
      "vertex 8 lies inside the surface with 2 faces; Catmull-Clark subdivision with covariances takes 3 and more");
  EXPECT_EQ(complaint(mesh, {.scheme = kCatmullClark, .covariances = {}}), "");
}

TEST(Subdivide, RefusesOptionsOutOfRange) {
  const Mesh mesh = octahedron();
  EXPECT_THROW((void)subdivide(mesh, {.levels = 0}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.levels = 32}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.creaseAngle = 0}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.creaseAngle = 181}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.normals = true}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.covariances = InferenceOptions{.bias = 0}}), std::invalid_argument);
  EXPECT_THROW((void)subdivide(mesh, {.covariances = InferenceOptions{.sigmaNormal = 0}}), std::invalid_argument);
}

TEST(Subdivide, StopsAndReports) {
  const std::atomic<bool> stop{true};
  EXPECT_THROW((void)subdivide(octahedron(), {}, nullptr, {.stop = &stop}), Cancelled);
  std::atomic<double> last{0};
  (void)subdivide(octahedron(), {.levels = 5}, nullptr,
                  {.progress = [&](const char*, double share) { last = std::max(last.load(), share); }});
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace pdc
