#include "pdc/io/points/points_reader.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "pdc/error.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

class PointsReader : public testing::Test {
 protected:
  PointsReader() { fs::create_directories(mFolder); }
  ~PointsReader() override { fs::remove_all(mFolder); }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(mFolder / name, std::ios::binary) << bytes;
    return mFolder / name;
  }
  [[nodiscard]] std::string complaint(const std::string& name, const std::string& bytes) const {
    try {
      (void)readPoints(write(name, bytes));
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(name), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      return text;
    }
    return "";
  }

  fs::path mFolder = fs::temp_directory_path() / ("points_reader_test_" + std::to_string(getpid()));
};

using Colour = std::array<std::uint8_t, 3>;

TEST_F(PointsReader, ReadsTextWithAndWithoutNormalsAndColours) {
  const PointCloud plain = readPoints(write("a.xyz", "# three\n1 2 3\n4,5,6\n\n-1e2\t0 .5\n"));
  EXPECT_EQ(plain.positions, (Buffer<Vec3d>{{1, 2, 3}, {4, 5, 6}, {-100, 0, 0.5}}));
  EXPECT_TRUE(plain.normals.empty());
  const PointCloud normals = readPoints(write("b.xyz", "1 2 3 0 0 0.5\n4 5 6 1 0 0\n"));
  EXPECT_EQ(normals.normals, (Buffer<Vec3f>{{0, 0, 1}, {1, 0, 0}}));
  const PointCloud colours = readPoints(write("c.xyz", "1 2 3 255 0 7\n4 5 6 1 0 0\n"));
  EXPECT_EQ(colours.colours, (Buffer<Colour>{{255, 0, 7}, {1, 0, 0}}));
  const PointCloud scan = readPoints(write("d.pts", "2\r\n1 2 3 0.5 9 8 7\r\n4 5 6 0.25 6 5 4\r\n"));
  EXPECT_EQ(scan.positions.size(), 2U);
  EXPECT_EQ(scan.colours, (Buffer<Colour>{{9, 8, 7}, {6, 5, 4}}));
  const PointCloud all = readPoints(write("e.xyz", "1 2 3 9 8 7 0 1 0\n"));
  EXPECT_EQ(all.normals[0], (Vec3f{0, 1, 0}));
  EXPECT_EQ(all.colours[0], (Colour{9, 8, 7}));
}

