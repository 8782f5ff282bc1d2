#include "io/scene/yaml_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/file/closest_word.h"

namespace pdc::detail {
namespace {

std::string describe(const YamlNode& node) {
  constexpr std::size_t kLongest = 40;
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return "nothing";
    case YamlNode::Kind::kList:
      return fmt::format("a list of {}", node.children.size());
    case YamlNode::Kind::kMap:
      return "a map";
    case YamlNode::Kind::kScalar:
      break;
  }
  return fmt::format("'{}'", shortened(node.text, kLongest));
}

/// The whole of a plain scalar read as T, or nothing.
template <typename T>
std::optional<T> parse(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::kScalar || !node.plain) return std::nullopt;
  std::string_view text = node.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The number that YAML spells in a way of its own because it is not finite.
std::optional<double> parseSpecial(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::kScalar || !node.plain) return std::nullopt;
  if (node.text == ".inf" || node.text == "+.inf") return std::numeric_limits<double>::infinity();
  if (node.text == "-.inf") return -std::numeric_limits<double>::infinity();
  if (node.text == ".nan") return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

}  // namespace

void YamlValue::fail(std::string_view what) const { mDocument->fail(mNode->line, mNode->column, what); }

void YamlValue::failNot(std::string_view wanted) const {
  mDocument->fail(mNode->line, mNode->column, fmt::format("{} must be {}, not {}", mName, wanted, describe(*mNode)));
}

std::string YamlValue::text() const {
  if (mNode->kind != YamlNode::Kind::kScalar) failNot("text");
  return mNode->text;
}

double YamlValue::number() const {
  const std::optional<double> special = parseSpecial(*mNode);
  const std::optional<double> value = special ? special : parse<double>(*mNode);
  if (!value || std::isnan(*value)) failNot("a number");
  return *value;
}

double YamlValue::finiteNumber() const {
  const double value = number();
  if (!std::isfinite(value)) failNot("a finite number");
  return value;
}

double YamlValue::positiveNumber() const {
  const double value = finiteNumber();
  if (value <= 0) failNot("positive");
  return value;
}

long long YamlValue::integer(long long least, long long most) const {
  const std::optional<long long> value = parse<long long>(*mNode);
  if (!value || *value < least || *value > most) failNot(fmt::format("a whole number from {} to {}", least, most));
  return *value;
}

Vec3d YamlValue::vector() const {
  if (!isList() || mNode->children.size() != 3) failNot("a list of 3 numbers");
  const std::vector<YamlValue> items = list();
  return {items[0].finiteNumber(), items[1].finiteNumber(), items[2].finiteNumber()};
}

Vec3d YamlValue::positiveVector() const {
  const Vec3d v = vector();
  for (const YamlValue& item : list()) (void)item.positiveNumber();
  return v;
}

std::vector<YamlValue> YamlValue::list() const {
  if (!isList()) failNot("a list");
  std::vector<YamlValue> items;
  items.reserve(mNode->children.size());
  for (const YamlNode* item : mNode->children) items.push_back(child(*item, mName));
  return items;
}

std::vector<YamlValue> YamlValue::list(std::size_t size) const {
  if (!isList() || mNode->children.size() != size) failNot(fmt::format("a list of {}", size));
  return list();
}

std::vector<std::pair<YamlValue, YamlValue>> YamlValue::entries() const {
  if (mNode->kind != YamlNode::Kind::kMap) failNot("a map");
  Entries result;
  std::unordered_set<std::string> keys;
  std::unordered_set<const YamlNode*> maps{mNode};
  addEntries(result, keys, maps);
  return result;
}

void YamlValue::addEntries(Entries& result, std::unordered_set<std::string>& keys,
                           std::unordered_set<const YamlNode*>& maps) const {
  std::unordered_set<std::string> own;
  std::vector<YamlValue> merged;
  for (std::size_t i = 0; i + 1 < mNode->children.size(); i += 2) {
    const YamlNode& keyNode = *mNode->children[i];
    const std::string name = child(keyNode, "key").text();
    const YamlValue key = child(keyNode, name), value = child(*mNode->children[i + 1], name);
    if (!own.insert(name).second) key.fail(fmt::format("key \'{}\' is repeated", name));
    if (name == "<<" && keyNode.plain) {
      merged = value.isList() ? value.list() : std::vector{value};
    } else if (keys.insert(name).second) {
      result.emplace_back(key, value);
    }
  }
  for (const YamlValue& map : merged) {
    if (map.mNode->kind != YamlNode::Kind::kMap) map.failNot("a map or a list of maps");
    if (maps.insert(map.mNode).second) map.addEntries(result, keys, maps);
  }
}

YamlMap::YamlMap(const YamlValue& value, std::initializer_list<std::string_view> keys) : mSelf(value) {
  for (auto& [key, entry] : value.entries()) {
    if (std::find(keys.begin(), keys.end(), key.name()) == keys.end())
      key.fail(fmt::format("unknown key \'{}\'{}; {} takes {}", key.name(),
                           didYouMean(key.name(), std::vector<std::string>(keys.begin(), keys.end())), value.name(),
                           fmt::join(keys, ", ")));
    mValues.push_back(std::move(entry));
  }
}

const YamlValue* YamlMap::find(std::string_view key) const {
  const auto found = std::find_if(mValues.begin(), mValues.end(), [&](const YamlValue& v) { return v.name() == key; });
  return found == mValues.end() ? nullptr : &*found;
}

const YamlValue& YamlMap::operator[](std::string_view key) const {
  const YamlValue* value = find(key);
  if (value == nullptr) mSelf.fail(fmt::format("{} is missing in {}", key, mSelf.name()));
  return *value;
}

double YamlMap::number(std::string_view key, double fallback) const {
  const YamlValue* value = find(key);
  return value == nullptr ? fallback : value->finiteNumber();
}

Vec3d YamlMap::vector(std::string_view key, const Vec3d& fallback) const {
  const YamlValue* value = find(key);
  return value == nullptr ? fallback : value->vector();
}

}  // namespace pdc::detail
