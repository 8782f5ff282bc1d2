#include "sample/implicit/simplified_fields.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <utility>

#include "sample/implicit/cube_box.h"
#include "sample/implicit/cube_descent.h"

namespace pdc::detail {
namespace {

/// Fields of no more parts are taken as they are.
constexpr std::size_t kFewParts = 8;

/// Blocks look beyond their points for difference quotients, see root_normals.cpp.
constexpr double kMargin = 2e-3;  // voxels

}  // namespace

/// A cube of the descent. Its children are made by whoever asks first; who comes second with the same one drops it.
struct SimplifiedFields::Node {
  FieldPtr own;        ///< Null if the parent's field is not simpler here.
  const Field* field;  ///< In this cube.
  mutable std::array<std::atomic<Node*>, 8> children{};

  Node(FieldPtr simpler, const Field& parent) : own(std::move(simpler)), field(own ? own.get() : &parent) {}
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node() {
    for (const std::atomic<Node*>& c : children) delete c.load(std::memory_order_relaxed);
  }
};

SimplifiedFields::SimplifiedFields(FieldPtr field, const LatticeFrame& frame, const Coord& blocks)
    : mField(std::move(field)), mFrame(frame), mTopLevel(topLevel(blocks)) {
  if (mField->parts() <= kFewParts) return;
  mRoot = std::make_unique<Node>(simplify(*mField, {0, 0, 0}, mTopLevel), *mField);
}

SimplifiedFields::~SimplifiedFields() = default;

LocalField SimplifiedFields::in(const Coord& cube, int level) const {
  if (!mRoot || level > mTopLevel) return LocalField(*mField);
  for (int axis = 0; axis < 3; ++axis)
    if (cube[axis] < 0 || cube[axis] >> (mTopLevel - level) != 0) return LocalField(*mField);
  const Node* node = mRoot.get();
  for (int l = mTopLevel; l > std::max(level, 1) && node->field->parts() > 1;) {
    --l;
    node = child(*node, {cube[0] >> (l - level), cube[1] >> (l - level), cube[2] >> (l - level)}, l);
  }
  if (level > 0 || node->field->parts() == 1) return LocalField(*node->field);
  FieldPtr simpler = simplify(*node->field, cube, 0);
  return simpler ? LocalField(std::move(simpler)) : LocalField(*node->field);
}

const SimplifiedFields::Node* SimplifiedFields::child(const Node& parent, const Coord& cube, int level) const {
  std::atomic<Node*>& place = parent.children[(cube[0] & 1) << 2 | (cube[1] & 1) << 1 | (cube[2] & 1)];
  Node* node = place.load(std::memory_order_acquire);
  if (node != nullptr) return node;
  auto made = std::make_unique<Node>(simplify(*parent.field, cube, level), *parent.field);
  if (place.compare_exchange_strong(node, made.get(), std::memory_order_acq_rel)) node = made.release();
  return node;
}

FieldPtr SimplifiedFields::simplify(const Field& field, const Coord& cube, int level) const {
  return field.simplified(cubeBox(mFrame, cube, level, kMargin));
}

}  // namespace pdc::detail
