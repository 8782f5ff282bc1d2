#include "fuzz/targets.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "io/file/temporary_folder.h"
#include "pdc/extract/contour.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/io/volume/volume_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/dense/dense_source.h"
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

/// A name with the suffix of the format that the bytes begin as.
const char* nameOfVolume(std::string_view bytes) {
  if (bytes.starts_with("NRRD")) return "a.nrrd";
  if (bytes.starts_with("\x93")) return "a.npy";
  if (bytes.starts_with("PK")) return "a.npz";
  if (bytes.starts_with("#INR")) return "a.inr";
  if (bytes.starts_with("Obj") || bytes.starts_with("NDims")) return "a.mha";
  return bytes.starts_with("\x1f\x8b") ? "a.nii.gz" : "a.nii";
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

void fuzzVolume(std::string_view bytes) {
  const TemporaryFolder folder;
  const auto path = folder / nameOfVolume(bytes);
  writeContents(path, bytes);
  fuzzVolumeFile(path);
}

void fuzzVolumeFile(const std::filesystem::path& path) {
  VolumeReadOptions options{.volumeIndex = 0};
  if (path.filename().string().find(".raw") != std::string::npos) options.raw = parseRawVolume("10x10x10:i16");
  const DenseVolume volume = readVolume(path, options);
  constexpr std::int64_t kMaxPoints = 1 << 18;
  if (volume.view.size[0] * volume.view.size[1] > kMaxPoints / volume.view.size[2]) return;
  contourAndCheck(DenseSource(volume.view, LatticeMap(volume.linear, volume.translation), {.acceptNonFinite = true}),
                  0.05);
}

}  // namespace pdc
