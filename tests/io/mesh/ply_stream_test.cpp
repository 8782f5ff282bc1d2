#include "io/mesh/ply_stream.h"

#include <gtest/gtest.h>

#include <string>

namespace pdc::detail {
namespace {

constexpr const char* kVertices = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

/// Whether a file with these elements can be streamed.
bool streams(const std::string& elements, const std::string& format = "binary_little_endian") {
  std::string bytes = "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + std::string(100, '\0');
  return PlyStream::open(parsePlyHeader(bytes)).has_value();
}

TEST(PlyStream, StreamsFilesWhoseVerticesComeFirst) {
  const std::string vertices = kVertices, faces = kFaces;
  EXPECT_TRUE(streams(vertices + faces));
  EXPECT_TRUE(streams(vertices + faces, "binary_big_endian"));
  EXPECT_TRUE(streams("element camera 1\nproperty int a\n" + vertices + "property uchar red\n" + faces +
                      "property list uchar float uv\nelement edge 1\nproperty list uchar int a\n"));
}

TEST(PlyStream, LeavesOthersToTheReader) {
  const std::string vertices = kVertices, faces = kFaces;
  EXPECT_FALSE(streams(vertices + faces, "ascii"));
  EXPECT_FALSE(streams(faces + vertices));
  EXPECT_FALSE(streams(vertices));
  EXPECT_FALSE(streams(vertices + vertices + faces));
  EXPECT_FALSE(streams(vertices + faces + faces));
  EXPECT_FALSE(streams(vertices + "property float x\n" + faces));
  EXPECT_FALSE(streams(vertices + "property list uchar int neighbours\n" + faces));
  EXPECT_FALSE(streams("element camera 1\nproperty list uchar int a\n" + vertices + faces));
  EXPECT_FALSE(streams(vertices + "element tristrips 1\nproperty list int int vertex_indices\n" + faces));
  EXPECT_FALSE(streams(vertices + faces + "element tristrips 1\nproperty list int int vertex_indices\n"));
  EXPECT_FALSE(streams(vertices + "element face 1\nproperty list uchar int corners\n"));
  EXPECT_FALSE(streams("element vertex 9\nproperty float x\nproperty float y\nproperty float z\n" + faces))
      << "the vertices do not fit into the file";
}

}  // namespace
}  // namespace pdc::detail
