#include "pdc/field/function_field.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "field/field_checks.h"

namespace pdc {
namespace {

using test::FieldCase;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double wave(const Vec3d& p) { return std::sin(p.x) * std::cos(2 * p.y) + p.z; }
Vec3d waveGradient(const Vec3d& p) {
  return {std::cos(p.x) * std::cos(2 * p.y), -2 * std::sin(p.x) * std::sin(2 * p.y), 1};
}

std::vector<FieldCase> functions() {
  return {{"withGradient", functionField({.value = wave, .gradient = waveGradient, .lipschitz = 2.5}), false, 2.5},
          {"withDifferences", functionField({.value = wave, .lipschitz = 2.5}), false, 2.5}};
}

class FunctionField : public testing::TestWithParam<FieldCase> {};

TEST_P(FunctionField, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }
TEST_P(FunctionField, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(FunctionField, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(FunctionField, BatchesAgree) { test::expectBatchesAgree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, FunctionField, testing::ValuesIn(functions()), testing::PrintToStringParamName());

TEST(FunctionField, UsesWhatItIsGiven) {
  const Vec3d p{0.3, 0.2, -0.5};
  const auto exact = functionField({.value = wave, .gradient = waveGradient});
  EXPECT_EQ(exact->valueAt(p), wave(p));
  EXPECT_EQ(exact->gradientAt(p), waveGradient(p));
  EXPECT_EQ(exact->lipschitz(), kInfinity);
  EXPECT_FALSE(exact->bound({p, p}).bounded());
  const auto differences = functionField({.value = wave, .lipschitz = 2.5});
  EXPECT_NEAR(length(differences->gradientAt(p) - waveGradient(p)), 0, 1e-9);
  EXPECT_EQ(differences->lipschitz(), 2.5);
}

TEST(FunctionField, BoundKnowsNothingWhereThereIsNoValue) {
  const auto field = functionField({.value = [](const Vec3d&) { return kNan; }, .lipschitz = 1});
  EXPECT_FALSE(field->bound({{0, 0, 0}, {1, 1, 1}}).bounded());
}

TEST(FunctionField, LetsExceptionsOfTheFunctionThrough) {
  const auto field = functionField({.value = [](const Vec3d&) -> double { throw std::domain_error("no value"); }});
  EXPECT_THROW((void)field->valueAt({0, 0, 0}), std::domain_error);
  EXPECT_THROW((void)field->gradientAt({0, 0, 0}), std::domain_error);
}

TEST(FunctionField, RefusesBadArguments) {
  EXPECT_THROW(functionField({}), std::invalid_argument);
  for (const double bad : {0.0, -1.0, kNan, kInfinity})
    EXPECT_THROW(functionField({.value = wave, .lipschitz = bad}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
