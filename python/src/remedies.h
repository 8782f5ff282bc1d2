#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pdc::python {

/// A line of the library, whose remedies are options of the program, with the arguments and methods of the package
/// instead: "--iso V sets it" becomes "level=V sets it".
[[nodiscard]] std::string inPythonsWords(std::string_view line);

[[nodiscard]] std::vector<std::string> inPythonsWords(const std::vector<std::string>& lines);

}  // namespace pdc::python
