#pragma once

#include <memory>
#include <utility>

#include "pdc/field/field.h"
#include "pdc/sample/lattice.h"
#include "sample/implicit/lattice_frame.h"

namespace pdc::detail {

/// A field that is owned elsewhere, or only here.
class LocalField {
 public:
  explicit LocalField(const Field& field) : mField(&field) {}
  explicit LocalField(FieldPtr field) : mOwn(std::move(field)), mField(mOwn.get()) {}

  [[nodiscard]] const Field& operator*() const { return *mField; }
  [[nodiscard]] const Field* operator->() const { return mField; }

 private:
  FieldPtr mOwn;
  const Field* mField;
};

/// What a field of many parts comes to in the cubes of the descent over a lattice (see cube_descent.h): in each cube a
/// field that equals it, bit for bit, wherever the cube's blocks look at it, made of the parts that decide there. Each
/// is made from its parent's when it is first asked for, and kept, but for those of blocks; that takes memory for the
/// cubes that are asked for. Any thread may ask at any time, without waiting for others.
class SimplifiedFields {
 public:
  /// \param blocks of the lattice along each axis.
  SimplifiedFields(FieldPtr field, const LatticeFrame& frame, const Coord& blocks);
  ~SimplifiedFields();
  SimplifiedFields(const SimplifiedFields&) = delete;
  SimplifiedFields& operator=(const SimplifiedFields&) = delete;

  /// The field in the cube of 2^level blocks along an axis; where none is simpler, or the cube does not lie in that of
  /// all blocks, the whole one. It is valid as long as this.
  [[nodiscard]] LocalField in(const Coord& cube, int level) const;

 private:
  struct Node;

  [[nodiscard]] const Node* child(const Node& parent, const Coord& cube, int level) const;
  [[nodiscard]] FieldPtr simplify(const Field& field, const Coord& cube, int level) const;

  FieldPtr mField;
  LatticeFrame mFrame;
  int mTopLevel;
  std::unique_ptr<Node> mRoot;  ///< Null if the field has few parts.
};

}  // namespace pdc::detail
