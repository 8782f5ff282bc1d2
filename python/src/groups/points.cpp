#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "convert.h"
#include "given_options.h"
#include "groups/groups.h"
#include "pdc/io/points/points_reader.h"
#include "pdc/points/reconstruct.h"
#include "polite_run.h"
#include "remedies.h"
#include "reports/points_report.h"

namespace pdc::python {
namespace {

/// Points, and what was odd in their file.
struct Points {
  PointCloud cloud;
  std::vector<std::string> warnings;
};

template <typename Number, typename Row>
void takeRows(const py::object& array, Buffer<Row>& rows) {
  if (!array.is_none()) copyRows(array.cast<Rows<Number>>(), rows);
}

/// Points of ("file", path), or of ("arrays", points, normals, sigmas, colours), the last three or some None.
Points openPoints(const py::tuple& source) {
  Points points;
  if (source[0].cast<std::string>() == "file") {
    const auto path = source[1].cast<std::filesystem::path>();
    const auto warn = [&](const std::string& line) { points.warnings.push_back(inPythonsWords(line)); };
    points.cloud = makePolitely(py::none(), [&](const Monitor&) { return readPoints(path, {.warn = warn}); });
    return points;
  }
  takeRows<double>(source[1], points.cloud.positions);
  takeRows<float>(source[2], points.cloud.normals);
  takeRows<float>(source[3], points.cloud.sigmas);
  takeRows<std::uint8_t>(source[4], points.cloud.colours);
  return points;
}

MixtureOptions mixtureOptionsOf(const GivenOptions& asked) {
  MixtureOptions options;
  asked.take("sigma0", options.sigma0);
  asked.take("alpha", options.alpha);
  asked.take("levels", options.levels);
  asked.take("iterations", options.iterations);
  return options;
}

std::pair<MeshHandle, py::object> mixture(const py::tuple& source, const py::dict& given, const py::object& progress) {
  const GivenOptions asked(given);
  const MixtureOptions options = mixtureOptionsOf(asked);
  const Points points = openPoints(source);
  MixtureReport report;
  std::size_t gaussians = 0;
  MeshHandle mesh(makePolitely(progress, asked.threads(), [&](const Monitor& monitor) {
    const GaussianMixture made = gaussianMixture(points.cloud, options, &report, monitor);
    gaussians = made.size();
    return mixtureMesh(made);
  }));
  nlohmann::ordered_json json = toJson(report);
  json.update({{"gaussians", gaussians}, {"warnings", points.warnings}});
  return {std::move(mesh), toPython(json)};
}

/// The surface, its report, and the covariance mesh.
std::tuple<MeshHandle, py::object, MeshHandle> reconstructed(const py::tuple& source, const py::dict& given,
                                                             const py::object& progress) {
  const GivenOptions asked(given);
  ReconstructOptions options;
  options.mixture = mixtureOptionsOf(asked);
  asked.take("overlap", options.triangulation.leastOverlap);
  asked.take("close", options.triangulation.close);
  asked.take("subdivide", options.subdivisions);
  asked.take("voxel_size", options.voxelSize);
  const Points points = openPoints(source);
  ReconstructReport report;
  Mesh covarianceMesh;
  Mesh mesh = makePolitely(progress, asked.threads(), [&](const Monitor& monitor) {
    return reconstruct(points.cloud, options, &report, &covarianceMesh, monitor);
  });
  nlohmann::ordered_json json = toJson(report);
  json.update({{"vertices", mesh.positions.size()},
               {"triangles", mesh.triangles.size()},
               {"seconds",
                {{"mixture", report.secondsMixture},
                 {"triangulate", report.secondsTriangulate},
                 {"subdivide", report.secondsSubdivide},
                 {"contour", report.secondsContour}}},
               {"warnings", points.warnings}});
  return {MeshHandle(std::move(mesh)), toPython(json), MeshHandle(std::move(covarianceMesh))};
}

}  // namespace

void addPoints(py::module_& module) {
  module.def("mixture", &mixture);
  module.def("reconstruct", &reconstructed);
}

}  // namespace pdc::python
