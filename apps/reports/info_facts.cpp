#include "reports/info_facts.h"

#include "io/vdb/grid_warnings.h"
#include "pdc/error.h"
#include "pdc/grid/describe_grid.h"
#include "pdc/io/open_input.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/mesh/vertex_covariances.h"
#include "pdc/sample/implicit/field_source.h"
#include "reports/json_report.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Vec3d& v) { return Json::array({v.x, v.y, v.z}); }

Json toJson(const VdbGridInfo& grid) {
  Json facts{{"name", grid.name},
             {"value_type", grid.valueType},
             {"class", grid.gridClass},
             {"transform", grid.transform},
             {"voxel_size", grid.voxelSize},
             {"saved_as_half", grid.savedAsHalf},
             {"contourable", grid.contourable},
             {"active_voxels", grid.activeVoxels}};
  if (grid.activeVoxels > 0) {
    facts["index_lo"] = grid.boundsLo;
    facts["index_hi"] = grid.boundsHi;
  }
  if (grid.contourable) {
    facts["background"] = grid.background;
    if (grid.activeVoxels > 0) {
      facts["value_min"] = grid.valueMin;
      facts["value_max"] = grid.valueMax;
    }
  }
  return facts;
}

/// What helps to choose an isovalue and steps. Values of other types than float and double are not looked at, and a
/// grid that cannot be read as a volume is no failure here.
void describe(const VdbGridInfo& info, const openvdb::GridBase::ConstPtr& grid, Json& facts) {
  if (!(info.valueType == "float" || info.valueType == "double") || info.activeVoxels == 0) return;
  try {
    const GridDescription d = describeGrid(grid);
    facts["read_as"] = nameOf(d.meaning.gridClass);
    facts["inside"] = nameOf(d.meaning.inside);
    facts["iso"] = d.meaning.iso;
    facts["slope"] = d.meaning.slope;
    facts["half_width_voxels"] = d.meaning.halfWidth;
    facts["non_finite"] = d.nonFinite;
    facts["parts"] = d.parts;
    facts["cavities"] = d.cavities;
    facts["noise_voxels"] = d.noise;
    facts["histogram"] = d.histogram;
    for (const std::string& line : detail::gridWarnings(d.meaning, detail::OptionStyle::kProgram))
      facts["doubts"].push_back(line);
  } catch (const Error& error) {
    facts["doubts"].push_back(error.what());
  }
}

Json gridFacts(const std::filesystem::path& path) {
  Json facts{{"kind", "grids"}, {"grids", Json::array()}};
  visitVdbGrids(path, [&](const VdbGridInfo& info, const openvdb::GridBase::Ptr& grid) {
    facts["grids"].push_back(toJson(info));
    describe(info, grid, facts["grids"].back());
  });
  return facts;
}

Json sceneFacts(const std::filesystem::path& path) {
  const Scene scene = readScene(path, true);  // What is odd in grids is no failure here.
  Json cells = Json::array();
  for (int axis = 0; axis < 3; ++axis)
    cells.push_back(voxelsAlong(scene.box.hi[axis] - scene.box.lo[axis], scene.voxelSize));
  const std::optional<double> sigma = scene.sigmaNormal;
  Json facts{{"kind", "scene"}};
  if (!scene.name.empty()) facts["name"] = scene.name;
  facts.update({{"box_lo", toJson(scene.box.lo)},
                {"box_hi", toJson(scene.box.hi)},
                {"voxel_size", scene.voxelSize},
                {"cells", cells},
                {"iso", scene.iso},
                {"sigma_n", sigmaNormalJson(sigma)}});
  return facts;
}

/// What a covariance mesh holds; null for a mesh that lacks one of its properties.
Json covarianceFacts(const Mesh& mesh) {
  for (const char* name : kCovarianceNames)
    if (const VertexProperty* property = mesh.property(name); property == nullptr || property->components != 1)
      return nullptr;
  const CovarianceReport report = analyzeCovariances(mesh);
  Json facts{{"positive_definite", report.definite}};
  if (report.firstOther) facts["first_other"] = *report.firstOther;
  facts["least_eigenvalue"] = report.leastEigenvalue;
  facts["largest_eigenvalue"] = report.largestEigenvalue;
  return facts;
}

Json factsByKind(const std::filesystem::path& path) {
  switch (inputKind(path)) {
    case InputKind::kGrid:
      return gridFacts(path);
    case InputKind::kScene:
      return sceneFacts(path);
    default:
      return meshFileFacts(readMeshFile(path));
  }
}

}  // namespace

Json meshFacts(const MeshFile& file, const MeshReport& report) {
  Json facts{{"kind", "mesh"},
             {"vertices", report.vertices},
             {"quads", report.quads},
             {"triangles", report.triangles},
             {"edges", report.edges},
             {"euler_number", report.eulerNumber},
             {"components", report.components},
             {"boundary_edges", report.boundaryEdges},
             {"non_manifold_edges", report.nonManifoldEdges},
             {"non_manifold_vertices", report.nonManifoldVertices},
             {"misoriented_edges", report.misorientedEdges},
             {"unused_vertices", report.unusedVertices},
             {"degenerate_faces", report.degenerateFaces},
             {"duplicate_faces", report.duplicateFaces},
             {"non_finite_vertices", report.nonFiniteVertices},
             {"area", report.area},
             {"volume", report.volume},
             {"bounds_lo", toJson(report.bounds.lo)},
             {"bounds_hi", toJson(report.bounds.hi)}};
  if (file.mesh.origin != Vec3d{0, 0, 0}) facts["origin"] = toJson(file.mesh.origin);
  facts["warnings"] = file.warnings;
  return facts;
}

Json meshFileFacts(const MeshFile& file) {
  Json facts = meshFacts(file, analyze(file.mesh));
  for (const VertexProperty& property : file.mesh.properties)
    facts["properties"].push_back(
        {{"name", property.name}, {"type", typeName(property)}, {"components", property.components}});
  if (hasVertexCovariances(file.mesh))
    if (Json covariances = covarianceFacts(file.mesh); !covariances.is_null()) facts["covariances"] = covariances;
  return facts;
}

Json gatherFacts(const std::filesystem::path& path) {
  Json facts{{"file", shownPath(path)}};
  facts.update(factsByKind(path));
  return facts;
}

}  // namespace pdc
