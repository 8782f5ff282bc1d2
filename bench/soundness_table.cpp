// Self-intersections of meshes by placement, beside OpenVDB's own mesher: a table in Markdown.
// usage: soundness_table FILE... (.vdb and .yaml)

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "pdc/extract/contour.h"
#include "pdc/io/scene_reader.h"
#include "pdc/io/vdb_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/field_source.h"
#include "pdc/sample/grid_source.h"

namespace {

std::size_t triangleCount(const pdc::Mesh& mesh) { return 2 * mesh.quads.size() + mesh.triangles.size(); }

/// Offending pairs per thousand triangles; one digit more than it takes to tell none from few.
std::string hits(const pdc::Mesh& mesh) {
  const std::size_t pairs = pdc::selfIntersections(mesh).pairs.size();
  return pairs == 0
             ? "0"
             : fmt::format("{:.3g}", 1e3 * static_cast<double>(pairs) / static_cast<double>(triangleCount(mesh)));
}

/// Edges and vertices at which the mesh is no closed, coherently oriented manifold.
std::size_t faults(const pdc::Mesh& mesh) {
  const pdc::MeshReport r = pdc::analyze(mesh);
  return r.boundaryEdges + r.nonManifoldEdges + r.nonManifoldVertices + r.misorientedEdges;
}

pdc::Mesh volumeToMesh(const openvdb::FloatGrid& grid, double iso) {
  openvdb::tools::VolumeToMesh mesher(iso, 0);
  mesher(grid);
  pdc::Mesh mesh;
  for (std::size_t i = 0; i < mesher.pointListSize(); ++i) {
    const openvdb::Vec3s& p = mesher.pointList()[i];
    mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (std::size_t i = 0; i < mesher.polygonPoolListSize(); ++i) {
    const openvdb::tools::PolygonPool& pool = mesher.polygonPoolList()[i];
    for (std::size_t k = 0; k < pool.numQuads(); ++k) {
      const openvdb::Vec4I& q = pool.quad(k);
      mesh.quads.push_back({q[0], q[1], q[2], q[3]});
    }
  }
  return mesh;
}

void printRow(const std::string& name, const pdc::HermiteSource& source, const std::string& peer) {
  for (const double sigma : {0.0, 0.01, 0.1, 1.0, std::numeric_limits<double>::infinity()}) {
    pdc::ContourReport report;
    const pdc::Mesh certified = pdc::contour(source, {.sigmaNormal = sigma}, &report);
    const pdc::Mesh free = pdc::contour(source, {.sigmaNormal = sigma, .placement = pdc::Placement::kFree});
    const std::size_t n = certified.positions.size();
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.2f} % | {:.2f} % | {} | {} | {} |\n", name, sigma, n,
               faults(certified), hits(certified), report.uncertified,
               1e2 * static_cast<double>(report.shortened) / static_cast<double>(n),
               1e2 * static_cast<double>(report.drawnIn) / static_cast<double>(n), report.fans, hits(free), peer);
    std::fflush(stdout);
  }
}

void printFile(const std::filesystem::path& path) {
  if (path.extension() == ".vdb") {
    const auto grid = pdc::readVdbGrid(path);
    const pdc::GridSource source(grid);
    const auto asFloat = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
    printRow(path.stem().string(), source, asFloat ? hits(volumeToMesh(*asFloat, source.iso())) : "");
  } else {
    const pdc::Scene scene = pdc::readScene(path);
    printRow(path.stem().string(),
             pdc::FieldSource(scene.field, {.box = scene.box, .voxelSize = scene.voxelSize, .iso = scene.iso}), "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  fmt::print(
      "| input | σn | vertices | open, non-manifold, misoriented | hits | uncertified | shortened | drawn in | fans "
      "| hits, free | hits, VolumeToMesh |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < argc; ++i) {
    try {
      printFile(argv[i]);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}: {}\n", argv[i], e.what());
    }
  }
}
