#include "terminal/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace pdc {
namespace {

template <typename Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(const std::string& name, const std::string& text, const std::string& limit) {
  throw CLI::ValidationError(name, fmt::format("'{}' is not {}", text, limit));
}

}  // namespace

CLI::Option* addReal(CLI::App& command, const std::string& name, std::optional<double>& target,
                     std::function<bool(double)> accepts, const std::string& limit, const std::string& help) {
  const auto take = [name, limit, &target, accepts = std::move(accepts)](const std::string& text) {
    const auto value = parse<double>(text);
    if (!value || std::isnan(*value) || !accepts(*value)) refuse(name, text, limit);
    target = *value;
  };
  return command.add_option_function<std::string>(name, take, help);
}

CLI::Option* addInteger(CLI::App& command, const std::string& name, std::optional<int>& target, int lo, int hi,
                        const std::string& help) {
  const auto take = [name, lo, hi, &target](const std::string& text) {
    const auto value = parse<int>(text);
    if (!value || *value < lo || *value > hi) refuse(name, text, fmt::format("a whole number from {} to {}", lo, hi));
    target = *value;
  };
  return command.add_option_function<std::string>(name, take, help);
}

std::vector<double> parseReals(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const auto value = parse<double>(text.substr(begin, end - begin));
    if (!value || std::isnan(*value)) return {};
    numbers.push_back(*value);
    begin = end + 1;
  }
  return numbers;
}

CLI::Option* addThreads(CLI::App& command, std::optional<int>& target) {
  constexpr int kMaxThreads = 4096;
  return addInteger(command, "--threads", target, 0, kMaxThreads, "0 is all (0); the result does not depend on it")
      ->type_name("N");
}

}  // namespace pdc
