#include "io/parse/content.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/file/line_ends.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/off_header.h"
#include "io/parse/ply_header.h"
#include "io/parse/stl_reader.h"

namespace pdc::detail {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes, name;
};

/// How files of other kinds begin.
constexpr auto kMagic = std::to_array<Magic>({
    {"\x89PNG"sv, "a PNG picture"},
    {"\xFF\xD8\xFF"sv, "a JPEG picture"},
    {"GIF8"sv, "a GIF picture"},
    {"%PDF"sv, "a PDF document"},
    {"\x1F\x8B"sv, "gzip, which is to be unpacked first"},
    {"BZh"sv, "bzip2, which is to be unpacked first"},
    {"\xFD"
     "7zXZ"sv,
     "xz, which is to be unpacked first"},
    {"\x28\xB5\x2F\xFD"sv, "zstd, which is to be unpacked first"},
    {"7z\xBC\xAF"sv, "7z, which is to be unpacked first"},
    {"Rar!"sv, "RAR, which is to be unpacked first"},
    {"PK\x03\x04"sv, "zip, as 3MF and other archives are"},
    {"glTF"sv, "binary glTF"},
    {"ISO-10303-21"sv, "STEP"},
    {" BDV\0\0\0\0"sv, "a VDB grid"},
    {"BLENDER"sv, "a Blender scene"},
    {"Kaydara FBX"sv, "FBX"},
    {"PXR-USDC"sv, "USD"},
    {"#usda"sv, "USD"},
    {"#VRML"sv, "VRML"},
    {"# vtk DataFile"sv, "VTK"},
    {"$MeshFormat"sv, "a Gmsh mesh"},
    {"MeshVersionFormatted"sv, "a Medit mesh"},
    {"version https://git-lfs"sv, "a Git LFS pointer, whose file was not fetched"},
    {"\x89HDF"sv, "HDF5"},
    {"\x93NUMPY"sv, "a NumPy array"},
    {"\x7F"
     "ELF"sv,
     "an object file of a compiler"},
    {"\x64\x86"sv, "an object file of a compiler"},
    {"\x4C\x01"sv, "an object file of a compiler"},
    {"MM\0\0\0"sv, "3DS"},
    {"\xFF\xFE"sv, "UTF-16 text, which is to be saved as UTF-8"},
    {"\xFE\xFF"sv, "UTF-16 text, which is to be saved as UTF-8"},
});

/// How texts of other kinds begin, in lower case, after blanks.
constexpr auto kTextMagic = std::to_array<Magic>({
    {"<!doctype html"sv, "an HTML page"},
    {"<html"sv, "an HTML page"},
    {"<head"sv, "an HTML page"},
    {"<?xml"sv, "XML"},
    {"<"sv, "XML or HTML"},
    {"{"sv, "JSON, as glTF is"},
    {"["sv, "JSON"},
});

/// UTF-16 without a mark: every second byte of plain letters is zero.
bool looksLikeUtf16(std::string_view bytes) {
  constexpr std::size_t kLooked = 256;
  std::array<std::size_t, 2> zeros{};
  const std::size_t size = std::min(bytes.size(), kLooked);
  for (std::size_t i = 0; i < size; ++i) zeros[i % 2] += bytes[i] == '\0';
  const auto [few, many] = std::minmax(zeros[0], zeros[1]);
  return size >= 8 && few == 0 && 10 * many >= 9 * (size / 2);
}

/// A vertex of three numbers, before anything that an OBJ file does not have.
bool looksLikeObj(std::string_view bytes) {
  constexpr std::size_t kLooked = 8192;
  std::string head(bytes.substr(0, kLooked));
  endLinesWithNewlines(head);
  TextScanner scanner(head);
  while (scanner.nextLine()) {
    const std::string word = lowerCase(scanner.word());
    if (word == "v") return scanner.point().has_value();
    if (word != "mtllib" && word != "o" && word != "g" && word != "s" && word != "usemtl" && word != "vt" &&
        word != "vn")
      return false;
  }
  return false;
}

std::string_view firstWord(std::string_view bytes) {
  // Comments may come before it, so this is about the first line that is none.
  constexpr std::string_view kBlanks = " \t\r\n";
  for (;;) {
    const std::size_t begin = bytes.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    bytes.remove_prefix(begin);
    if (bytes.front() != '#') return bytes.substr(0, bytes.find_first_of(kBlanks));
    const std::size_t end = bytes.find_first_of("\r\n");
    if (end == std::string_view::npos) return {};
    bytes.remove_prefix(end);
  }
}

}  // namespace

std::string_view formatName(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return "a PLY file";
    case MeshFormat::kObj:
      return "an OBJ file";
    case MeshFormat::kStl:
      return "an STL file";
    case MeshFormat::kOff:
      break;
  }
  return "an OFF file";
}

std::optional<MeshFormat> certainFormat(std::string_view bytes) {
  if (isExactBinaryStl(bytes) || isTextStl(bytes)) return MeshFormat::kStl;
  if (isPly(bytes)) return MeshFormat::kPly;
  if (offKind(firstWord(bytes))) return MeshFormat::kOff;
  if (looksLikeObj(bytes)) return MeshFormat::kObj;
  return std::nullopt;
}

std::string_view otherContent(std::string_view bytes) {
  for (const Magic& magic : kMagic)
    if (bytes.starts_with(magic.bytes)) return magic.name;
  if (looksLikeUtf16(bytes)) return "UTF-16 text, which is to be saved as UTF-8";
  constexpr std::size_t kLooked = 32;
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const std::string text = lowerCase(bytes.substr(begin, kLooked));
  for (const Magic& magic : kTextMagic)
    if (text.starts_with(magic.bytes)) return magic.name;
  return {};
}

}  // namespace pdc::detail
