#include "inputs/callable_field.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "convert.h"
#include "field/boundary.h"
#include "field/central_differences.h"
#include "field/interval_arithmetic.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

namespace py = pybind11;

/// A Python object that any thread may let go of.
using SharedObject = std::shared_ptr<const py::object>;

SharedObject share(const py::object& object) {
  return {new py::object(object), [](const py::object* p) {
            const py::gil_scoped_acquire acquire;
            delete p;
          }};
}

/// The interpreter's lock, on whichever thread needs it.
class InterpreterLock {
 public:
  InterpreterLock() {
    // Threads of TBB may outlive the interpreter, which takes along what it holds of them.
    if (PyGILState_GetThisThreadState() == nullptr) static_cast<void>(new ThreadState);
    mLock.emplace();
  }

 private:
  std::optional<py::gil_scoped_acquire> mLock;
};

py::array_t<double> arrayOf(PointSpan points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size), py::ssize_t{3}});
  double* const out = array.mutable_data();
  for (std::size_t i = 0; i < points.size; ++i) {
    out[3 * i] = points.x[i];
    out[3 * i + 1] = points.y[i];
    out[3 * i + 2] = points.z[i];
  }
  return array;
}

/// What a function gave for n points, as doubles. \throws py::value_error for another shape.
py::array_t<double, py::array::c_style> callFor(const SharedObject& f, PointSpan points, bool vectors) {
  const auto result = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure((*f)(arrayOf(points)));
  if (!result) throw py::error_already_set();
  const auto n = static_cast<py::ssize_t>(points.size);
  const bool fits = vectors ? result.ndim() == 2 && result.shape(0) == n && result.shape(1) == 3
                            : result.ndim() == 1 && result.shape(0) == n;
  if (fits) return result;
  const std::string wanted = "(" + std::to_string(n) + (vectors ? ", 3)" : ",)");
  throw py::value_error((vectors ? "gradient" : "the function") + std::string(" must return an array of shape ") +
                        wanted + " for " + std::to_string(n) + " points, not of shape " + textOf(result.attr("shape")));
}

class CallableField final : public Field {
 public:
  CallableField(const py::object& f, const py::object& gradient, std::optional<double> lipschitz)
      : mFunction(share(f)), mGradient(gradient.is_none() ? nullptr : share(gradient)), mLipschitz(lipschitz) {}

  void values(PointSpan points, double* values) const override {
    const InterpreterLock lock;
    const auto result = callFor(mFunction, points, false);
    std::transform(result.data(), result.data() + points.size, values, [](double v) { return detail::open(v); });
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    if (!mGradient) {
      const auto evaluate = [this](PointSpan all, double* result) { this->values(all, result); };
      detail::centralDifferences(points, evaluate, values, gradients);
      return;
    }
    this->values(points, values);
    const InterpreterLock lock;
    const auto result = callFor(mGradient, points, true);
    for (std::size_t i = 0; i < points.size; ++i) {
      gradients.x[i] = result.data()[3 * i];
      gradients.y[i] = result.data()[3 * i + 1];
      gradients.z[i] = result.data()[3 * i + 2];
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    if (!mLipschitz) return Interval::whole();
    return detail::lipschitzBound(valueAt(box.center()), *mLipschitz, box);
  }

  [[nodiscard]] double lipschitz() const override { return mLipschitz.value_or(Field::lipschitz()); }

 private:
  SharedObject mFunction, mGradient;
  std::optional<double> mLipschitz;
};

}  // namespace

FieldPtr callableField(const py::object& f, const py::object& gradient, std::optional<double> lipschitz) {
  return std::make_shared<CallableField>(f, gradient, lipschitz);
}

}  // namespace pdc::python
