#include "io/scene/scene_shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "io/file/closest_word.h"

namespace pdc::detail {
namespace {

// This is far more than anyone nests by hand, and little enough for any thread's stack, here and when the field is
// evaluated.
constexpr int kMaxDepth = 100;
// Aliases can make a small file stand for any number of shapes.
constexpr std::size_t kMaxShapes = 100'000;

const ShapeKind* findShape(std::string_view name) {
  for (const auto& kinds : {scenePrimitives(), sceneOperators()})
    for (const ShapeKind& kind : kinds)
      if (kind.name == name) return &kind;
  return nullptr;
}

std::vector<std::string> knownShapes() {
  std::vector<std::string> names;
  for (const auto& kinds : {scenePrimitives(), sceneOperators()})
    for (const ShapeKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

}  // namespace

FieldPtr readShape(const YamlValue& value, SceneContext& context) {
  if (context.depth == kMaxDepth) value.fail(fmt::format("shapes are nested deeper than {}", kMaxDepth));
  if (++context.shapes > kMaxShapes) value.fail(fmt::format("more than {} shapes", kMaxShapes));
  const auto entries = value.entries();
  if (entries.size() != 1)
    value.fail(fmt::format("a shape is a map with one key, its name; this one has {}", entries.size()));
  const auto& [name, parameters] = entries.front();
  const ShapeKind* kind = findShape(name.name());
  if (kind == nullptr) {
    const std::vector<std::string> known = knownShapes();
    name.fail(fmt::format("unknown shape \'{}\'{}; known are {}", name.name(), didYouMean(name.name(), known),
                          fmt::join(known, ", ")));
  }

  ++context.depth;
  try {
    FieldPtr field = kind->read(parameters, context);
    --context.depth;
    return field;
  } catch (const YamlError&) {
    throw;
  } catch (const Error& error) {
    name.fail(error.what());
  } catch (const std::invalid_argument& error) {
    name.fail(error.what());
  }
}

}  // namespace pdc::detail
