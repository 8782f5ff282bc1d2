#include <fmt/format.h>

#include <algorithm>

#include "io/mesh/dialects.h"

namespace pdc::test {
namespace {

/// A number in one of the ways in which it can be written.
std::string number(double value, Dice& dice) {
  switch (dice.below(5)) {
    case 0:
      return fmt::format("{}", value);
    case 1:
      return fmt::format("{:.6f}", value);
    case 2:
      return fmt::format("{:e}", value);
    case 3:
      return fmt::format("{:+.1f}", value);
    default:
      return fmt::format("{:.9E}", value);
  }
}

std::string point(const Vec3d& p, Dice& dice) {
  const char* blank = dice.of({" ", "  ", "\t"});
  return number(p.x, dice) + blank + number(p.y, dice) + blank + number(p.z, dice);
}

std::string upperCase(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

/// Puts a mark before a text and other ends to its lines.
std::string finished(const std::string& text, Dice& dice) {
  const char* end = dice.of({"\n", "\r\n", "\r"});
  std::string result = dice.once(5) ? "\xEF\xBB\xBF" : "";
  for (const char c : text) c == '\n' ? result += end : result += c;
  if (dice.once(5))
    while (!result.empty() && (result.back() == '\n' || result.back() == '\r')) result.pop_back();
  return result;
}

/// How all corners of a file name what goes with their vertex.
std::string cornerTail(std::size_t style, const std::string& vertex) {
  switch (style) {
    case 1:
      return "/1";
    case 2:
      return "/1/";
    case 3:
      return "//";
    case 4:
      return "//" + vertex;
    case 5:
      return "/1/" + vertex;
    default:
      return "";
  }
}

std::string objFace(const std::vector<std::uint32_t>& face, std::size_t vertices, std::size_t style, Dice& dice) {
  const bool backwards = dice.once(4);
  std::string line = dice.once(8) ? "\tf" : "f";
  for (const std::uint32_t v : face) {
    const std::string name = backwards ? fmt::format("-{}", vertices - v) : fmt::format("{}", v + 1);
    line += (dice.once(9) ? " \\\n " : dice.of({" ", "  ", "\t"})) + name + cornerTail(style, name);
  }
  return line + (dice.once(6) ? " # face\n" : dice.once(6) ? " \n" : "\n");
}

}  // namespace

std::string objDialect(const Solid& solid, Dice& dice) {
  const std::size_t style = dice.below(6), extra = dice.below(4);
  std::string text = dice.of({"", "# made by hand\n\n", "mtllib a.mtl\no thing\n", "#\n\n\n"});
  for (const Vec3d& p : solid.positions) {
    text += "v " + point(p, dice);
    if (extra == 1) text += " 1.0";
    if (extra == 2) text += " 0.5 0.25 1";
    text += '\n';
  }
  if (style == 1 || style == 2 || style == 5) text += "vt 0 0\nvt 1 0.5 0\n";
  if (style > 3)
    for (std::size_t i = 0; i < solid.positions.size(); ++i) text += "vn 0 0 1\n";
  if (dice.once(3)) text += "g part\ns off\nusemtl red\n";
  for (const auto& face : solid.faces) {
    text += objFace(face, solid.positions.size(), style, dice);
    if (dice.once(8)) text += dice.of({"\n", "# next\n", "s 1\n", "l 1 2\n", "p 1\n", "usemtl blue\n"});
  }
  return finished(dice.once(5) ? upperCase(text) : text, dice);
}

std::string offDialect(const Solid& solid, Dice& dice) {
  struct Kind {
    const char* keyword;
    const char* tail;  // of each vertex
  };
  const Kind kind = dice.of<Kind>({{"OFF", ""},
                                   {"off", ""},
                                   {"", ""},
                                   {"NOFF", " 0 0 1"},
                                   {"COFF", " 255 0 0 255"},
                                   {"CNOFF", " 0 0 1 0.5 0.5 0.5 1"},
                                   {"STOFF", " 0.5 1"},
                                   {"4OFF", " 1"},
                                   {"nOFF 3", ""}});
  std::string text = dice.once(4) ? "# made by hand\n" : "";
  text += kind.keyword;
  const bool attached = std::string(kind.keyword).ends_with('F') && dice.once(3);
  if (!attached && *kind.keyword != '\0') text += dice.of({"\n", " ", "\n# counts\n\n"});
  text += fmt::format("{} {}{}\n", solid.positions.size(), solid.faces.size(), dice.of({" 0", "", " 12"}));
  for (const Vec3d& p : solid.positions)
    text += point(p, dice) + kind.tail + dice.of({"\n", " \n", " # vertex\n", "\n\n"});
  for (const auto& face : solid.faces) {
    text += fmt::format("{} ", face.size());
    for (const std::uint32_t v : face) text += fmt::format(" {}", v);
    text += dice.of({"\n", " 255 0 0\n", " 0.5 0.5 0.5 1\n", " 7\n"});
  }
  return finished(text, dice);
}

std::string textStl(const Solid& solid, Dice& dice) {
  const Mesh mesh = solid.triangulated();
  const std::string line = dice.once(5) ? " " : "\n";  // between the parts of a facet
  const std::size_t split = dice.once(3) ? dice.below(mesh.triangles.size()) : 0;
  std::string text =
      std::string(dice.of({"", " ", "\n\n", "\t"})) + "solid " + dice.of({"", "part", "facet of a part"}) + "\n";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (split > 0 && i == split) text += "endsolid\nsolid other\n";
    text +=
        "  facet normal " + std::string(dice.of({"0 0 1", "0 0 0", "nan nan nan"})) + line + "    outer loop" + line;
    for (const std::uint32_t v : mesh.triangles[i])
      text += "      vertex " + point(vecCast<double>(mesh.positions[v]), dice) + line;
    text += "    endloop" + line + "  endfacet\n";
  }
  text += dice.of({"endsolid\n", "endsolid part\n", "endsolid part\n\n \n", "endsolid\n# the end\n"});
  return finished(dice.once(5) ? upperCase(text) : text, dice);
}

}  // namespace pdc::test
