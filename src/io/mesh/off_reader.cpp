#include "io/mesh/off_reader.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "io/file/text_scanner.h"
#include "io/mesh/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

class OffReader {
 public:
  explicit OffReader(std::string_view text) : mText(text), mScanner(text) {}

  Mesh read() {
    readHeader();
    for (std::size_t i = 0; i < mVertices; ++i) readVertex();
    for (std::size_t i = 0; i < mFaces; ++i) readFace();
    if (mScanner.nextLine()) throw malformed("end: more lines than vertices and faces");
    return mSoup.finish();
  }

 private:
  Error malformed(std::string_view what) const {
    return Error(fmt::format("line {}: malformed {}", mScanner.lineNumber(), what));
  }

  void nextLine() {
    if (!mScanner.nextLine())
      throw Error(fmt::format("ends after line {}; {} vertices and {} faces were announced", mScanner.lineNumber(),
                              mVertices, mFaces));
  }

  /// The kind, and on the same line or the next the numbers of vertices, faces and edges.
  void readHeader() {
    nextLine();
    const std::string_view kind = mScanner.word();
    if (kind != "OFF" && kind != "NOFF" && kind != "COFF" && kind != "CNOFF" && kind != "STOFF")
      throw Error(fmt::format("not an OFF file of a supported kind (OFF, NOFF, COFF, CNOFF, STOFF as text)"));
    mNormals = kind == "NOFF";
    std::string_view first = mScanner.word();
    if (first.empty()) {
      nextLine();
      first = mScanner.word();
    }
    const auto vertices = TextScanner::parse<std::size_t>(first), faces = mScanner.number<std::size_t>();
    if (!vertices || !faces) throw malformed("number of vertices and faces");
    // A vertex takes six characters at least, a face two.
    if (*vertices > mText.size() / 6 || *faces > mText.size() / 2)
      throw Error(fmt::format("{} vertices and {} faces announced in {} bytes", *vertices, *faces, mText.size()));
    mVertices = *vertices;
    mFaces = *faces;
  }

  Vec3f readVector() {
    const auto x = mScanner.number<float>(), y = mScanner.number<float>(), z = mScanner.number<float>();
    if (!x || !y || !z) throw malformed("vertex");
    return {*x, *y, *z};
  }

  void readVertex() {
    nextLine();
    mSoup.addVertex(readVector());
    if (mNormals) mSoup.addNormal(readVector());
  }

  void readFace() {
    nextLine();
    const auto size = mScanner.number<std::size_t>();
    if (!size) throw malformed("face");
    mCorners.clear();
    for (std::size_t i = 0; i < *size; ++i) {
      const auto corner = mScanner.number<std::int64_t>();
      if (!corner) throw malformed("face");
      mCorners.push_back(*corner);
    }
    mSoup.addFace(mCorners);
  }

  std::string_view mText;
  TextScanner mScanner;
  SoupBuilder mSoup;
  std::size_t mVertices = 0, mFaces = 0;
  bool mNormals = false;
  std::vector<std::int64_t> mCorners;
};

}  // namespace

Mesh readOff(std::string_view text) { return OffReader(text).read(); }

}  // namespace pdc::detail
