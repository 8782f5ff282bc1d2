#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/scene/scene_shapes.h"
#include "pdc/field/formula.h"
#include "pdc/field/noise.h"
#include "pdc/field/primitives.h"

namespace pdc::detail {
namespace {

constexpr Vec3d kOrigin{0, 0, 0};
constexpr Vec3d kUp{0, 0, 1};

FieldPtr readSphere(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"center", "radius"});
  return sphere(p.vector("center", kOrigin), p["radius"].positiveNumber());
}

FieldPtr readBox(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"center", "size"});
  return box(p.vector("center", kOrigin), p["size"].positiveVector() * 0.5);
}

FieldPtr readRoundedBox(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"center", "size", "radius"});
  return roundedBox(p.vector("center", kOrigin), p["size"].positiveVector() * 0.5, p["radius"].positiveNumber());
}

FieldPtr readPlane(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"point", "normal"});
  return plane(p.vector("point", kOrigin), p["normal"].vector());
}

FieldPtr readCylinder(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"from", "to", "radius"});
  return cylinder(p["from"].vector(), p["to"].vector(), p["radius"].positiveNumber());
}

FieldPtr readCappedCone(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"from", "to", "radius_from", "radius_to"});
  return cappedCone(p["from"].vector(), p["to"].vector(), p["radius_from"].finiteNumber(),
                    p["radius_to"].finiteNumber());
}

FieldPtr readTorus(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"center", "axis", "radius", "tube"});
  return torus(p.vector("center", kOrigin), p.vector("axis", kUp), p["radius"].positiveNumber(),
               p["tube"].positiveNumber());
}

FieldPtr readCapsule(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"from", "to", "radius"});
  return capsule(p["from"].vector(), p["to"].vector(), p["radius"].positiveNumber());
}

FieldPtr readEllipsoid(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"center", "semi_axes"});
  return ellipsoid(p.vector("center", kOrigin), p["semi_axes"].positiveVector());
}

FieldPtr readGyroid(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"period", "thickness"});
  return gyroid(p["period"].positiveNumber(), p.number("thickness", 0));
}

FieldPtr readSimplexNoise(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"seed", "octaves", "frequency", "gain", "lacunarity", "amplitude"});
  NoiseOptions options;
  if (p.has("seed"))
    options.seed = static_cast<std::uint32_t>(p["seed"].integer(0, std::numeric_limits<std::uint32_t>::max()));
  if (p.has("octaves")) options.octaves = static_cast<int>(p["octaves"].integer(1, 16));
  options.frequency = p.number("frequency", options.frequency);
  options.gain = p.number("gain", options.gain);
  options.lacunarity = p.number("lacunarity", options.lacunarity);
  options.amplitude = p.number("amplitude", options.amplitude);
  return simplexNoise(options);
}

FieldPtr readFormula(const YamlValue& parameters, SceneContext&) {
  const YamlMap p(parameters, {"expression", "lipschitz"});
  std::optional<double> lipschitz;
  if (p.has("lipschitz")) lipschitz = p["lipschitz"].positiveNumber();
  return formula(p["expression"].text(), lipschitz);
}

constexpr std::array kPrimitives{
    ShapeKind{"sphere", readSphere},
    ShapeKind{"box", readBox},
    ShapeKind{"rounded_box", readRoundedBox},
    ShapeKind{"plane", readPlane},
    ShapeKind{"cylinder", readCylinder},
    ShapeKind{"capped_cone", readCappedCone},
    ShapeKind{"torus", readTorus},
    ShapeKind{"capsule", readCapsule},
    ShapeKind{"ellipsoid", readEllipsoid},
    ShapeKind{"gyroid", readGyroid},
    ShapeKind{"simplex_noise", readSimplexNoise},
    ShapeKind{"formula", readFormula},
    ShapeKind{"grid", readGridShape},
    ShapeKind{"mesh", readMeshShape},
};

}  // namespace

std::span<const ShapeKind> scenePrimitives() { return kPrimitives; }

}  // namespace pdc::detail
