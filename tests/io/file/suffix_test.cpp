#include "io/file/suffix.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

TEST(Suffix, IsInLowerCaseWithItsDot) {
  EXPECT_EQ(suffixOf("A/B.C/Part.PLY"), ".ply");
  EXPECT_EQ(suffixOf("part.tar.Gz"), ".gz");
  EXPECT_EQ(suffixOf("A.B/part"), "");
  EXPECT_EQ(suffixOf(".PLY"), "");
  EXPECT_EQ(suffixOf(""), "");
}

TEST(LowerCase, ChangesTheLettersOfAsciiOnly) {
  EXPECT_EQ(lowerCase("AZaz@[`{09"), "azaz@[`{09");
  EXPECT_EQ(lowerCase("\xC3\x84"), "\xC3\x84");
}

}  // namespace
}  // namespace pdc::detail
