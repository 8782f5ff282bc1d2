#include "io/parse/stl_reader.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "io/file/line_ends.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "io/parse/origin_text.h"
#include "mesh/welding/weld.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

std::size_t announcedFacets(std::string_view bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() >= kStlHeaderBytes) std::memcpy(&facets, bytes.data() + kStlTitleBytes, sizeof(facets));
  return facets;
}

/// A text has no zeros; a title may have none either, but the count of facets after it has, up to 16 million.
bool hasBinaryTitle(std::string_view bytes) {
  return bytes.substr(0, kStlHeaderBytes).find('\0') != std::string_view::npos;
}

std::size_t binarySize(std::string_view bytes) { return kStlHeaderBytes + announcedFacets(bytes) * kStlFacetBytes; }

/// Three corners per facet, after its normal.
Buffer<Vec3f> binaryCorners(std::string_view bytes) {
  const std::size_t facets = announcedFacets(bytes);
  Buffer<Vec3f> corners(3 * facets);
  tbb::parallel_for(std::size_t{0}, facets, [&](std::size_t i) {
    std::memcpy(&corners[3 * i], bytes.data() + kStlHeaderBytes + i * kStlFacetBytes + sizeof(Vec3f),
                3 * sizeof(Vec3f));
  });
  return corners;
}

/// \param bytes as many as the header announces, or more.
ParsedMesh readBinary(std::string_view bytes, const Vec3d& shift) {
  ParsedMesh parsed{.mesh = weld(binaryCorners(bytes)), .narrowing = {}, .warnings = {}};
  parsed.mesh.origin = originInHeader(bytes.substr(0, kStlTitleBytes)).value_or(Vec3d{0, 0, 0}) + shift;
  if (bytes.size() > binarySize(bytes))
    parsed.warnings.push_back(fmt::format("{} bytes after the last of {} facets are not read",
                                          bytes.size() - binarySize(bytes), announcedFacets(bytes)));
  return parsed;
}

/// Goes through the text word by word, since some files put a whole facet on one line.
class TextReader {
 public:
  TextReader(std::string_view text, const Vec3d& shift) : mScanner(text, '\0'), mShift(shift) {}

  ParsedMesh read() {
    while (mScanner.nextLine())
      while (!mScanner.restOfLine().empty()) readWord(mScanner.word());
    if (!mEnded) throw Error(fmt::format("ends after line {} without endsolid", mScanner.lineNumber()));
    mParsed.mesh = weld(mCorners);
    mParsed.mesh.origin = mOrigin.value_or(Vec3d{0, 0, 0}) + mShift;
    if (mUnknown > 0)
      mParsed.warnings.push_back(
          fmt::format("{} lines are not of an STL file and not read; the first is line {}", mUnknown, mFirstUnknown));
    return std::move(mParsed);
  }

 private:
  void readWord(std::string_view word) {
    if (word != "vertex") mLower = lowerCase(word);
    if (word == "vertex" || mLower == "vertex") {
      readVertex();
    } else if (mLower == "facet" || mLower == "endfacet") {
      if (mCorners.size() % 3 != 0)
        throw Error(fmt::format("line {}: a facet that is not a triangle", mScanner.lineNumber()));
      mEnded = false;
      if (mLower == "facet") skipNormal();
    } else if (mLower == "solid" || mLower == "endsolid") {
      readSolid();
    } else if (mLower != "outer" && mLower != "loop" && mLower != "endloop") {
      if (mUnknown++ == 0) mFirstUnknown = mScanner.lineNumber();
      skipLine();
    }
  }

  void readVertex() {
    const auto p = mScanner.point();
    if (!p) throw malformed(mScanner, "vertex");
    mParsed.narrowing.include(*p);
    mCorners.push_back(vecCast<float>(*p - mShift));
    mEnded = false;
  }

  void skipNormal() {
    constexpr int kWords = 4;  // "normal" and its three numbers
    for (int i = 0; i < kWords; ++i) mScanner.word();
  }

  /// The rest of the line is a name.
  void readSolid() {
    if (mLower == "endsolid") {
      if (mCorners.size() % 3 != 0)
        throw Error(fmt::format("line {}: a facet that is not a triangle", mScanner.lineNumber()));
      mEnded = true;
    } else if (!mHasTitle) {
      mHasTitle = true;
      mOrigin = originInHeader(mScanner.restOfLine());
    }
    skipLine();
  }

  void skipLine() {
    while (!mScanner.restOfLine().empty()) mScanner.word();
  }

  TextScanner mScanner;
  Vec3d mShift;
  ParsedMesh mParsed;
  Buffer<Vec3f> mCorners;
  std::optional<Vec3d> mOrigin;
  std::string mLower;
  std::size_t mUnknown = 0, mFirstUnknown = 0;
  bool mEnded = false, mHasTitle = false;
};

}  // namespace

bool isExactBinaryStl(std::string_view bytes) {
  return announcedFacets(bytes) > 0 && bytes.size() == binarySize(bytes);
}

bool isTextStl(std::string_view bytes) {
  constexpr std::size_t kLooked = 8192;
  std::string head(bytes.substr(0, kLooked));
  if (hasBinaryTitle(bytes)) return false;
  endLinesWithNewlines(head);
  TextScanner scanner(head, '\0');
  if (!scanner.nextLine() || lowerCase(scanner.word()) != "solid") return false;
  while (scanner.nextLine()) {
    const std::string word = lowerCase(scanner.word());
    if (word == "facet" || word == "endsolid") return true;
  }
  return false;
}

ParsedMesh readStl(std::span<char> bytes, const Vec3d& shift) {
  const std::string_view view(bytes.data(), bytes.size());
  if (view.size() == binarySize(view)) return readBinary(view, shift);
  if (isTextStl(view)) {
    endLinesWithNewlines(bytes);
    return TextReader(view, shift).read();
  }
  if (!hasBinaryTitle(view)) throw Error("not an STL file: a text without lines that begin with solid and facet");
  if (view.size() < kStlHeaderBytes) throw Error(fmt::format("{} bytes are too few for an STL file", view.size()));
  if (view.size() > binarySize(view) && announcedFacets(view) > 0) return readBinary(view, shift);
  throw Error(fmt::format("{} facets make {} bytes, but the file has {}", announcedFacets(view), binarySize(view),
                          view.size()));
}

}  // namespace pdc::detail
