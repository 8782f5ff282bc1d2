#include "io/parse/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/line_ends.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "io/parse/origin_text.h"
#include "io/parse/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// Statements that say nothing of vertices and faces.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vt",       "vp",  "g",        "o",      "s",      "usemtl", "mtllib", "l",   "p",          "mg",       "bevel",
     "c_interp", "lod", "d_interp", "usemap", "maplib", "ctech",  "stech",  "csh", "shadow_obj", "trace_obj"});
/// Statements that make surfaces, or take them from elsewhere.
constexpr auto kNotRead =
    std::to_array<std::string_view>({"cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
                                     "scrv",   "sp",  "end",  "con",  "bzp",  "bsp",   "cdc",  "cdp",  "res",  "call"});

template <typename Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Lines of one sort: how many, and the first.
struct LineCount {
  std::size_t lines = 0, firstLine = 0;
  std::string firstWord;

  void add(std::size_t line, std::string_view word) {
    if (lines++ > 0) return;
    firstLine = line;
    firstWord = oneLine(word.substr(0, kMostQuoted));
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("{} lines are not read; the first is line {}, \"{}\"", lines, firstLine, firstWord);
  }
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const Vec3d& shift) : mText(text), mScanner(text, '#', true), mSoup(shift, 1) {}

  ParsedMesh read() {
    while (mScanner.nextLine()) readStatement(mScanner.word());
    if (!mNormalsFollowVertices || mSoup.normals() != mSoup.vertices()) mSoup.dropNormals();
    mSoup.splitQuads(mText.starts_with(fmt::format("# {}\n", kOwnComment)));
    checkAndWarn();
    return mSoup.finish(originInText(mText));
  }

 private:
  void readStatement(std::string_view keyword) {
    if (keyword == "v") {
      mSoup.addVertex(readPoint("vertex"));
    } else if (keyword == "f") {
      readFace();
    } else if (keyword == "vn") {
      mSoup.addNormal(readPoint("normal"));
    } else if (keyword == "vt") {
      mIsObj = true;
    } else {
      readOther(keyword);
    }
  }

  void readOther(std::string_view keyword) {
    const std::string lower = lowerCase(keyword);
    if (lower != keyword && (lower == "v" || lower == "f" || lower == "vn")) return readStatement(lower);
    if (lower == "fo") return readFace();
    if (contains(kPassedOver, lower)) {
      mIsObj = true;
    } else if (contains(kNotRead, lower)) {
      mIsObj = true;
      mFreeForm.add(mScanner.lineNumber(), lower);
    } else {
      mUnknown.add(mScanner.lineNumber(), keyword);
    }
  }

  Vec3d readPoint(std::string_view what) {
    const auto p = mScanner.point();
    if (!p) throw malformed(mScanner, what);
    return *p;
  }

  void readFace() {
    mCorners.clear();
    while (!mScanner.restOfLine().empty()) readCorner();
    mSoup.addFace(mCorners, mScanner.lineNumber());
  }

  /// vertex, vertex/texture, vertex//normal or vertex/texture/normal; what follows the vertex may be missing.
  void readCorner() {
    if (const auto number = mScanner.number<std::int64_t>()) {
      mCorners.push_back(toIndex(*number, mSoup.vertices()));
      mNormalsFollowVertices = false;
      return;
    }
    const std::string_view corner = mScanner.word();
    const std::size_t slash = corner.find('/');
    mCorners.push_back(readNumber(corner.substr(0, slash), mSoup.vertices()));
    const std::size_t lastSlash = corner.rfind('/');
    if (slash != lastSlash && corner.find('/', slash + 1) != lastSlash) throw malformed(mScanner, "face");
    const std::string_view normal = slash == lastSlash ? std::string_view() : corner.substr(lastSlash + 1);
    if (normal.empty()) {
      mNormalsFollowVertices = false;
      return;
    }
    mNormalsFollowVertices &= readNumber(normal, mSoup.normals()) == mCorners.back();
  }

  std::int64_t readNumber(std::string_view text, std::size_t count) const {
    const auto number = TextScanner::parse<std::int64_t>(text);
    if (!number) throw malformed(mScanner, "face");
    return toIndex(*number, count);
  }

  /// Numbers count from 1, or from the latest of the `count` elements backwards if negative.
  std::int64_t toIndex(std::int64_t number, std::size_t count) const {
    if (number > 0) return number - 1;
    if (number == 0) throw malformed(mScanner, "face");
    if (number < -static_cast<std::int64_t>(count))
      throw Error(fmt::format("line {}: a face names number {}, but only {} come before it", mScanner.lineNumber(),
                              number, count));
    return static_cast<std::int64_t>(count) + number;
  }

  void checkAndWarn() {
    if (mFreeForm.lines > 0 && mSoup.faces() == 0)
      throw Error(fmt::format("it has free-form surfaces and no faces: {}", mFreeForm.text()));
    if (mFreeForm.lines > 0) mSoup.warn(fmt::format("free-form surfaces are not read: {}", mFreeForm.text()));
    const bool isObj = mIsObj || mSoup.vertices() > 0 || mSoup.normals() > 0;
    if (mUnknown.lines > 0 && !isObj)
      throw Error(fmt::format("not an OBJ file: line {} begins with \"{}\"", mUnknown.firstLine, mUnknown.firstWord));
    if (mUnknown.lines > 0) mSoup.warn(fmt::format("no statements of an OBJ file: {}", mUnknown.text()));
    if (!isObj && mText.find('#') == std::string_view::npos) throw Error("not an OBJ file: it is blank");
  }

  std::string_view mText;
  TextScanner mScanner;
  SoupBuilder mSoup;
  std::vector<std::int64_t> mCorners;
  LineCount mFreeForm, mUnknown;
  bool mNormalsFollowVertices = true;
  bool mIsObj = false;  ///< Whether there was a statement other than vertices and faces.
};

}  // namespace

ParsedMesh readObj(std::span<char> text, const Vec3d& shift) {
  endLinesWithNewlines(text);
  return ObjReader({text.data(), text.size()}, shift).read();
}

}  // namespace pdc::detail
