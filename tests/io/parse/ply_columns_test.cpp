#include "io/parse/ply_columns.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/file/temporary_folder.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"

namespace pdc {
namespace {

/// Reads `contents` from a .ply file.
Mesh readText(std::string_view contents) {
  const TemporaryFolder folder;
  writeContents(folder / "a.ply", contents);
  return readMesh(folder / "a.ply");
}

template <typename Number>
std::string bytes(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof(number)};
}

std::string swapped(std::string number) { return {number.rbegin(), number.rend()}; }

/// A .ply as text with these columns besides x, y and z, and one vertex at the origin.
Mesh readVertex(const std::string& columns, const std::string& numbers) {
  return readText("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" +
                  columns + "end_header\n0 0 0 " + numbers + "\n");
}

TEST(PlyColumns, PropertiesOfVertices) {
  const Mesh mesh = readText(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
      "property double confidence\nproperty float x\nproperty float y\nproperty float z\nproperty uchar rank\n"
      "property list uchar int tags\nend_header\n3 0 1 2\n0.5 0 0 0 1 0\n0.25 1 0 0 2 2 7 8\n1 0 1 0 255 1 9\n");
  ASSERT_EQ(mesh.properties.size(), 2u);
  EXPECT_EQ(mesh.properties[0], (VertexProperty{"confidence", 1, Buffer<double>{0.5, 0.25, 1}}));
  EXPECT_EQ(mesh.properties[1], (VertexProperty{"rank", 1, Buffer<std::uint8_t>{1, 2, 255}}));
}

TEST(PlyColumns, NumbersOfAllTypesArriveAsTheyAre) {
  const std::vector<VertexProperty> expected{{"a", 1, Buffer<std::int8_t>{-128}},
                                             {"b", 1, Buffer<std::uint8_t>{255}},
                                             {"c", 1, Buffer<std::int16_t>{-32768}},
                                             {"d", 1, Buffer<std::uint16_t>{65535}},
                                             {"e", 1, Buffer<std::int32_t>{-2147483647 - 1}},
                                             {"f", 1, Buffer<std::uint32_t>{4294967295u}},
                                             {"g", 1, Buffer<float>{0.1F}},
                                             {"h", 1, Buffer<double>{0.1}}};
  const std::string columns =
      "property char a\nproperty uint8 b\nproperty short c\nproperty uint16 d\nproperty int e\nproperty uint32 f\n"
      "property float32 g\nproperty double h\n";
  EXPECT_EQ(readVertex(columns, "-128 255 -32768 65535 -2147483648 4294967295 0.1 0.1").properties, expected);
  const std::string head = "ply\nformat binary_big_endian 1.0\nelement vertex 1\n";
  const std::string body = bytes(std::int8_t{-128}) + bytes(std::uint8_t{255}) + swapped(bytes(std::int16_t{-32768})) +
                           bytes(std::uint16_t{65535}) + swapped(bytes(std::int32_t{-2147483647 - 1})) +
                           bytes(std::uint32_t{4294967295u}) + swapped(bytes(0.1F)) + swapped(bytes(0.1));
  EXPECT_EQ(readText(head + columns + "property char x\nproperty char y\nproperty char z\nend_header\n" + body +
                     std::string(3, '\0'))
                .properties,
            expected);
}

TEST(PlyColumns, ColumnsOfAVectorBecomeOneProperty) {
  const Mesh mesh = readVertex(
      "property float v_x\nproperty float v_y\nproperty float v_z\nproperty int w_x\nproperty int w_y\n"
      "property uchar c_x\nproperty uchar c_y\nproperty uchar c_z\nproperty uchar c_w\n",
      "1 2 3 4 5 6 7 8 9");
  EXPECT_EQ(mesh.properties, (std::vector<VertexProperty>{{"v", 3, Buffer<float>{1, 2, 3}},
                                                          {"w", 2, Buffer<std::int32_t>{4, 5}},
                                                          {"c", 4, Buffer<std::uint8_t>{6, 7, 8, 9}}}));
}

TEST(PlyColumns, ColumnsThatAreNoVectorStaySingle) {
  const auto names = [](const std::string& columns, const std::string& numbers) {
    std::vector<std::string> result;
    for (const VertexProperty& p : readVertex(columns, numbers).properties) {
      EXPECT_EQ(p.components, 1) << p.name;
      result.push_back(p.name);
    }
    return result;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names("property float v_x\nproperty double v_y\n", "1 2"), (Names{"v_x", "v_y"})) << "of two types";
  EXPECT_EQ(names("property float v_y\nproperty float v_x\n", "1 2"), (Names{"v_y", "v_x"})) << "out of order";
  EXPECT_EQ(names("property float v_x\nproperty float w\nproperty float v_y\n", "1 2 3"), (Names{"v_x", "w", "v_y"}));
  EXPECT_EQ(names("property float v\nproperty float v_x\nproperty float v_y\n", "1 2 3"), (Names{"v", "v_x", "v_y"}));
  EXPECT_EQ(names("property float _x\nproperty float _y\n", "1 2"), (Names{"_x", "_y"})) << "without a name";
}

TEST(PlyColumns, ColumnsOfOneNameAreTheFirst) {
  const Mesh mesh = readVertex("property float a\nproperty uchar a\nproperty float b\n", "1 2 3");
  EXPECT_EQ(mesh.properties, (std::vector<VertexProperty>{{"a", 1, Buffer<float>{1}}, {"b", 1, Buffer<float>{3}}}));
}

TEST(PlyColumns, PlyWithPropertiesByteForByte) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.properties = {{"confidence", 1, Buffer<float>{0.5F, 1}},
                     {"rank", 1, Buffer<std::uint8_t>{1, 255}},
                     {"t", 2, Buffer<std::int8_t>{-1, 2, 3, -128}},
                     {"d", 1, Buffer<double>{-2.2250738585072014e-308, 0.1}}};
  const std::string properties =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty float confidence\n"
      "property uchar rank\nproperty char t_x\nproperty char t_y\nproperty double d\n"
      "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
  writeMesh(mesh, folder / "text.ply", {.ascii = true});
  EXPECT_EQ(contentsOf(folder / "text.ply"), "ply\nformat ascii 1.0\ncomment pdc\n" + properties +
                                                 "0 0 0 0.5 1 -1 2 -2.2250738585072014e-308\n1 0 0 1 255 3 -128 0.1\n");
  writeMesh(mesh, folder / "binary.ply");
  std::string expected = "ply\nformat binary_little_endian 1.0\ncomment pdc\n" + properties;
  const auto append = [&](const auto&... values) {
    (expected.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
  };
  append(Vec3f{0, 0, 0}, 0.5F, std::uint8_t{1}, std::int8_t{-1}, std::int8_t{2}, -2.2250738585072014e-308);
  append(Vec3f{1, 0, 0}, 1.0F, std::uint8_t{255}, std::int8_t{3}, std::int8_t{-128}, 0.1);
  EXPECT_EQ(contentsOf(folder / "binary.ply"), expected);
}

template <typename Number>
VertexProperty randomProperty(const std::string& name, int components, std::size_t vertices) {
  std::mt19937 random(54321);
  Buffer<Number> values(vertices * static_cast<std::size_t>(components));
  for (Number& value : values) {
    if constexpr (std::is_integral_v<Number>) {
      value = static_cast<Number>(random());
    } else {
      value =
          static_cast<Number>(std::ldexp(static_cast<double>(random()) / 3, static_cast<int>(random() % 200) - 130));
    }
  }
  return {name, components, std::move(values)};
}

TEST(PlyColumns, PropertiesOfVerticesComeBack) {
  const TemporaryFolder folder;
  constexpr std::size_t kVertices = 70000;  // Several chunks of the writer.
  Mesh mesh;
  mesh.positions.assign(kVertices, Vec3f{1, 2, 3});
  mesh.normals.assign(kVertices, Vec3f{0, 0, 1});
  mesh.properties = {
      randomProperty<std::int8_t>("a", 4, kVertices),      randomProperty<std::uint8_t>("b", 1, kVertices),
      randomProperty<std::int16_t>("c", 3, kVertices),     randomProperty<std::uint16_t>("d", 2, kVertices),
      randomProperty<std::int32_t>("e", 1, kVertices),     randomProperty<std::uint32_t>("f", 4, kVertices),
      randomProperty<float>("g:\xC3\xA4/1", 3, kVertices), randomProperty<double>("h", 1, kVertices)};
  for (const bool ascii : {false, true}) {
    const auto path = folder / (ascii ? "text.ply" : "binary.ply");
    writeMesh(mesh, path, {.ascii = ascii});
    const Mesh read = readMesh(path);
    EXPECT_EQ(read.positions, mesh.positions);
    EXPECT_EQ(read.normals, mesh.normals);
    EXPECT_TRUE(read.properties == mesh.properties);
  }
}

TEST(PlyColumns, NamesThatAPlyFileCannotHoldAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](std::vector<VertexProperty> properties) {
    Mesh mesh;
    mesh.properties = std::move(properties);
    EXPECT_THROW(writeMesh(mesh, folder / "a.ply"), std::invalid_argument) << mesh.properties.back().name;
    EXPECT_NO_THROW(writeMesh(mesh, folder / "a.obj")) << "which leaves properties out";
  };
  for (const char* name : {"two words", "a\nend_header", "x", "nz"}) refused({{name, 1, Buffer<float>{}}});
  refused({{"v_y", 1, Buffer<float>{}}, {"v", 2, Buffer<float>{}}});
  EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace pdc
