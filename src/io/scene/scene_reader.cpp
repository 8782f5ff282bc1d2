#include "pdc/io/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_shapes.h"
#include "io/scene/yaml_value.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

using detail::YamlMap;
using detail::YamlValue;

Box readBox(const YamlValue& value) {
  const std::vector<YamlValue> corners = value.list(2);
  const Box box{corners[0].vector(), corners[1].vector()};
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.lo[axis] < box.hi[axis]))
      value.fail(fmt::format("box must grow from its first to its second corner, not go from {} to {} along {}",
                             box.lo[axis], box.hi[axis], "xyz"[axis]));
  return box;
}

double readVoxelSize(const YamlValue& self, const YamlMap& scene, const Box& box) {
  if (scene.has("voxel_size") == scene.has("resolution"))
    self.fail("scene needs either resolution or voxel_size, not both or none");
  if (scene.has("voxel_size")) return scene["voxel_size"].positiveNumber();
  const Vec3d size = box.hi - box.lo;
  return std::max({size.x, size.y, size.z}) / static_cast<double>(scene["resolution"].integer(1, kMaxVoxelsPerAxis));
}

double readSigma(const YamlValue& value) {
  const double sigma = value.text() == "inf" ? std::numeric_limits<double>::infinity() : value.number();
  if (sigma < 0) value.failNot("0 or more, or inf");
  return sigma;
}

bool readAcceptance(const YamlValue& value) {
  const std::string text = value.text();
  if (text != "error" && text != "outside") value.failNot("error or outside");
  return text == "outside";
}

SceneExpectation readExpectation(const YamlValue& value) {
  const YamlMap p(value, {"euler", "area", "volume", "tolerance"});
  SceneExpectation expect;
  constexpr long long kLargest = 1'000'000'000'000;
  if (p.has("euler")) expect.eulerNumber = p["euler"].integer(-kLargest, kLargest);
  if (p.has("area")) expect.area = p["area"].positiveNumber();
  if (p.has("volume")) expect.volume = p["volume"].positiveNumber();
  if (p.has("tolerance")) expect.relativeTolerance = p["tolerance"].positiveNumber();
  return expect;
}

}  // namespace

Scene readScene(const std::filesystem::path& path, bool acceptNonFinite) {
  const detail::YamlDocument document = detail::readYaml(path);
  const YamlValue self(document, *document.root, "scene");
  // What stands under definitions is there for its anchors only.
  const YamlMap p(
      self, {"definitions", "name", "box", "resolution", "voxel_size", "sigma_n", "iso", "nan", "expect", "shape"});
  Scene scene;
  if (p.has("name")) scene.name = p["name"].text();
  scene.box = readBox(p["box"]);
  scene.voxelSize = readVoxelSize(self, p, scene.box);
  if (p.has("sigma_n")) scene.sigmaNormal = readSigma(p["sigma_n"]);
  scene.iso = p.number("iso", 0);
  scene.acceptNonFinite = acceptNonFinite || (p.has("nan") && readAcceptance(p["nan"]));
  if (p.has("expect")) scene.expect = readExpectation(p["expect"]);
  detail::SceneContext context{.folder = path.parent_path(), .acceptNonFinite = scene.acceptNonFinite};
  scene.field = detail::readShape(p["shape"], context);
  scene.warnings = std::move(context.warnings);
  return scene;
}

}  // namespace pdc
