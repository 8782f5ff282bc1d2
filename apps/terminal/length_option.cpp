#include "terminal/length_option.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "terminal/numbers.h"

namespace pdc {

std::optional<MeshLength> parseLength(const std::string& text) {
  const bool inMeanEdges = text.ends_with('L');
  const std::vector<double> value = parseReals(text.substr(0, text.size() - (inMeanEdges ? 1 : 0)), ',');
  if (value.size() != 1 || !(value[0] > 0) || !std::isfinite(value[0])) return std::nullopt;
  return MeshLength{value[0], inMeanEdges};
}

CLI::Option* addLength(CLI::App& command, const std::string& name, std::optional<MeshLength>& target,
                       const std::string& help) {
  const auto take = [name, &target](const std::string& text) {
    target = parseLength(text);
    if (!target)
      throw CLI::ValidationError(
          name, fmt::format("'{}' is not a finite number above 0, or one with L for mean edge lengths", text));
  };
  return command.add_option_function<std::string>(name, take, help);
}

}  // namespace pdc
