#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_shapes.h"
#include "pdc/field/operators.h"

namespace pdc::detail {
namespace {

using SharpOperator = FieldPtr (*)(std::vector<FieldPtr>);
using SmoothOperator = FieldPtr (*)(std::vector<FieldPtr>, double);

FieldPtr readOperand(const YamlMap& parameters, SceneContext& context) { return readShape(parameters["of"], context); }

std::vector<FieldPtr> readOperands(const YamlValue& list, SceneContext& context) {
  std::vector<FieldPtr> operands;
  for (const YamlValue& item : list.list()) operands.push_back(readShape(item, context));
  return operands;
}

/// Reads a list of shapes, or a map with a list `of` and a fillet radius `smooth`.
FieldPtr readBoolean(const YamlValue& parameters, SceneContext& context, SharpOperator sharp, SmoothOperator smooth) {
  if (parameters.isList()) return sharp(readOperands(parameters, context));
  const YamlMap p(parameters, {"smooth", "of"});
  std::vector<FieldPtr> operands = readOperands(p["of"], context);
  return p.has("smooth") ? smooth(std::move(operands), p["smooth"].positiveNumber()) : sharp(std::move(operands));
}

FieldPtr readUnion(const YamlValue& parameters, SceneContext& context) {
  return readBoolean(parameters, context, unite, smoothUnite);
}

FieldPtr readIntersection(const YamlValue& parameters, SceneContext& context) {
  return readBoolean(parameters, context, intersect, smoothIntersect);
}

FieldPtr readDifference(const YamlValue& parameters, SceneContext& context) {
  return readBoolean(parameters, context, subtract, smoothSubtract);
}

FieldPtr readComplement(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"of"});
  return complement(readOperand(p, context));
}

FieldPtr readOffset(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"distance", "of"});
  return offset(readOperand(p, context), p["distance"].finiteNumber());
}

FieldPtr readShell(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"thickness", "of"});
  return shell(readOperand(p, context), p["thickness"].positiveNumber());
}

FieldPtr readTranslate(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"by", "of"});
  return translate(readOperand(p, context), p["by"].vector());
}

FieldPtr readRotate(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"axis", "degrees", "of"});
  return rotate(readOperand(p, context), p.vector("axis", {0, 0, 1}), p["degrees"].finiteNumber());
}

FieldPtr readScale(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"factor", "of"});
  const YamlValue& factor = p["factor"];
  FieldPtr operand = readOperand(p, context);
  return factor.isList() ? scale(std::move(operand), factor.positiveVector())
                         : scale(std::move(operand), factor.positiveNumber());
}

FieldPtr readMirror(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"axis", "of"});
  const std::string axis = p["axis"].text();
  if (axis != "x" && axis != "y" && axis != "z") p["axis"].failNot("x, y or z");
  return mirror(readOperand(p, context), axis[0] - 'x');
}

FieldPtr readRepeat(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"period", "count", "of"});
  std::array<int, 3> count{};
  if (p.has("count")) {
    const std::vector<YamlValue> items = p["count"].list(3);
    for (int axis = 0; axis < 3; ++axis)
      count[axis] = static_cast<int>(items[axis].integer(0, std::numeric_limits<int>::max()));
  }
  return repeat(readOperand(p, context), p["period"].vector(), count);
}

constexpr std::array kOperators{
    ShapeKind{"union", readUnion},           ShapeKind{"intersection", readIntersection},
    ShapeKind{"difference", readDifference}, ShapeKind{"complement", readComplement},
    ShapeKind{"offset", readOffset},         ShapeKind{"shell", readShell},
    ShapeKind{"translate", readTranslate},   ShapeKind{"rotate", readRotate},
    ShapeKind{"scale", readScale},           ShapeKind{"mirror", readMirror},
    ShapeKind{"repeat", readRepeat},
};

}  // namespace

std::span<const ShapeKind> sceneOperators() { return kOperators; }

}  // namespace pdc::detail
