#pragma once

#include <filesystem>
#include <string_view>

#include "io/parse/content.h"

namespace pdc::detail {

/// What a file is read as by its suffix, in any case. \throws Error for any other suffix, naming those that are known.
[[nodiscard]] MeshFormat meshFormat(const std::filesystem::path& path);

enum class OutputKind { kPly, kObj, kStl, kOff, kGlb, k3mf, kVtp };

/// What a mesh is written as.
struct OutputFormat {
  OutputKind kind;
  bool gzip = false;  ///< Compressed: .ply.gz, .obj.gz, .stl.gz or .off.gz.

  /// Whether it holds any property of the vertices.
  [[nodiscard]] bool holdsProperties() const {
    return kind == OutputKind::kPly || kind == OutputKind::kVtp || kind == OutputKind::kGlb;
  }
  /// Whether it holds coordinates in double precision where these are asked for.
  [[nodiscard]] bool holdsDoubles() const {
    return kind == OutputKind::kPly || kind == OutputKind::kObj || kind == OutputKind::kVtp;
  }
  /// Whether its coordinates are as text.
  [[nodiscard]] bool isText() const {
    return kind == OutputKind::kObj || kind == OutputKind::kOff || kind == OutputKind::k3mf;
  }
};

/// Those that hold properties, for messages.
inline constexpr std::string_view kFormatsWithProperties = ".ply, .vtp and .glb";
/// Those that hold coordinates in double precision, for messages.
inline constexpr std::string_view kFormatsWithDoubles = ".ply, .obj and .vtp";

/// What a file is written as by its suffix, in any case. \throws Error for any other suffix, naming those that are
/// known.
[[nodiscard]] OutputFormat outputFormat(const std::filesystem::path& path);

}  // namespace pdc::detail
