#include "fuzz/targets.h"

#include <algorithm>
#include <cstdlib>

#include "io/file/temporary_folder.h"
#include "pdc/extract/contour.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

void contourAndCheck(const HermiteSource& source, double sigmaNormal) {
  const MeshReport r = analyze(contour(source, {.sigmaNormal = sigmaNormal}));
  const bool sound = r.boundaryEdges == 0 && r.nonManifoldEdges == 0 && r.nonManifoldVertices == 0 &&
                     r.misorientedEdges == 0 && r.duplicateFaces == 0 && r.unusedVertices == 0;
  if (!sound) std::abort();
}

}  // namespace

void fuzzScene(std::string_view bytes) {
  const TemporaryFolder folder;
  writeContents(folder / "scene.yaml", bytes);
  const Scene scene = readScene(folder / "scene.yaml");
  constexpr double kResolution = 16;
  const Vec3d size = scene.box.hi - scene.box.lo;
  const double voxelSize =
      std::max({scene.voxelSize, size.x / kResolution, size.y / kResolution, size.z / kResolution});
  contourAndCheck(FieldSource(scene.field, {.box = scene.box, .voxelSize = voxelSize, .iso = scene.iso}),
                  scene.sigmaNormal.value_or(kPapersSigmaNormal));
}

void fuzzVdb(std::string_view bytes) {
  const TemporaryFolder folder;
  writeContents(folder / "grid.vdb", bytes);
  constexpr std::size_t kMaxVoxels = 1 << 18;
  for (const VdbGridInfo& info : listVdbGrids(folder / "grid.vdb"))
    if (info.contourable && info.activeVoxels <= kMaxVoxels)
      contourAndCheck(GridSource(readVdbGrid(folder / "grid.vdb", info.name), {.acceptNonFinite = true}), 0.05);
}

}  // namespace pdc
