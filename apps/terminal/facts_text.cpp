#include "terminal/facts_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string joined;
  for (const Json& part : value) {
    if (!joined.empty()) joined += ' ';
    joined += text(part);
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
