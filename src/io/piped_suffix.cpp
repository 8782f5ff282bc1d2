#include "io/piped_suffix.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "io/deflate/inflate.h"
#include "io/parse/content.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

using std::string_view_literals::operator""sv;

struct Mark {
  std::size_t at;
  std::string_view bytes;
  std::string_view suffix;
};

constexpr std::array kMarks{
    Mark{0, " BDV\0\0\0\0"sv, ".vdb"}, Mark{344, "n+1\0"sv, ".nii"},   Mark{4, "n+2\0"sv, ".nii"},
    Mark{0, "NRRD000"sv, ".nrrd"},     Mark{0, "\x93NUMPY"sv, ".npy"}, Mark{0, "PK\x03\x04"sv, ".npz"},
    Mark{0, "#INRIMAGE"sv, ".inr"},    Mark{0, "II*\0"sv, ".tif"},     Mark{0, "MM\0*"sv, ".tif"},
    Mark{0, "II+\0"sv, ".tif"},        Mark{0, "MM\0+"sv, ".tif"},     Mark{128, "DICM"sv, ".dcm"},
    Mark{0, "ObjectType"sv, ".mha"},   Mark{0, "NDims"sv, ".mha"}};

/// The beginning of what gzip packed; empty where it is damaged.
std::string unpacked(std::string_view bytes) {
  constexpr std::size_t kLooked = std::size_t{1} << 16;
  std::string begin(kLooked, '\0');
  try {
    InflateStream stream(std::span<const char>(bytes.data(), bytes.size()));
    begin.resize(stream.readSome(begin.data(), begin.size()));
  } catch (const Error&) {
    begin.clear();
  }
  return begin;
}

std::string_view suffixOf(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return ".ply";
    case MeshFormat::kObj:
      return ".obj";
    case MeshFormat::kStl:
      return ".stl";
    case MeshFormat::kOff:
      return ".off";
  }
  return "";
}

bool looksLikeScene(std::string_view bytes) {
  return bytes.starts_with("shape:") || bytes.find("\nshape:") != std::string_view::npos;
}

}  // namespace

std::string suffixOfBytes(std::string_view bytes) {
  for (const Mark& mark : kMarks)
    if (bytes.size() > mark.at && bytes.substr(mark.at).starts_with(mark.bytes)) return std::string(mark.suffix);
  if (bytes.starts_with("\x1f\x8b")) {
    const std::string inner = suffixOfBytes(unpacked(bytes));
    return inner.empty() ? "" : inner + ".gz";
  }
  if (const auto format = certainFormat(bytes)) return std::string(suffixOf(*format));
  return looksLikeScene(bytes) ? ".yaml" : "";
}

}  // namespace pdc::detail
