#include "sample/implicit/missing_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "pdc/error.h"
#include "pdc/field/formula.h"
#include "pdc/sample/implicit/field_source.h"
#include "sample/implicit/counting_field.h"

namespace pdc {
namespace {

using test::CountingField;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Box kUnitBox{{-1, -1, -1}, {1, 1, 1}};

std::string messageOfSampling(const FieldSource& source) {
  try {
    (void)source.surfaceBlocks({});
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(MissingPoints, AreAnErrorOfTheSource) {
  // Every lattice point is looked at, since the bound says that each block may hold surface.
  const auto boundOf = [](const Box&) { return Interval{-2, 2}; };
  const auto sourceOf = [&](const std::function<double(const Vec3d&)>& f, bool open) {
    const auto gradient = [](const Vec3d&) { return Vec3d{1, 0, 0}; };
    return FieldSource(std::make_shared<CountingField>(f, gradient, boundOf),
                       {.box = {{-1, -1, -1}, {1.5, 1, 1}}, .voxelSize = 0.25, .open = open});
  };
  const std::string remedy = "; --nan outside (acceptNonFinite in C++) takes such values as outside";
  for (const bool open : {false, true}) {
    EXPECT_EQ(messageOfSampling(sourceOf([](const Vec3d& p) { return p.x > 1.5 ? kNan : p.x; }, open)), "")
        << "beyond the box";
    EXPECT_EQ(messageOfSampling(sourceOf([](const Vec3d& p) { return p.x > 1.25 ? -kInfinity : p.x; }, open)),
              "81 values at lattice points are not finite, the first at (1.5, -1, -1) is -inf" + remedy);
    EXPECT_EQ(messageOfSampling(sourceOf([](const Vec3d& p) { return p.x < 0 ? kNan : p.x - 0.1; }, open)),
              "324 values at lattice points are not finite, the first at (-1, -1, -1) is nan" + remedy);
    // The corner of eight blocks.
    const auto pole = [](const Vec3d& p) { return p == Vec3d{1, 1, 1} ? 1 / (p.x - 1) : p.x; };
    EXPECT_EQ(messageOfSampling(sourceOf(pole, open)),
              "1 value at a lattice point is not finite: at (1, 1, 1) it is inf" + remedy);
  }
}

TEST(MissingPoints, DoNotDependOnThreads) {
  const auto field = formula("sqrt(x * y + z) - 0.3");
  const FieldSource source(field, {.box = kUnitBox, .voxelSize = 1.0 / 32});
  const std::string all = messageOfSampling(source);
  EXPECT_NE(all.find(" values at lattice points are not finite, the first at (-1, "), std::string::npos) << all;
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(messageOfSampling(source), all);
  }
}

TEST(MissingPoints, CountEachPointOnceAndNoneBeyondTheLattice) {
  const FieldPtr field = formula("log(x - 2)");
  detail::MissingPoints missing(*field, {{1, 0, 0}, 0.5}, {4, 4, 4});
  EXPECT_NO_THROW(missing.throwIfAny());
  missing.add({5, 0, 0});
  EXPECT_NO_THROW(missing.throwIfAny());
  for (int twice = 0; twice < 2; ++twice) {
    missing.add({2, 4, 0});
    missing.add({1, 4, 3});
  }
  EXPECT_NO_THROW(missing.throwIfMany());
  std::string message;
  try {
    missing.throwIfAny();
  } catch (const Error& e) {
    message = e.what();
  }
  EXPECT_EQ(message.substr(0, 79), "2 values at lattice points are not finite, the first at (1.5, 2, 1.5) is nan; -");
}

}  // namespace
}  // namespace pdc
