#include "io/parse/off_reader.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/line_ends.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "io/parse/off_header.h"
#include "io/parse/origin_text.h"
#include "io/parse/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, const Vec3d& shift) : mText(text), mScanner(text), mSoup(shift) {}

  ParsedMesh read() {
    readHeader();
    for (std::size_t i = 0; i < mVertices; ++i) readVertex();
    for (std::size_t i = 0; i < mFaces; ++i) readFace();
    if (mScanner.nextLine()) throw malformed(mScanner, "end: more lines than vertices and faces");
    mSoup.splitQuads(mText.ends_with(fmt::format("\n# {}\n", kOwnComment)));
    return mSoup.finish(originInText(mText));
  }

 private:
  void nextLine() {
    if (!mScanner.nextLine())
      throw Error(fmt::format("ends after line {}; {} vertices and {} faces were announced", mScanner.lineNumber(),
                              mVertices, mFaces));
  }

  /// The kind, which may be missing, and then on one or more lines the numbers of vertices and faces. That of edges is
  /// passed over.
  void readHeader() {
    nextLine();
    std::string_view first = mScanner.word();
    if (const auto kind = offKind(first)) {
      mKind = *kind;
      first = kind->after;
      if (lowerCase(mScanner.restOfLine()).starts_with("binary"))
        throw Error("binary OFF is not read, only OFF as text");
    } else if (!TextScanner::parse<std::size_t>(first)) {
      throw Error(fmt::format("not an OFF file: line {} begins with \"{}\"", mScanner.lineNumber(),
                              oneLine(first.substr(0, kMostQuoted))));
    }
    if (mKind.anyDimension) {
      constexpr std::size_t kDimension = 3;
      const std::size_t dimension = readCount(first, "dimension");
      if (dimension != kDimension)
        throw Error(fmt::format("OFF of dimension {}; only {} is read", dimension, kDimension));
      first = {};
    }
    const std::size_t vertices = readCount(first, "number of vertices"), faces = readCount({}, "number of faces");
    // A vertex takes six characters at least, a face two.
    if (vertices > mText.size() / 6 || faces > mText.size() / 2)
      throw Error(fmt::format("{} vertices and {} faces announced in {} bytes", vertices, faces, mText.size()));
    mVertices = vertices;
    mFaces = faces;
  }

  /// \param word the number, or empty where it is still to be taken from this line or the next.
  std::size_t readCount(std::string_view word, std::string_view what) {
    if (word.empty()) word = mScanner.word();
    if (word.empty()) {
      nextLine();
      word = mScanner.word();
    }
    const auto count = TextScanner::parse<std::size_t>(word);
    if (!count) throw malformed(mScanner, what);
    return *count;
  }

  Vec3d readPoint() {
    const auto p = mScanner.point();
    if (!p) throw malformed(mScanner, "vertex");
    return *p;
  }

  void readVertex() {
    nextLine();
    Vec3d p = readPoint();
    if (mKind.homogeneous) {
      const auto w = mScanner.number<double>();
      if (!w || *w == 0) throw malformed(mScanner, "homogeneous vertex");
      p = {p.x / *w, p.y / *w, p.z / *w};
    }
    mSoup.addVertex(p);
    if (mKind.normals) mSoup.addNormal(readPoint());
  }

  void readFace() {
    nextLine();
    const auto size = mScanner.number<std::size_t>();
    if (!size) throw malformed(mScanner, "face");
    mCorners.clear();
    for (std::size_t i = 0; i < *size; ++i) {
      const auto corner = mScanner.number<std::int64_t>();
      if (!corner) throw malformed(mScanner, "face");
      mCorners.push_back(*corner);
    }
    mSoup.addFace(mCorners, mScanner.lineNumber());
  }

  std::string_view mText;
  TextScanner mScanner;
  SoupBuilder mSoup;
  OffKind mKind;
  std::size_t mVertices = 0, mFaces = 0;
  std::vector<std::int64_t> mCorners;
};

}  // namespace

ParsedMesh readOff(std::span<char> text, const Vec3d& shift) {
  endLinesWithNewlines(text);
  return OffReader({text.data(), text.size()}, shift).read();
}

}  // namespace pdc::detail
