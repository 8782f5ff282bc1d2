#include "pdc/field/formula.h"

#include <fmt/format.h>
#include <muParser.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "field/arguments.h"
#include "field/boundary.h"
#include "field/central_differences.h"
#include "field/interval_arithmetic.h"
#include "pdc/error.h"

namespace pdc {
namespace {

/// What stands about `position` in a long expression.
std::string excerpt(const std::string& expression, std::size_t position) {
  constexpr std::size_t kAround = 40, kLongest = 2 * kAround + 20;
  if (expression.size() <= kLongest) return expression;
  const std::size_t begin = std::min(position, expression.size()) - std::min(position, kAround);
  const std::size_t end = std::min(begin + 2 * kAround, expression.size());
  return fmt::format("{}{}{}", begin > 0 ? "..." : "", expression.substr(begin, end - begin),
                     end < expression.size() ? "..." : "");
}

[[noreturn]] void fail(const std::string& expression, int position, std::string message) {
  if (!message.empty() && message.back() == '.') message.pop_back();
  position = std::max(position, 0);
  std::string line = fmt::format("formula \"{}\", position {}: {}",
                                 excerpt(expression, static_cast<std::size_t>(position)), position, message);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' '; }, ' ');
  throw Error(line);
}

/// muParser would take a single = as an assignment.
void refuseAssignment(const std::string& expression) {
  const auto at = [&](std::size_t i) { return i < expression.size() ? expression[i] : ' '; };
  for (std::size_t i = 0; i < expression.size(); ++i) {
    if (at(i) != '=') continue;
    if (at(i + 1) == '=') {
      ++i;
    } else if (i == 0 || std::string("<>!").find(at(i - 1)) == std::string::npos) {
      fail(expression, static_cast<int>(i), "Unexpected '=': the formula stands for its zero set, and == compares");
    }
  }
}

/// muParser takes no longer ones.
void refuseLong(const std::string& expression) {
  constexpr std::size_t kLongest = mu::MaxLenExpression - 1;
  if (expression.size() > kLongest)
    fail(expression, static_cast<int>(kLongest),
         fmt::format("The formula has {} characters, must have at most {}", expression.size(), kLongest));
}

/// The remainder that has the sign of the divisor: periodic, also where x is negative.
double floorMod(double x, double period) { return x - period * std::floor(x / period); }

/// A parser with variables of its own, for one thread at a time.
class Evaluator {
 public:
  explicit Evaluator(const std::string& expression) {
    mParser.DefineVar("x", &mX);
    mParser.DefineVar("y", &mY);
    mParser.DefineVar("z", &mZ);
    mParser.DefineConst("pi", std::numbers::pi);
    mParser.DefineFun("floor", static_cast<double (*)(double)>(std::floor));
    mParser.DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));
    mParser.DefineFun("round", static_cast<double (*)(double)>(std::round));
    mParser.DefineFun("mod", floorMod);
    mParser.SetExpr(expression);
  }
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  // Points are evaluated one by one, because muParser's bulk mode starts OpenMP threads in each call.
  double operator()(double x, double y, double z) {
    mX = x;
    mY = y;
    mZ = z;
    return mParser.Eval();
  }

  [[nodiscard]] const mu::Parser& parser() const { return mParser; }

 private:
  double mX = 0, mY = 0, mZ = 0;
  mu::Parser mParser;
};

/// \throws Error for everything that would otherwise go wrong when points are evaluated.
void check(const std::string& expression) {
  refuseLong(expression);
  refuseAssignment(expression);
  try {
    Evaluator evaluator(expression);
    const double value = evaluator(0, 0, 0);
    const mu::Parser& parser = evaluator.parser();
    if (parser.GetNumResults() != 1)
      fail(expression, 0, fmt::format("Expected one value, not {} with commas between", parser.GetNumResults()));
    if (parser.GetUsedVar().empty() && !std::isfinite(value))
      fail(expression, 0, fmt::format("The value is always {}, expected a finite one", value));
  } catch (const mu::ParserError& e) {
    fail(expression, e.GetPos(), e.GetMsg());
  }
}

class FormulaField final : public Field {
 public:
  FormulaField(const std::string& expression, std::optional<double> lipschitz)
      : mEvaluators(expression), mLipschitz(lipschitz) {}

  void values(PointSpan points, double* values) const override {
    Evaluator& evaluate = mEvaluators.local();
    for (std::size_t i = 0; i < points.size; ++i)
      values[i] = detail::open(evaluate(points.x[i], points.y[i], points.z[i]));
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    const auto evaluate = [this](PointSpan all, double* result) { this->values(all, result); };
    detail::centralDifferences(points, evaluate, values, gradients);
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    if (!mLipschitz) return Interval::whole();
    return detail::lipschitzBound(valueAt(box.center()), *mLipschitz, box);
  }

  [[nodiscard]] double lipschitz() const override { return mLipschitz.value_or(Field::lipschitz()); }

 private:
  mutable tbb::enumerable_thread_specific<Evaluator> mEvaluators;
  std::optional<double> mLipschitz;
};

}  // namespace

FieldPtr formula(const std::string& expression, std::optional<double> lipschitz) {
  if (lipschitz) detail::requirePositive("formula lipschitz constant", *lipschitz);
  check(expression);
  return std::make_shared<FormulaField>(expression, lipschitz);
}

}  // namespace pdc
