// How well meshes keep the creases of solids whose distances and edges are known, from functions and from sampled
// distances, beside OpenVDB's mesher and dual contouring with plain gradients. Prints one line per case, means over
// poses.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>

#include "eval/inputs.h"
#include "eval/metrics.h"
#include "eval/shapes.h"
#include "eval/volume_to_mesh.h"
#include "pdc/extract/contour.h"
#include "pdc/field/function_field.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::eval {
namespace {

/// The half size of a solid in a cube of a given number of voxels.
constexpr double kFill = 0.35;

struct Request {
  int resolution = 64;
  unsigned poses = 20, firstPose = 0;
  bool heldOut = false;
  std::vector<std::string> shapes{}, inputs{"exact"}, methods{"volume_to_mesh", "gradient", "distance"};
  std::vector<double> noise{0};
  std::vector<std::string> sigma{"0.05"};
  std::string placement = "certified";
  bool confidence = false;
};

struct Case {
  const Shape& shape;
  std::string input, method;
  double noise;
  std::string sigma;
};

struct Outcome {
  Figures figures;
  double correlation = 0;  ///< Rank correlation of the vertices' lack of confidence with their errors.
  double milliseconds = 0;
  std::size_t drawnBack = 0;
};

const std::map<std::string, Placement> kPlacements{
    {"certified", Placement::kCertified}, {"cell", Placement::kCell}, {"free", Placement::kFree}};

Mesh contourCase(const Case& c, const HermiteSource& source, const Request& request, Outcome& outcome) {
  ContourReport report;
  Mesh mesh = contour(source,
                      {.sigmaNormal = c.sigma == "auto" ? std::nullopt : std::optional(std::stod(c.sigma)),
                       .placement = kPlacements.at(request.placement),
                       .confidence = request.confidence},
                      &report);
  outcome.drawnBack = report.shortened + report.drawnIn;
  return mesh;
}

Outcome evaluate(const Case& c, const Pose& pose, unsigned seed, const Request& request) {
  Outcome outcome;
  const auto start = [] { return std::chrono::steady_clock::now(); };
  auto begin = start();
  Mesh mesh;
  if (c.input == "function") {
    const FieldPtr field = functionField(
        {.value = [&](const Vec3d& p) { return c.shape.distance(pose.toShape(p)) * pose.size; }, .lipschitz = 1});
    const double reach = std::ceil(2 * pose.size) + 2;
    const FieldSource source(field, {.box = {{-reach, -reach, -reach}, {reach, reach, reach}}, .voxelSize = 1});
    mesh = contourCase(c, source, request, outcome);
  } else {
    const bool graded = c.input == "graded";
    const GridInput input =
        graded ? makeGradedGrid(c.shape, pose, c.noise, seed) : makeGrid(c.input, c.shape, pose, c.noise, seed);
    begin = start();
    if (c.method == "volume_to_mesh") {
      mesh = volumeToMesh(*input.grid, input.iso);
    } else {
      const bool distance = c.method.starts_with("distance");
      const GridSource source(input.grid, {.iso = input.iso,
                                           .hermite = distance ? HermiteMode::kDistance : HermiteMode::kGradient,
                                           .sigma = c.method.ends_with("_sigma") ? input.sigma : nullptr});
      mesh = contourCase(c, source, request, outcome);
    }
  }
  outcome.milliseconds = std::chrono::duration<double, std::milli>(start() - begin).count();
  outcome.figures = measure(mesh, c.shape, pose, c.input == "graded" ? Part::kHalves : Part::kAll);
  if (const auto confidence = mesh.values<float>("confidence"); !confidence.empty()) {
    std::vector<double> doubt;
    for (const float v : confidence) doubt.push_back(-v);
    outcome.correlation = rankCorrelation(doubt, vertexErrors(mesh, c.shape, pose));
  }
  return outcome;
}

void runCase(const Case& c, const Request& request) {
  // Poses and noise of the two sets differ as well.
  const unsigned first = (request.heldOut ? 100000 : 0) + request.firstPose;
  Figures mean;
  double milliseconds = 0, correlation = 0;
  std::size_t drawnBack = 0;
  for (unsigned i = 0; i < request.poses; ++i) {
    const Outcome o = evaluate(c, randomPose(first + i, kFill * request.resolution), first + i, request);
    const auto add = [&](double Figures::*figure) { mean.*figure += o.figures.*figure / request.poses; };
    for (const auto figure : {&Figures::vertexRms, &Figures::vertexMax, &Figures::edgeRms, &Figures::edgeMax,
                              &Figures::cornerMax, &Figures::normalP99, &Figures::edgeF1})
      add(figure);
    milliseconds += o.milliseconds / request.poses;
    correlation += o.correlation / request.poses;
    drawnBack += o.drawnBack;
  }
  fmt::print("{:<19} {:<9} {:<5} {:<15} {:<6} {:8.4f} {:7.3f} {:8.4f} {:7.3f} {:8.4f} {:7.2f} {:6.3f} {:8.1f} {:6}{}\n",
             c.shape.name, c.input, c.noise, c.method, c.sigma, mean.vertexRms, mean.vertexMax, mean.edgeRms,
             mean.edgeMax, mean.cornerMax, mean.normalP99, mean.edgeF1, milliseconds, drawnBack,
             request.confidence ? fmt::format(" {:6.2f}", correlation) : "");
  std::fflush(stdout);
}

void run(const Request& request) {
  fmt::print("{}^3 voxels, {} poses, {} placement\n", request.resolution, request.poses, request.placement);
  fmt::print("{:<19} {:<9} {:<5} {:<15} {:<6} {:>8} {:>7} {:>8} {:>7} {:>8} {:>7} {:>6} {:>8} {:>6}{}\n", "shape",
             "input", "noise", "method", "sigma", "v rms", "v max", "e rms", "e max", "corner", "normal", "F1", "ms",
             "drawn", request.confidence ? "    rho" : "");
  const auto wanted = [&](const Shape& s) {
    return request.shapes.empty()
               ? s.heldOut == request.heldOut
               : std::find(request.shapes.begin(), request.shapes.end(), s.name) != request.shapes.end();
  };
  for (const Shape& shape : makeShapes(kFill * request.resolution)) {
    if (!wanted(shape)) continue;
    for (const std::string& input : request.inputs)
      for (const double noise : request.noise)
        for (const std::string& method : request.methods)
          for (const std::string& sigma : request.sigma) {
            const bool once = sigma == request.sigma.front();
            if (method == "volume_to_mesh" && !once) continue;
            if (input == "function" && (method != "gradient" || noise > 0)) continue;
            runCase({shape, input, method, noise, sigma}, request);
          }
  }
}

}  // namespace
}  // namespace pdc::eval

