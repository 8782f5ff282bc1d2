#include "pdc/field/formula.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "field/field_checks.h"
#include "pdc/error.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using test::FieldCase;
using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<FieldCase> formulas() {
  return {{"sphere", formula("sqrt(x^2 + y^2 + z^2) - 1", 1)},
          {"wave", formula("sin(2 * pi * x / 3) * cos(y) + z", 4), false, 4},
          {"max", formula("max(abs(x), abs(y), abs(z)) - 1", 1)},
          {"constant", formula("-2.5", 1e-9)}};
}

class Formula : public testing::TestWithParam<FieldCase> {};

TEST_P(Formula, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }
TEST_P(Formula, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(Formula, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(Formula, BatchesAgree) { test::expectBatchesAgree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, Formula, testing::ValuesIn(formulas()), testing::PrintToStringParamName());

TEST(Formula, IsTheFunctionItSpells) {
  const auto written = formula("sqrt(x^2 + y^2 + z^2) - 1"), built = sphere({0, 0, 0}, 1);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.in({{-3, -3, -3}, {3, 3, 3}});
    EXPECT_NEAR(written->valueAt(p), built->valueAt(p), 1e-15);
    EXPECT_NEAR(length(written->gradientAt(p) - built->gradientAt(p)), 0, 1e-8);
  }
  EXPECT_EQ(formula("pi")->valueAt({0, 0, 0}), 3.141592653589793);
  EXPECT_EQ(formula("x < 1 && y >= 2 ? 10 : z == 3 ? 20 : 30")->valueAt({0, 2, 0}), 10);
  EXPECT_EQ(formula("x != 1 ? 1 : 2")->valueAt({1, 0, 0}), 2);
}

TEST(Formula, GradientsAreGoodAtEveryScale) {
  for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
    const auto field = formula("x*x + 2*y*y - z*x");
    const Vec3d p = Vec3d{0.3, -0.7, 1.1} * scale;
    const Vec3d expected{2 * p.x - p.z, 4 * p.y, -p.x};
    EXPECT_LT(length(field->gradientAt(p) - expected), 1e-8 * length(expected));
  }
  EXPECT_NEAR(formula("3*x")->gradientAt({0, 0, 0}).x, 3, 1e-10);
}

TEST(Formula, BoundKnowsNothingWithoutALipschitzConstant) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(formula("x")->bound(box).bounded());
  EXPECT_EQ(formula("x")->lipschitz(), kInfinity);
  EXPECT_EQ(formula("x", 2)->lipschitz(), 2);
  EXPECT_TRUE(formula("x", 1)->bound(box).bounded());
  EXPECT_FALSE(formula("sqrt(x - 9)", 1)->bound(box).bounded());
}

TEST(Formula, GivesTheSameBitsInAnyThread) {
  const auto field = formula("sin(x) * exp(-y*y) + cos(z*x) - 0.1");
  constexpr std::size_t kPoints = 20'000;
  std::vector<double> x(kPoints), serial(kPoints), parallel(kPoints);
  Random random(2);
  for (double& v : x) v = random.in(-2, 2);
  for (std::size_t i = 0; i < kPoints; ++i) serial[i] = field->valueAt({x[i], -x[i], x[i] / 2});
  tbb::parallel_for(std::size_t{0}, kPoints, [&](std::size_t i) {
    parallel[i] = field->valueAt({x[i], -x[i], x[i] / 2});
  });
  EXPECT_EQ(serial, parallel);
}

TEST(Formula, HasSteps) {
  const auto at = [](const char* expression, double x) { return formula(expression)->valueAt({x, 0, 0}); };
  EXPECT_EQ(at("floor(x)", -1.5), -2);
  EXPECT_EQ(at("ceil(x)", -1.5), -1);
  EXPECT_EQ(at("round(x)", 2.5), 3);
  EXPECT_EQ(at("round(x)", -2.5), -3);
  EXPECT_EQ(at("sign(x)", -0.5), -1);
  EXPECT_EQ(at("sign(x)", 0), 0);
  EXPECT_EQ(at("mod(x, 3)", 7.5), 1.5);
  EXPECT_EQ(at("mod(x, 3)", -1), 2);
  EXPECT_EQ(at("mod(x, -3)", 1), -2);
  EXPECT_EQ(at("mod(floor(x), 2) + 1", -3.2), 1);
}

std::string messageOf(const std::string& expression) {
  try {
    formula(expression);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Formula, SaysWhatIsWrongWithIt) {
  EXPECT_EQ(messageOf("x +"), "formula \"x +\", position 4: Unexpected end of expression at position 4");
  EXPECT_EQ(messageOf("1 + foo(x)"),
            "formula \"1 + foo(x)\", position 4: Unexpected token \"foo\" found at position 4");
  EXPECT_EQ(messageOf("x^2 = 1"),
            "formula \"x^2 = 1\", position 4: Unexpected '=': the formula stands for its zero set, and == compares");
  for (const char* bad :
       {"",     "  ",       "x +",   "foo(x)", "w",   "x * w", "1/0",   "sqrt(-1)", "x = 1",     "x < 1 ? y = 2 : 3",
        "x, y", "\"text\"", "sin(x", "sin()",  "x y", ")",     "1e400", "x\n+\n",   "x\xc2\xb2", "log(-1)",
        "=",    "x=",       "=x"}) {
    const std::string message = messageOf(bad);
    EXPECT_EQ(message.rfind("formula \"", 0), 0u) << message;
    EXPECT_NE(message.find("\", position "), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Formula, RefusesBadLipschitzConstants) {
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) EXPECT_THROW(formula("x", bad), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
