// Decimates inputs like those of Figures 1 and 2 of Trettner & Kobbelt 2020 with each kind of quadrics as the paper
// does, and as this project does by default: a markdown table for each, and which of the paper's findings hold. usage:
// decimation_figures [FOLDER] (the meshes are written there)

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "decimation/figure_inputs.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/minimum_angles.h"
#include "pdc/simplify/decimate.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;
using pdc::Vec3f;
using pdc::eval::FigureInput;

struct Method {
  std::string name;
  pdc::DecimateOptions options;
};

/// \param sigma of normals and of vertices, in mean edges.
pdc::DecimateOptions asInThePaper(pdc::QuadricKind kind, double sigma) {
  return {.quadric = kind, .sigmaNormal = sigma, .sigmaPosition = sigma, .memory = 1, .fit = false};
}

std::vector<Method> methods(const FigureInput& input) {
  using enum pdc::QuadricKind;
  std::vector<Method> all;
  all.push_back({"plane", asInThePaper(kPlane, 0.05)});
  all.push_back({"triangle", asInThePaper(kTriangle, 0.05)});
  all.push_back({"probabilistic-plane", asInThePaper(kProbabilisticPlane, 0.05)});
  all.push_back({"probabilistic-triangle", asInThePaper(kProbabilisticTriangle, 0.05)});
  if (input.name == "varying noise") {
    // The middle of the noise: that of each vertex goes from 0.05 to 0.5.
    all.push_back({"probabilistic-plane 0.25", asInThePaper(kProbabilisticPlane, 0.25)});
    all.push_back({"probabilistic-triangle 0.25", asInThePaper(kProbabilisticTriangle, 0.25)});
  }
  all.push_back({"point", asInThePaper(kPoint, 0.05)});
  all.push_back({"default", {}});
  return all;
}

/// Lengths are in mean edges of the input without its faults, angles in degrees.
struct Figures {
  std::size_t vertices = 0;
  double back = 0;    ///< Share of the vertices in the last third along x.
  double middle = 0;  ///< Share of the vertices amid the sides of the cube, which are a quarter of its area.
  double rms = 0, angle = 0;
  double quality = 0, leastAngle = 0;  ///< Mean of 4 √3 area / Σ side²; the first percentile of the least angles.
  double valence = 0;                  ///< Mean difference of the number of neighbours from six.
  double edgeMean = 0, edgeLargest = 0;
  std::size_t spikes = 0;
};