int main(int argc, char** argv) {
  pdc::eval::Request request;
  CLI::App app("Measures meshes of solids with known creases");
  app.add_option("--resolution", request.resolution, "Voxels along the cube a solid lies in")->capture_default_str();
  app.add_option("--poses", request.poses, "Random poses per case")->capture_default_str();
  app.add_option("--first-pose", request.firstPose, "Number of the first");
  app.add_flag("--held-out", request.heldOut, "The shapes, poses and noise that were kept apart");
  app.add_option("--shapes", request.shapes, "Only these")->delimiter(',');
  app.add_option("--inputs", request.inputs,
                 "function, exact, half, iso, mesh; graded: noise that grows\nalong x, of which the noisy half's "
                 "vertices and the clean half's edges are measured")
      ->delimiter(',');
  app.add_option(
         "--methods", request.methods,
         "volume_to_mesh, gradient, distance; of graded inputs also\ngradient_sigma, distance_sigma: with the σ grid")
      ->delimiter(',');
  app.add_option("--noise", request.noise, "Standard deviations, in voxels")->delimiter(',');
  app.add_option("--sigma", request.sigma, "Standard deviations of normals, or auto")->delimiter(',');
  app.add_option("--placement", request.placement)->check(CLI::IsMember(pdc::eval::kPlacements));
  app.add_flag("--confidence", request.confidence,
               "Also the rank correlation of the vertices' lack of confidence with their errors");
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  pdc::eval::run(request);
}
