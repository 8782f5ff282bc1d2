#pragma once

#include <ostream>
#include <random>
#include <string>

#include "pdc/field/field.h"

/// What must hold for every field, tested at random places with fixed seeds.
namespace pdc::test {

struct FieldCase {
  std::string name;
  FieldPtr field;
  /// The gradient has unit length wherever it can be told from differences.
  bool distance = false;
  /// A small box's bound is at most this much wider than twice its radius.
  double slope = 1;
  Box region{{-4, -4, -4}, {4, 4, 4}};
};

/// Prints the names of parameterised tests.
std::ostream& operator<<(std::ostream& out, const FieldCase& c);

class Random {
 public:
  explicit Random(unsigned seed) : mGenerator(seed) {}

  double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(mGenerator); }
  Vec3d in(const Box& box) { return {in(box.lo.x, box.hi.x), in(box.lo.y, box.hi.y), in(box.lo.z, box.hi.z)}; }
  /// A box about a point of `region`, its edges between `smallest` and `largest`, evenly on the scale of magnitudes.
  Box boxIn(const Box& region, double smallest, double largest);

 private:
  std::mt19937_64 mGenerator;
};

/// Gradients are central differences to 1e-5 wherever one-sided differences agree, which must be at most points.
void expectGradientsMatchDifferences(const FieldCase& c);
/// No value in a box lies outside the box's bound, for boxes of edges 1e-3 to 10; and no slope above lipschitz().
void expectBoundsHold(const FieldCase& c);
/// Bounds shrink with their boxes, down to edges of 1e-6.
void expectBoundsConverge(const FieldCase& c);
/// A point's value and gradient have the same bits in batches of any size, and with or without the gradient.
void expectBatchesAgree(const FieldCase& c);

}  // namespace pdc::test
