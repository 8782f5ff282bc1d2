#include "terminal/length_option.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <vector>

#include "terminal/numbers.h"

namespace pdc {
namespace {

CLI::Option* addSuffixed(CLI::App& command, const std::string& name, char suffix, const char* unit,
                         const std::function<void(SuffixedLength)>& take, const std::string& help) {
  const auto parse = [name, suffix, unit, take](const std::string& text) {
    const std::optional<SuffixedLength> length = parseLength(text, suffix);
    if (!length)
      throw CLI::ValidationError(
          name, fmt::format("'{}' is not a finite number above 0, or one with {} for {}", text, suffix, unit));
    take(*length);
  };
  return command.add_option_function<std::string>(name, parse, help);
}

}  // namespace

std::optional<SuffixedLength> parseLength(const std::string& text, char suffix) {
  const bool suffixed = text.ends_with(suffix);
  const std::vector<double> value = parseReals(text.substr(0, text.size() - (suffixed ? 1 : 0)), ',');
  if (value.size() != 1 || !(value[0] > 0) || !std::isfinite(value[0])) return std::nullopt;
  return SuffixedLength{value[0], suffixed};
}

CLI::Option* addLength(CLI::App& command, const std::string& name, std::optional<MeshLength>& target,
                       const std::string& help) {
  const auto take = [&target](SuffixedLength length) { target = MeshLength(length.value, length.suffixed); };
  return addSuffixed(command, name, 'L', "mean edge lengths", take, help);
}

CLI::Option* addVoxelLength(CLI::App& command, const std::string& name, std::optional<SuffixedLength>& target,
                            const std::string& help) {
  return addSuffixed(
      command, name, 'v', "voxels", [&target](SuffixedLength length) { target = length; }, help);
}

}  // namespace pdc
