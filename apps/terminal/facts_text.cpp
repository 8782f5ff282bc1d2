#include "terminal/facts_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits, and three behind the point however far away it is.
std::string coordinateText(double value) {
  constexpr double kSixDigits = 1e6;
  return fmt::format("{:.{}g}", value,
                     std::abs(value) * 1e3 < kSixDigits ? 6 : 4 + static_cast<int>(std::log10(std::abs(value))));
}

std::string text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string joined;
  for (const Json& part : value) {
    if (!joined.empty()) joined += ' ';
    joined += part.is_number_float() ? coordinateText(part.get<double>()) : text(part);
  }
  return joined;
}

bool isList(const Json& value) { return value.is_array() && !value.empty() && value.front().is_object(); }

void print(const Json& facts, const std::string& indent) {
  std::size_t width = 0;
  for (const auto& fact : facts.items()) width = std::max(width, fact.key().size());
  for (const auto& [key, value] : facts.items()) {
    if (isList(value)) {
      for (const Json& part : value) {
        fmt::print("\n");
        print(part, indent + "  ");
      }
      continue;
    }
    if (value.is_object()) {
      fmt::print("{}{}\n", indent, factLabel(key));
      print(value, indent + "  ");
      continue;
    }
    fmt::print("{}{:<{}}  {}\n", indent, factLabel(key), width, text(value));
  }
}

}  // namespace

void printFacts(const nlohmann::ordered_json& facts) { print(facts, ""); }

std::string factLabel(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

}  // namespace pdc
