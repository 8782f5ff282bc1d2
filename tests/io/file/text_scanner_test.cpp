#include "io/file/text_scanner.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "io/file/line_ends.h"

namespace pdc::detail {
namespace {

TEST(TextScanner, GoesThroughWordsWithoutCommentsAndBlankLines) {
  TextScanner scanner("\n  # comment\n a\tb \r\nc# d\n");
  ASSERT_TRUE(scanner.nextLine());
  EXPECT_EQ(scanner.lineNumber(), 3u);
  EXPECT_EQ(scanner.wholeLine(), " a\tb");
  EXPECT_EQ(scanner.word(), "a");
  EXPECT_EQ(scanner.restOfLine(), "b");
  EXPECT_EQ(scanner.word(), "b");
  EXPECT_EQ(scanner.word(), "");
  ASSERT_TRUE(scanner.nextLine());
  EXPECT_EQ(scanner.word(), "c");
  EXPECT_FALSE(scanner.nextLine());
}

TEST(TextScanner, LinesContinueOnRequest) {
  for (const bool continued : {true, false}) {
    TextScanner scanner("a \\\n  b\\  \nc # d \\\ne\n", '#', continued);
    ASSERT_TRUE(scanner.nextLine());
    EXPECT_EQ(scanner.word(), "a");
    EXPECT_EQ(scanner.word(), continued ? "b" : "\\");
    EXPECT_EQ(scanner.word(), continued ? "c" : "");
    EXPECT_EQ(scanner.lineNumber(), continued ? 3u : 1u);
    ASSERT_TRUE(scanner.nextLine());
    EXPECT_EQ(scanner.word(), continued ? "e" : "b\\");
  }
}

TEST(TextScanner, NumbersThatAreNoneAreNotTaken) {
  TextScanner scanner("+1 -2.5 3x 4,5");
  ASSERT_TRUE(scanner.nextLine());
  EXPECT_EQ(scanner.number<int>(), 1);
  EXPECT_EQ(scanner.number<int>(), std::nullopt);
  EXPECT_EQ(scanner.number<double>(), -2.5);
  EXPECT_EQ(scanner.number<double>(), std::nullopt);
  EXPECT_EQ(scanner.word(), "3x");
  EXPECT_EQ(scanner.number<double>(), std::nullopt);
}

TEST(TextScanner, CoordinatesAreNarrowedOnce) {
  // Halfway between 1 and the next float, and a little above or below, which double precision does not tell apart.
  const std::string halfway = "1.000000059604644775390625", above = "1.00000005960464477540",
                    below = "1.00000005960464477538";
  const float next = std::nextafter(1.0f, 2.0f);
  const std::string line = halfway + " " + above + " " + below;
  TextScanner scanner(line);
  ASSERT_TRUE(scanner.nextLine());
  const auto p = scanner.point();
  ASSERT_TRUE(p.has_value());
  EXPECT_EQ(static_cast<float>(p->x), 1.0f);
  EXPECT_EQ(static_cast<float>(p->y), next);
  EXPECT_EQ(static_cast<float>(p->z), 1.0f);
  EXPECT_EQ(static_cast<float>(*TextScanner::parseCoordinate(above)), next);
}

TEST(LineEnds, LoneReturnsBecomeNewlines) {
  std::string text = "a\rb\r\nc\n\r\rd\r";
  endLinesWithNewlines(text);
  EXPECT_EQ(text, "a\nb\r\nc\n\n\nd\n");
  EXPECT_TRUE(beginsWithLoneReturn("a\rb\n"));
  EXPECT_FALSE(beginsWithLoneReturn("a\r\nb\r"));
  EXPECT_FALSE(beginsWithLoneReturn("a"));
}

}  // namespace
}  // namespace pdc::detail
