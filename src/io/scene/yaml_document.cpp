#include "io/scene/yaml_document.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

#include "io/file/file_error.h"

namespace pdc::detail {
namespace {

constexpr std::uintmax_t kMaxBytes = 16 << 20;
constexpr std::size_t kLongestMessage = 1000;
constexpr std::size_t kMaxNodes = 1'000'000;

std::string readText(const std::filesystem::path& path, const YamlDocument& document) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) document.fail(1, 1, "a folder, not a file");
  // Reading a pipe would wait for whoever writes to it.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    document.fail(1, 1, "not a regular file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) document.fail(1, 1, "cannot be opened: " + std::generic_category().message(errno));
  std::string text;
  std::array<char, 1 << 16> chunk;
  do {
    stream.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream && text.size() <= kMaxBytes);
  if (stream.bad()) document.fail(1, 1, "cannot be read: " + std::generic_category().message(errno));
  if (text.size() > kMaxBytes) document.fail(1, 1, fmt::format("larger than {} bytes", kMaxBytes));
  return text;
}

/// The length of the well-formed UTF-8 sequence of a text character at `at`; 0 if there is none.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= ' ' ? first != 0x7F : first == '\t' || first == '\n' || first == '\r';
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3F);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return first >= 0xC2 && code >= kSmallest[length] && code <= 0x10FFFF && !surrogate ? length : 0;
}

void checkText(std::string_view text, const YamlDocument& document) {
  int line = 1, column = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = characterLength(text, at);
    if (length == 0)
      document.fail(line, column,
                    fmt::format("byte {:#04x} is not text in UTF-8", static_cast<unsigned char>(text[at])));
    column = text[at] == '\n' ? 1 : column + 1;
    line += text[at] == '\n';
    at += length;
  }
}

/// Builds the document from the parser's events.
class Builder final : public YAML::EventHandler {
 public:
  explicit Builder(YamlDocument& document) : mDocument(document) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (mDocument.root != nullptr) mDocument.fail(mark.line + 1, mark.column + 1, "more than one document in the file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode& node = add(YamlNode::Kind::kNull, mark, anchor);
    if (mOpen.empty() || mOpen.back()->kind != YamlNode::Kind::kMap) return;
    // The parser's mark is at whatever follows; the key says better where a value is missing.
    const auto& siblings = mOpen.back()->children;
    if (siblings.size() % 2 != 0) return;
    node.line = siblings[siblings.size() - 2]->line;
    node.column = siblings[siblings.size() - 2]->column;
  }
  void OnAlias(const YAML::Mark&, YAML::anchor_t anchor) override { attach(mAnchors[anchor]); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode& node = add(YamlNode::Kind::kScalar, mark, anchor);
    node.plain = tag == "?";
    node.text = value;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    mOpen.push_back(&add(YamlNode::Kind::kList, mark, anchor));
  }
  void OnSequenceEnd() override { mOpen.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    mOpen.push_back(&add(YamlNode::Kind::kMap, mark, anchor));
  }
  void OnMapEnd() override { mOpen.pop_back(); }

 private:
  YamlNode& add(YamlNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    const int line = mark.line + 1, column = mark.column + 1;
    if (mDocument.nodes.size() == kMaxNodes)
      mDocument.fail(line, column, fmt::format("more than {} values", kMaxNodes));
    YamlNode& node = mDocument.nodes.emplace_back(YamlNode{.kind = kind, .line = line, .column = column});
    if (anchor != YAML::NullAnchor) {
      mAnchors.resize(std::max<std::size_t>(mAnchors.size(), anchor + 1));
      mAnchors[anchor] = &node;
    }
    attach(&node);
    return node;
  }
  void attach(YamlNode* node) {
    if (mOpen.empty()) {
      mDocument.root = node;
    } else {
      mOpen.back()->children.push_back(node);
    }
  }

  YamlDocument& mDocument;
  std::vector<YamlNode*> mOpen;
  std::vector<YamlNode*> mAnchors;
};

void parse(const std::string& text, YamlDocument& document) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Builder builder(document);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::DeepRecursion& error) {
    document.fail(error.mark.line + 1, error.mark.column + 1,
                  fmt::format("nested deeper than {} levels", error.depth()));
  } catch (const YAML::Exception& error) {
    document.fail(error.mark.line + 1, error.mark.column + 1, error.msg);
  }
}

}  // namespace

std::string shortened(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string(text);
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return std::string(text.substr(0, bytes)) + "...";
}

void YamlDocument::fail(int line, int column, std::string_view what) const {
  throw YamlError(oneLine(
      fmt::format("{}:{}:{}: {}", file, std::max(line, 1), std::max(column, 1), shortened(what, kLongestMessage))));
}

YamlDocument readYaml(const std::filesystem::path& path) {
  YamlDocument document{.file = path.string(), .nodes = {}};
  const std::string text = readText(path, document);
  checkText(text, document);
  parse(text, document);
  if (document.root == nullptr || document.root->kind == YamlNode::Kind::kNull)
    document.fail(1, 1, "the file is empty");
  return document;
}

}  // namespace pdc::detail
