#include "io/mesh/obj_reader.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "io/file/text_scanner.h"
#include "io/mesh/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

Error malformed(const TextScanner& scanner, std::string_view what) {
  return Error(fmt::format("line {}: malformed {}", scanner.lineNumber(), what));
}

Vec3f readVector(TextScanner& scanner, std::string_view what) {
  const auto x = scanner.number<float>(), y = scanner.number<float>(), z = scanner.number<float>();
  if (!x || !y || !z) throw malformed(scanner, what);
  return {*x, *y, *z};
}

/// Numbers count from 1, or from the latest element backwards if negative.
std::int64_t toIndex(std::int64_t number, std::size_t count) {
  return number < 0 ? static_cast<std::int64_t>(count) + number : number - 1;
}

class ObjReader {
 public:
  explicit ObjReader(std::string_view text) : mScanner(text) {}

  Mesh read() {
    while (mScanner.nextLine()) {
      const std::string_view keyword = mScanner.word();
      if (keyword == "v") mSoup.addVertex(readVector(mScanner, "vertex"));
      if (keyword == "vn") mSoup.addNormal(readVector(mScanner, "normal"));
      if (keyword == "f") readFace();
    }
    if (!mNormalsFollowVertices || mSoup.normals() != mSoup.vertices()) mSoup.dropNormals();
    return mSoup.finish();
  }

 private:
  void readFace() {
    mCorners.clear();
    for (std::string_view corner = mScanner.word(); !corner.empty(); corner = mScanner.word()) readCorner(corner);
    mSoup.addFace(mCorners);
  }

  /// vertex, vertex/texture, vertex//normal or vertex/texture/normal.
  void readCorner(std::string_view corner) {
    const std::size_t slash = corner.find('/');
    const auto vertex = TextScanner::parse<std::int64_t>(corner.substr(0, slash));
    if (!vertex || *vertex == 0) throw malformed(mScanner, "face");
    mCorners.push_back(toIndex(*vertex, mSoup.vertices()));

    const std::size_t lastSlash = corner.rfind('/');
    if (slash == lastSlash) {
      mNormalsFollowVertices = false;
      return;
    }
    const auto normal = TextScanner::parse<std::int64_t>(corner.substr(lastSlash + 1));
    if (!normal) throw malformed(mScanner, "face");
    mNormalsFollowVertices &= toIndex(*normal, mSoup.normals()) == mCorners.back();
  }

  TextScanner mScanner;
  SoupBuilder mSoup;
  std::vector<std::int64_t> mCorners;
  bool mNormalsFollowVertices = true;
};

}  // namespace

Mesh readObj(std::string_view text) { return ObjReader(text).read(); }

}  // namespace pdc::detail
