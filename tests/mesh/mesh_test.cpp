#include "pdc/mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pdc {
namespace {

Mesh meshWithProperties() {
  Mesh mesh;
  mesh.positions.resize(2);
  mesh.properties.push_back({"rank", 1, Buffer<std::uint8_t>{1, 3}});
  mesh.properties.push_back({"flow", 3, Buffer<float>{1, 2, 3, 4, 5, 6}});
  return mesh;
}

TEST(Mesh, FindsPropertiesByName) {
  const Mesh mesh = meshWithProperties();
  ASSERT_NE(mesh.property("flow"), nullptr);
  EXPECT_EQ(mesh.property("flow")->components, 3);
  EXPECT_EQ(mesh.property("fl"), nullptr);
}

TEST(Mesh, ValuesAreThoseOfTheNameAndTheType) {
  const Mesh mesh = meshWithProperties();
  const auto rank = mesh.values<std::uint8_t>("rank");
  EXPECT_TRUE(std::ranges::equal(rank, Buffer<std::uint8_t>{1, 3}));
  EXPECT_TRUE(std::ranges::equal(mesh.values<float>("flow"), Buffer<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(mesh.values<float>("rank").empty());
  EXPECT_TRUE(mesh.values<float>("none").empty());
}

TEST(VertexProperty, TypesHaveNames) {
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::int8_t>{}}), "int8");
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::uint8_t>{}}), "uint8");
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::int16_t>{}}), "int16");
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::uint16_t>{}}), "uint16");
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::int32_t>{}}), "int32");
  EXPECT_STREQ(typeName({"a", 1, Buffer<std::uint32_t>{}}), "uint32");
  EXPECT_STREQ(typeName({"a", 1, Buffer<float>{}}), "float");
  EXPECT_STREQ(typeName({"a", 1, Buffer<double>{}}), "double");
}

}  // namespace
}  // namespace pdc
