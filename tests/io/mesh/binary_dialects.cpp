#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "io/mesh/dialects.h"

namespace pdc::test {
namespace {

template <typename Number>
std::string bytesOf(double value, bool swap) {
  const auto number = static_cast<Number>(value);
  std::string result(sizeof(Number), '\0');
  std::memcpy(result.data(), &number, sizeof(Number));
  if (swap) std::reverse(result.begin(), result.end());
  return result;
}

/// Writes numbers of PLY's types.
class PlyBody {
 public:
  PlyBody(bool ascii, bool swap) : mAscii(ascii), mSwap(swap) {}

  void put(const std::string& type, double value) { text += mAscii ? fmt::format("{} ", value) : binary(type, value); }
  void endElement() {
    if (mAscii) text += '\n';
  }

  std::string text;

 private:
  [[nodiscard]] std::string binary(const std::string& type, double value) const {
    if (type == "char" || type == "int8") return bytesOf<std::int8_t>(value, mSwap);
    if (type == "uchar" || type == "uint8") return bytesOf<std::uint8_t>(value, mSwap);
    if (type == "short" || type == "int16") return bytesOf<std::int16_t>(value, mSwap);
    if (type == "ushort" || type == "uint16") return bytesOf<std::uint16_t>(value, mSwap);
    if (type == "int" || type == "int32") return bytesOf<std::int32_t>(value, mSwap);
    if (type == "uint" || type == "uint32") return bytesOf<std::uint32_t>(value, mSwap);
    if (type == "float" || type == "float32") return bytesOf<float>(value, mSwap);
    return bytesOf<double>(value, mSwap);
  }

  bool mAscii, mSwap;
};

/// An element's lines of the header and its bytes of the body.
struct PlyPart {
  std::string header, body;
};

PlyPart vertexPart(const Solid& solid, PlyBody body, Dice& dice) {
  const std::string type = dice.of({"float", "float32", "double", "float64", "short", "int"});
  const bool list = dice.once(4), colours = dice.once(3), normals = dice.once(3);
  std::string header = fmt::format("element vertex {}\n", solid.positions.size());
  if (list) header += "property list uchar short tags\n";
  for (const char* axis : {"x", "y", "z"}) header += fmt::format("property {} {}\n", type, axis);
  if (normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (colours) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (std::size_t i = 0; i < solid.positions.size(); ++i) {
    if (list) {
      body.put("uchar", double(i % 3));
      for (std::size_t k = 0; k < i % 3; ++k) body.put("short", -1);
    }
    for (int axis = 0; axis < 3; ++axis) body.put(type, solid.positions[i][axis]);
    for (int k = 0; k < 3 && normals; ++k) body.put("float", k == 2);
    for (int k = 0; k < 3 && colours; ++k) body.put("uchar", 255);
    body.endElement();
  }
  return {header, body.text};
}

PlyPart facePart(const Solid& solid, PlyBody body, Dice& dice) {
  const std::string count = dice.of({"uchar", "uint8", "char", "int", "ushort", "uint32"});
  const std::string index = dice.of({"int", "uint", "int32", "uchar", "ushort", "short", "char"});
  const bool before = dice.once(3), after = dice.once(3);
  std::string header = fmt::format("element face {}\n", solid.faces.size());
  if (before) header += "property float quality\n";
  header += fmt::format("property list {} {} {}\n", count, index, dice.of({"vertex_indices", "vertex_index"}));
  if (after) header += "property list uchar float texcoord\nproperty int flags\n";
  for (const auto& face : solid.faces) {
    if (before) body.put("float", 0.5);
    body.put(count, double(face.size()));
    for (const std::uint32_t v : face) body.put(index, v);
    if (after) {
      body.put("uchar", 2);
      for (int k = 0; k < 2; ++k) body.put("float", 0.25);
      body.put("int", -7);
    }
    body.endElement();
  }
  return {header, body.text};
}

/// All triangles as strips in one list, each second one with a fourth corner that turns back.
PlyPart stripPart(const Solid& solid, PlyBody body, Dice& dice) {
  std::vector<double> list;
  for (const Triangle& t : solid.triangulated().triangles) {
    if (!list.empty()) list.push_back(-1);
    list.insert(list.end(), t.begin(), t.end());
    if (dice.once(2)) list.push_back(t[2]);
  }
  const std::string index = dice.of({"int", "short", "char"});
  body.put("int", double(list.size()));
  for (const double v : list) body.put(index, v);
  body.endElement();
  return {fmt::format("element tristrips 1\nproperty list int {} vertex_indices\n", index), body.text};
}

PlyPart otherPart(PlyBody body) {
  for (int i = 0; i < 2; ++i) {
    body.put("double", 1.5);
    body.put("int", 1);
    body.put("uchar", 9);
    body.endElement();
  }
  return {"element camera 2\nproperty double focus\nproperty list int uchar ids\n", body.text};
}

}  // namespace

std::string plyDialect(const Solid& solid, Dice& dice) {
  const std::string format = dice.of({"ascii", "binary_little_endian", "binary_big_endian"});
  const PlyBody body(format == "ascii", format == "binary_big_endian");
  std::vector<PlyPart> parts{vertexPart(solid, body, dice),
                             dice.once(4) ? stripPart(solid, body, dice) : facePart(solid, body, dice)};
  if (dice.once(6)) std::swap(parts[0], parts[1]);
  if (dice.once(3)) parts.insert(parts.begin() + std::ptrdiff_t(dice.below(3)), otherPart(body));
  std::string header =
      "ply\nformat " + format + " 1.0\n" + dice.of({"", "comment by hand\n", "obj_info a b\ncomment\n"});
  std::string bytes;
  for (const PlyPart& part : parts) {
    header += part.header + (dice.once(4) ? "comment end_header\n" : "");
    bytes += part.body;
  }
  header += "end_header\n";
  if (dice.once(6))
    for (char& c : header)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  const std::string end = dice.of({"\n", "\r\n", "\r"});
  std::string result = dice.once(8) ? "\xEF\xBB\xBF" : "";
  for (const char c : header) c == '\n' ? result += end : result += c;
  for (const char c : bytes) c == '\n' && format == "ascii" ? result += end : result += c;
  return result;
}

std::string stlDialect(const Solid& solid, Dice& dice) {
  if (dice.once(2)) return textStl(solid, dice);
  const Mesh mesh = solid.triangulated();
  std::string result =
      dice.of({"", "solid", "binary stl file", "solid part\nfacet normal 0 0 1\n", "OFF", "\xEF\xBB\xBF"});
  result.resize(80, dice.of({'\0', ' '}));
  result += bytesOf<std::uint32_t>(double(mesh.triangles.size()), false);
  for (const Triangle& t : mesh.triangles) {
    result += std::string(12, '\0');
    for (const std::uint32_t v : t)
      for (int axis = 0; axis < 3; ++axis) result += bytesOf<float>(double(mesh.positions[v][axis]), false);
    result += bytesOf<std::uint16_t>(double(dice.below(9)), false);
  }
  return result;
}

}  // namespace pdc::test