double triangleQuality(const Mesh& mesh) {
  double sum = 0;
  for (const pdc::Triangle& t : mesh.triangles) {
    Vec3d side[3];
    for (int k = 0; k < 3; ++k)
      side[k] = pdc::vecCast<double>(mesh.positions[t[(k + 1) % 3]]) - pdc::vecCast<double>(mesh.positions[t[k]]);
    const double squares = dot(side[0], side[0]) + dot(side[1], side[1]) + dot(side[2], side[2]);
    if (squares > 0) sum += 2 * std::numbers::sqrt3 * length(cross(side[0], side[1])) / squares;
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

double valenceDeviation(const Mesh& mesh) {
  std::vector<int> valence(mesh.positions.size(), 0);  // Closed meshes have as many faces as neighbours at a vertex.
  for (const pdc::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++valence[v];
  double sum = 0;
  for (const int v : valence) sum += std::abs(v - 6);
  return sum / static_cast<double>(valence.size());
}

void measureEdges(const FigureInput& input, const Mesh& mesh, double unit, Figures& figures) {
  pdc::Buffer<Vec3f> points;
  for (const auto& [from, to] : input.edges) {
    const int steps = std::max(1, static_cast<int>(4 * length(to - from) / unit));
    for (int i = 0; i < steps; ++i) points.push_back(pdc::vecCast<float>(from + (to - from) * ((i + 0.5) / steps)));
  }
  for (const double d : pdc::distances(points, mesh)) {
    figures.edgeMean += d / unit / static_cast<double>(points.size());
    figures.edgeLargest = std::max(figures.edgeLargest, d / unit);
  }
}

void measurePlaces(const FigureInput& input, const Mesh& mesh, Figures& figures) {
  float low = input.clean.positions[0].x, high = low;
  for (const Vec3f& p : input.clean.positions) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  for (const Vec3f& p : mesh.positions) {
    figures.back += p.x > low + (high - low) * 2 / 3;
    int beside = 0;
    for (int axis = 0; axis < 3; ++axis) beside += std::abs(p[axis]) < 0.5F;
    figures.middle += beside == 2;
  }
  figures.back /= static_cast<double>(mesh.positions.size());
  figures.middle /= static_cast<double>(mesh.positions.size());
}

Figures measure(const FigureInput& input, const Mesh& mesh) {
  const double unit = pdc::eval::meanSide(input.clean);
  Figures f;
  f.vertices = mesh.positions.size();
  const pdc::MeshComparison c = pdc::compareMeshes(mesh, input.clean, {.samples = 300'000});
  f.rms = c.toReference.rms / unit;
  f.angle = c.meanAngle;
  f.quality = triangleQuality(mesh);
  auto angles = pdc::minimumAngles(mesh);
  const auto percentile = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 100);
  std::nth_element(angles.begin(), percentile, angles.end());
  f.leastAngle = *percentile;
  f.valence = valenceDeviation(mesh);
  measureEdges(input, mesh, unit, f);
  measurePlaces(input, mesh, f);
  if (input.spike > 0)
    for (const double d : pdc::vertexDistances(mesh, input.clean)) f.spikes += d > 0.5 * input.spike;
  return f;
}

void printRow(const std::string& name, const Figures& f) {
  fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.4f} | {:.2f} | {:.3f} | {:.1f} | {:.2f} | {:.4f} | {:.3f} | {} |\n",
             name, f.vertices, 100 * f.back, 100 * f.middle, f.rms, f.angle, f.quality, f.leastAngle, f.valence,
             f.edgeMean, f.edgeLargest, f.spikes);
  std::fflush(stdout);
}

using Results = std::map<std::string, Figures>;

void say(const char* what, bool holds) { fmt::print("- {}: {}\n", what, holds ? "holds" : "DOES NOT HOLD"); }

/// What the paper finds in its pictures.
void compareWithPaper(const FigureInput& input, Results& r) {
  const Figures &plane = r["plane"], &triangle = r["triangle"], &probPlane = r["probabilistic-plane"],
                &probTriangle = r["probabilistic-triangle"], &point = r["point"];
  fmt::print("\n");
  const auto nearerToArea = [](const Figures& a, const Figures& b) {
    return std::abs(a.middle - 0.25) < std::abs(b.middle - 0.25);
  };
  if (input.name != "varying noise" && input.name != "spikes")
    say("more regular triangles with noise in planes", probPlane.quality > plane.quality);
  if (input.name == "drilled block") {
    say("classical planes spend more vertices in noise", plane.back > probPlane.back);
    say("probabilistic planes lie nearer to the clean part", probPlane.rms < plane.rms);
    say("sharp edges are kept to half an edge on average", probPlane.edgeMean < 0.5);
  } else if (input.name == "regular cube") {
    constexpr double kExactly = 1e-5, kNearly = 0.05;  // The latter is what vertices are said to be off by.
    say("classical quadrics keep the edges", std::max(plane.edgeLargest, triangle.edgeLargest) < kExactly);
    say("with noise they are kept to the noise", std::max(probPlane.edgeLargest, probTriangle.edgeLargest) < kNearly);
    say("points do not keep them", point.edgeLargest > 2 * kNearly);
    say("more regular triangles with noise in corners", probTriangle.quality > triangle.quality);
    say("valences nearer to six with noise",
        probPlane.valence < plane.valence && probTriangle.valence < triangle.valence);
  } else if (input.name == "non-uniform cube") {
    say("triangles follow the input's density less than planes", nearerToArea(triangle, plane));
    say("the same with noise", nearerToArea(probTriangle, probPlane));
  } else if (input.name == "varying noise") {
    const Figures &mean = r["probabilistic-plane 0.25"], &meanTriangle = r["probabilistic-triangle 0.25"];
    say("probabilistic planes lie nearer than classical ones, σ 0.05", probPlane.rms < plane.rms);
    say("probabilistic planes lie nearer than classical ones, σ 0.25", mean.rms < plane.rms);
    say("probabilistic triangles lie nearer than probabilistic planes, σ 0.05", probTriangle.rms < probPlane.rms);
    say("probabilistic triangles lie nearer than probabilistic planes, σ 0.25", meanTriangle.rms < mean.rms);
  } else if (input.name == "spikes") {
    say("fewer spikes survive probabilistic planes", probPlane.spikes < plane.spikes);
    say("fewest survive probabilistic triangles", probTriangle.spikes <= probPlane.spikes);
  } else {
    say("sharp edges are kept to a tenth of an edge", probPlane.edgeMean < 0.1 && plane.edgeMean < 0.1);
  }
}

void print(const FigureInput& input, const std::filesystem::path& folder) {
  fmt::print(
      "\n## {}, {} faces, to {:g} %\n\n| | vertices | back, % | amid sides, % | RMS | angle | quality | least angle | "
      "valence | edges: mean | largest | spikes |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      input.name, input.mesh.triangles.size(), 100 * input.share);
  const auto write = [&](std::string name, const Mesh& mesh) {
    name = input.name + " " + name + ".ply";
    std::replace(name.begin(), name.end(), ' ', '_');
    if (!folder.empty()) pdc::writeMesh(mesh, folder / name);
  };
  printRow("input", measure(input, input.mesh));
  write("input", input.mesh);
  Results results;
  for (Method& method : methods(input)) {
    method.options.ratio = input.share;
    const Mesh mesh = pdc::decimate(input.mesh, method.options);
    results[method.name] = measure(input, mesh);
    printRow(method.name, results[method.name]);
    write(method.name, mesh);
  }
  compareWithPaper(input, results);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    openvdb::initialize();
    const std::filesystem::path folder = argc > 1 ? argv[1] : "";
    for (const FigureInput& input : pdc::eval::figureInputs()) print(input, folder);
  } catch (const std::exception& e) {
    fmt::print(stderr, "decimation_figures: {}\n", e.what());
    return 1;
  }
}
