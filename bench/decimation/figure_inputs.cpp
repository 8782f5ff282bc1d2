#include "decimation/figure_inputs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "eval/inputs.h"
#include "pdc/extract/contour.h"
#include "pdc/sample/vdb/grid_source.h"
#include "simplify/shapes.h"

namespace pdc::eval {
namespace {

/// Moves vertices by noise in each coordinate. \param sigma by place, in world units.
void addNoise(Mesh& mesh, const std::function<double(const Vec3f&)>& sigma) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  for (Vec3f& p : mesh.positions) {
    const double s = sigma(p);
    for (int i = 0; i < 3; ++i) p[i] += static_cast<float>(s * normal(engine));
  }
}

/// A sigma that grows along x, from one end of the mesh to the other.
std::function<double(const Vec3f&)> alongX(const Mesh& mesh, double from, double to) {
  const auto [low, high] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                                               [](const Vec3f& a, const Vec3f& b) { return a.x < b.x; });
  const double begin = low->x, size = high->x - low->x;
  return [=](const Vec3f& p) { return from + (to - from) * (p.x - begin) / size; };
}

std::vector<Segment> cubeEdges() {
  std::vector<Segment> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) {
        Vec3d from{}, to{};
        from[axis] = -1;
        to[axis] = 1;
        from[(axis + 1) % 3] = to[(axis + 1) % 3] = u;
        from[(axis + 2) % 3] = to[(axis + 2) % 3] = v;
        edges.push_back({from, to});
      }
  return edges;
}

FigureInput cube(std::string name, int n) {
  const Mesh mesh = test::cube(n);
  return {std::move(name), mesh, mesh, cubeEdges()};
}

/// The contour of a solid's exact distances in a random pose.
FigureInput part(std::string name, const std::string& shapeName, double voxels) {
  FigureInput input{std::move(name), {}, {}, {}};
  const Pose pose = randomPose(3, voxels);
  for (const Shape& shape : makeShapes(voxels)) {
    if (shape.name != shapeName) continue;
    const GridSource source(makeGrid("exact", shape, pose, 0, 0).grid);
    input.mesh = input.clean = contour(source, {.triangles = true});
    for (const auto& [from, to] : shape.creases) input.edges.push_back({pose.toWorld(from), pose.toWorld(to)});
  }
  return input;
}

FigureInput nonUniformCube() {
  FigureInput input = cube("non-uniform cube", 24);
  for (Mesh* mesh : {&input.mesh, &input.clean})
    for (Vec3f& p : mesh->positions)
      for (int i = 0; i < 3; ++i) p[i] *= 0.3F + 0.7F * p[i] * p[i];
  const double sigma = 0.03 * meanSide(input.clean);
  addNoise(input.mesh, [=](const Vec3f&) { return sigma; });
  return input;
}

/// As in images salt and pepper are: a few vertices stand out a little and are moved towards a neighbour, so that
/// normals change much.
FigureInput spikyCube() {
  FigureInput input = cube("spikes", 24);
  const double side = meanSide(input.clean);
  input.spike = 0.15 * side;
  constexpr double kShare = 0.07, kTowards = 0.6;
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform;
  for (const Triangle& t : input.clean.triangles) {
    // A vertex is the first corner of one triangle on average of its two.
    if (uniform(engine) > 0.5 * kShare) continue;
    const Vec3d p = vecCast<double>(input.clean.positions[t[0]]), q = vecCast<double>(input.clean.positions[t[1]]),
                r = vecCast<double>(input.clean.positions[t[2]]);
    const Vec3d n = cross(q - p, r - p);
    input.mesh.positions[t[0]] = vecCast<float>(p + (q - p) * kTowards + n * (input.spike / length(n)));
  }
  return input;
}

}  // namespace

double meanSide(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      sum += length(vecCast<double>(mesh.positions[t[k]]) - vecCast<double>(mesh.positions[t[(k + 1) % 3]]));
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

std::vector<FigureInput> figureInputs() {
  std::vector<FigureInput> all;
  all.push_back(part("drilled block", "box_minus_cylinder", 36));
  all.back().share = 0.15;
  addNoise(all.back().mesh, alongX(all.back().clean, 0, 0.3 * meanSide(all.back().clean)));
  all.push_back(cube("regular cube", 20));
  all.push_back(nonUniformCube());
  all.push_back(cube("varying noise", 24));
  const double side = meanSide(all.back().clean);
  addNoise(all.back().mesh, alongX(all.back().clean, 0.05 * side, 0.5 * side));
  all.push_back(spikyCube());
  all.push_back(part("bracket", "bracket", 24));
  return all;
}

}  // namespace pdc::eval
