#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pdc/error.h"

namespace pdc::detail {

/// An Error whose message says where it is: "FILE:LINE:COLUMN: what".
class YamlError final : public Error {
 public:
  using Error::Error;
};

/// One value of a YAML file. An aliased value is one node with several parents.
struct YamlNode {
  enum class Kind { kNull, kScalar, kList, kMap };

  Kind kind = Kind::kNull;
  bool plain = true;         ///< A scalar without quotes or tag, so that it may be a number.
  int line = 1, column = 1;  ///< Counted from 1.
  std::string text{};        ///< A scalar's text.
  /// Items of a list, or keys and values of a map in turns, in the order of the file.
  std::vector<YamlNode*> children{};
};

/// A YAML file as it stands: order, repeated keys and positions are kept.
struct YamlDocument {
  std::string file;
  std::deque<YamlNode> nodes;  ///< A deque, because nodes point to each other and must not move.
  YamlNode* root = nullptr;

  [[noreturn]] void fail(int line, int column, std::string_view what) const;
};

/// `text` for messages, cut before a character at about `bytes` bytes.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t bytes);

/// Reads a file of one document: UTF-8 text, at most 16 MiB, a million values. \throws YamlError for anything else.
[[nodiscard]] YamlDocument readYaml(const std::filesystem::path& path);

}  // namespace pdc::detail
