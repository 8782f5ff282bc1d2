#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert.h"

namespace pdc::python {

template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// Options by their names, as the Python files give them once they have checked them. None is not said, and leaves what
/// it would set as it is. Must not outlive the dict.
class GivenOptions {
 public:
  explicit GivenOptions(const py::dict& options) : mOptions(options) {}

  template <typename Target>
  void take(const char* name, Target& target) const {
    using Value = decltype(valueType(target));
    if (const py::object value = given(name); !value.is_none()) target = value.cast<Value>();
  }
  /// \throws py::value_error for a word that is none of them.
  template <typename Value, typename Target>
  void takeWord(const char* name, const Words<Value>& words, Target& target) const {
    if (const py::object value = given(name); !value.is_none())
      target = valueOf(words, name, value.cast<std::string>());
  }
  /// The object, or None.
  [[nodiscard]] py::object given(const char* name) const {
    return mOptions.contains(name) ? py::object(mOptions[name]) : py::none();
  }
  /// How many threads; 0 is all.
  [[nodiscard]] int threads() const {
    int threads = 0;
    take("threads", threads);
    return threads;
  }

 private:
  template <typename Value>
  static Value valueType(const std::optional<Value>&);
  template <typename Value>
  static Value valueType(const Value&);

  const py::dict& mOptions;
};

}  // namespace pdc::python
