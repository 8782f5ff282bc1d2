#include "field/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pdc::detail {
namespace {

void require(bool holds, const char* what, const char* limit, double value) {
  if (!holds) throw std::invalid_argument(fmt::format("{} must be {}, not {}", what, limit, value));
}

void require(bool holds, const char* what, const char* limit, const Vec3d& v) {
  if (!holds) throw std::invalid_argument(fmt::format("{} must be {}, not ({}, {}, {})", what, limit, v.x, v.y, v.z));
}

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void requirePositive(const char* what, double value) {
  require(std::isfinite(value) && value > 0, what, "positive and finite", value);
}

void requirePositive(const char* what, const Vec3d& value) {
  require(finite(value) && value.x > 0 && value.y > 0 && value.z > 0, what, "positive and finite", value);
}

void requireNotNegative(const char* what, double value) {
  require(std::isfinite(value) && value >= 0, what, "finite and not negative", value);
}

void requireFinite(const char* what, double value) { require(std::isfinite(value), what, "finite", value); }

void requireFinite(const char* what, const Vec3d& value) { require(finite(value), what, "finite", value); }

Vec3d requireDirection(const char* what, const Vec3d& value) {
  const double size = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
  require(finite(value) && size > 0, what, "finite and not zero", value);
  // Scaled first, so that squares neither overflow nor vanish.
  const Vec3d scaled{value.x / size, value.y / size, value.z / size};
  return scaled * (1 / length(scaled));
}

void requireField(const char* what, const FieldPtr& field) {
  if (!field) throw std::invalid_argument(fmt::format("{} must not be null", what));
}

}  // namespace pdc::detail
