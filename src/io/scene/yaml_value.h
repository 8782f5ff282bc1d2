#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "io/scene/yaml_document.h"
#include "pdc/math/vec3.h"

namespace pdc::detail {

/// A value of a document with checked access: whatever is not exactly right throws YamlError at the value's position.
/// The document must outlive it.
class YamlValue {
 public:
  YamlValue(const YamlDocument& document, const YamlNode& node, std::string name)
      : mDocument(&document), mNode(&node), mName(std::move(name)) {}

  [[nodiscard]] bool isList() const { return mNode->kind == YamlNode::Kind::kList; }
  /// The key that the value stands behind, or the name that it was given.
  [[nodiscard]] const std::string& name() const { return mName; }

  [[nodiscard]] std::string text() const;
  /// Any number but NaN; infinite only if that is written so.
  [[nodiscard]] double number() const;
  [[nodiscard]] double finiteNumber() const;
  [[nodiscard]] double positiveNumber() const;
  /// A whole number from `least` to `most`.
  [[nodiscard]] long long integer(long long least, long long most) const;
  /// Three finite numbers.
  [[nodiscard]] Vec3d vector() const;
  [[nodiscard]] Vec3d positiveVector() const;
  [[nodiscard]] std::vector<YamlValue> list() const;
  /// The items of a list that must have `size` of them.
  [[nodiscard]] std::vector<YamlValue> list(std::size_t size) const;
  /// The keys, which must not repeat, and values of a map. The values are named by the keys. A key << stands for the
  /// entries of a map, or of a list of maps the first of which counts, that are not there otherwise.
  [[nodiscard]] std::vector<std::pair<YamlValue, YamlValue>> entries() const;

  /// \throws YamlError "FILE:LINE:COLUMN: what".
  [[noreturn]] void fail(std::string_view what) const;
  /// \throws YamlError "FILE:LINE:COLUMN: name must be wanted, not the value".
  [[noreturn]] void failNot(std::string_view wanted) const;

 private:
  using Entries = std::vector<std::pair<YamlValue, YamlValue>>;

  /// Adds those of the map whose keys are not in `keys`, then those merged into it. \param maps those that are added
  /// already, of which one may be merged into itself.
  void addEntries(Entries& result, std::unordered_set<std::string>& keys,
                  std::unordered_set<const YamlNode*>& maps) const;

  [[nodiscard]] YamlValue child(const YamlNode& node, std::string name) const {
    return {*mDocument, node, std::move(name)};
  }

  const YamlDocument* mDocument;
  const YamlNode* mNode;
  std::string mName;
};

/// A map that may hold only the keys given, each at most once: parameters of a shape or of the scene.
class YamlMap {
 public:
  YamlMap(const YamlValue& value, std::initializer_list<std::string_view> keys);

  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// \throws YamlError if the key is missing.
  [[nodiscard]] const YamlValue& operator[](std::string_view key) const;

  [[nodiscard]] double number(std::string_view key, double fallback) const;
  [[nodiscard]] Vec3d vector(std::string_view key, const Vec3d& fallback) const;

 private:
  [[nodiscard]] const YamlValue* find(std::string_view key) const;

  YamlValue mSelf;
  std::vector<YamlValue> mValues;
};

}  // namespace pdc::detail