TEST_F(PointsReader, ReadsThePropertiesOfPlyFiles) {
  const PointCloud cloud = readPoints(
      write("a.ply",
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float sigma\nproperty uchar red\n"
            "property uchar green\nproperty uchar blue\nend_header\n1 2 3 0 0 1 0.5 1 2 3\n4 5 6 0 3 0 0.25 4 5 6\n"));
  EXPECT_EQ(cloud.positions, (Buffer<Vec3d>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.normals[1], (Vec3f{0, 1, 0}));
  EXPECT_EQ(cloud.sigmas, (Buffer<float>{0.5F, 0.25F}));
  EXPECT_EQ(cloud.colours[1], (Colour{4, 5, 6}));
}

const std::string kPcdHeader =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4\n"
    "TYPE F F F U F F F\nCOUNT 1 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

TEST_F(PointsReader, ReadsPcdAsTextAndBinaryAlike) {
  const PointCloud text = readPoints(write("a.pcd", kPcdHeader + "DATA ascii\n1 2 3 66051 0 0 1\n4 5 6 0 0 1 0\n"));
  std::string bytes;
  const auto add = [&bytes](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const float v : {1.F, 2.F, 3.F}) add(v);
  add(std::uint32_t{66051});
  for (const float v : {0.F, 0.F, 1.F, 4.F, 5.F, 6.F}) add(v);
  add(std::uint32_t{0});
  for (const float v : {0.F, 1.F, 0.F}) add(v);
  const PointCloud binary = readPoints(write("b.pcd", kPcdHeader + "DATA binary\n" + bytes));
  EXPECT_EQ(text.positions, (Buffer<Vec3d>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(text.colours[0], (Colour{1, 2, 3}));
  EXPECT_EQ(text.normals[1], (Vec3f{0, 1, 0}));
  EXPECT_EQ(binary.positions, text.positions);
  EXPECT_EQ(binary.colours, text.colours);
  EXPECT_EQ(binary.normals, text.normals);
  EXPECT_NE(complaint("c.pcd", kPcdHeader + "DATA binary\n" + bytes.substr(0, 50)).find("ends before the last of 2"),
            std::string::npos);
  EXPECT_NE(complaint("d.pcd", kPcdHeader + "DATA ascii\n1 2 3 66051 0 0 1\n").find("ends after 1 of 2"),
            std::string::npos);
  EXPECT_NE(complaint("e.pcd", kPcdHeader + "DATA binary_compressed\n").find("compressed"), std::string::npos);
  EXPECT_NE(complaint("f.pcd", kPcdHeader).find("no DATA line"), std::string::npos);
}

TEST_F(PointsReader, ReadsPointGridsInWorldSpace) {
  openvdb::initialize();
  const std::vector<openvdb::Vec3f> places{{1, 2, 3}, {-4, 5, 6.25F}, {100, 0, 0}};
  const auto transform = openvdb::math::Transform::createLinearTransform(0.5);
  transform->postTranslate({10, 0, 0});
  const openvdb::points::PointAttributeVector<openvdb::Vec3f> list(places);
  const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(list, *transform);
  const auto grid = openvdb::points::createPointDataGrid<openvdb::points::NullCodec, openvdb::points::PointDataGrid>(
      *index, list, *transform);
  const fs::path path = mFolder / "points.vdb";
  openvdb::io::File(path.string()).write({grid});
  const PointCloud cloud = readPoints(path);
  ASSERT_EQ(cloud.positions.size(), 3U);
  for (const openvdb::Vec3f& p : places) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& q : cloud.positions) nearest = std::min(nearest, length(q - Vec3d{p.x(), p.y(), p.z()}));
    EXPECT_LT(nearest, 1e-5);
  }
  std::string bytes(fs::file_size(path), '\0');
  std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  EXPECT_NE(complaint("cut.vdb", bytes.substr(0, bytes.size() / 2)), "");
}

TEST_F(PointsReader, LeavesOutPointsThatAreNowhereAndSaysSo) {
  std::vector<std::string> warnings;
  const fs::path path = write("a.xyz", "1 2 3 0 0 1\nnan nan nan 0 0 1\n4 5 6 nan 0 0\n");
  const PointCloud cloud = readPoints(path, {.warn = [&](const std::string& w) { warnings.push_back(w); }});
  EXPECT_EQ(cloud.positions, (Buffer<Vec3d>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.normals, (Buffer<Vec3f>{{0, 0, 1}, {0, 0, 0}}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("1 points are not finite"), std::string::npos);
  EXPECT_NE(complaint("b.xyz", "nan nan nan\n").find("no points with finite coordinates"), std::string::npos);
}

TEST_F(PointsReader, SaysWhatIsWrongInOneLine) {
  EXPECT_NE(complaint("a.xyz", "1 2\n").find("line 1 has 2 numbers"), std::string::npos);
  EXPECT_NE(complaint("b.xyz", "1 2 3\n1 2 3 4\n").find("line 2 has 4 numbers; the first point has 3"),
            std::string::npos);
  EXPECT_NE(complaint("c.xyz", "1 2 x\n").find("line 1: malformed point"), std::string::npos);
  EXPECT_NE(complaint("d.pts", "3\n1 2 3\n").find("3 points were announced in line 1; there are 1"), std::string::npos);
  EXPECT_NE(complaint("e.xyz", "# nothing\n").find("has no points"), std::string::npos);
  EXPECT_NE(complaint("f.xyz", std::string("1 2 3\0", 6)).find("binary"), std::string::npos);
  EXPECT_NE(complaint("g.las", "x").find("suffix"), std::string::npos);
  EXPECT_NE(complaint("h.vdb", "nonsense"), "");
  EXPECT_THROW((void)readPoints(mFolder / "missing.xyz"), Error);
}

}  // namespace
}  // namespace pdc
