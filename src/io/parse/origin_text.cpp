#include "io/parse/origin_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file/file_error.h"
#include "io/file/text_scanner.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::string_view kKeyword = "pdc_origin";

std::optional<Vec3d> finitePoint(TextScanner& scanner) {
  const auto p = scanner.point();
  return p && std::isfinite(p->x) && std::isfinite(p->y) && std::isfinite(p->z) ? p : std::nullopt;
}

}  // namespace

std::string originText(const Vec3d& origin) {
  return fmt::format("{} {} {} {}", kKeyword, origin.x, origin.y, origin.z);
}

std::string originLine(const Mesh& mesh, std::string_view mark) {
  if (mesh.origin == Vec3d{0, 0, 0}) return "";
  return fmt::format("{}{}\n", mark, originText(mesh.origin));
}

std::optional<Vec3d> originInComment(std::string_view comment) {
  TextScanner scanner(comment, '\0');
  if (!scanner.nextLine() || scanner.word() != kKeyword) return std::nullopt;
  const auto origin = finitePoint(scanner);
  return scanner.restOfLine().empty() ? origin : std::nullopt;
}

std::optional<Vec3d> originInText(std::string_view text) {
  std::optional<Vec3d> found;
  const std::string mark = fmt::format("# {} ", kKeyword);
  for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    const std::string_view line = text.substr(at + 1, text.find('\n', at) - at - 1);
    if (const auto origin = originInComment(line)) takeOrigin(*origin, found);
  }
  return found;
}

void takeOrigin(const Vec3d& origin, std::optional<Vec3d>& found) {
  if (found && *found != origin)
    throw Error(fmt::format("two different origins: \"{}\" and \"{}\"", originText(*found), originText(origin)));
  found = origin;
}

std::optional<Vec3d> originInHeader(std::string_view header) {
  TextScanner scanner(header, '\0');
  if (!scanner.nextLine()) return std::nullopt;
  while (!scanner.restOfLine().empty())
    if (scanner.word() == kKeyword) return finitePoint(scanner);
  return std::nullopt;
}

std::string frameText(std::string_view space, std::string_view unit) {
  std::string text;
  const auto add = [&text](std::string_view key, std::string_view value) {
    if (value.empty()) return;
    std::string word = oneLine(value);
    std::replace(word.begin(), word.end(), ' ', '_');
    if (!text.empty()) text += ' ';
    text.append(key).append(word);
  };
  add("SPACE=", space);
  add("UNIT=", unit);
  return text;
}

std::string commentLine(std::string_view text, std::string_view mark) {
  return text.empty() ? std::string() : fmt::format("{}{}\n", mark, text);
}

}  // namespace pdc::detail
