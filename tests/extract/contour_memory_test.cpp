#include "extract/contour_memory.h"

#include <gtest/gtest.h>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

TEST(ContourMemory, CountsAndBytesReadWell) {
  EXPECT_EQ(countText(512), "512");
  EXPECT_EQ(countText(2.5e6), "2.5 million");
  EXPECT_EQ(countText(25.7e9), "25.7 billion");
  EXPECT_EQ(bytesText(5e3), "5 kB");
  EXPECT_EQ(bytesText(120e6), "120 MB");
  EXPECT_EQ(bytesText(16e9), "16 GB");
  EXPECT_EQ(bytesText(197.6e12), "198 TB");
}

TEST(ContourMemory, EachExtraPartTakesMore) {
  const double plain = contourMemory(1000, {});
  EXPECT_GT(plain, 0);
  EXPECT_GT(contourMemory(1000, {.triangles = true}), plain);
  EXPECT_GT(contourMemory(1000, {.normals = true}), plain);
  EXPECT_GT(contourMemory(1000, {.confidence = true}), plain);
  EXPECT_DOUBLE_EQ(contourMemory(2000, {}), 2 * plain);
}

TEST(ContourMemory, WhatWillNotFitIsRefusedWithBothFigures) {
  EXPECT_NO_THROW(checkMemory(1e6, 2e4, {}));
  try {
    checkMemory(3e9, 60e6, {.maxMemory = 1'000'000'000});
    FAIL() << "nothing was thrown";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("60 million"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("1000 MB that are allowed"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pdc::detail
