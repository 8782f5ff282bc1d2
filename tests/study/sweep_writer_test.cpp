#include "pdc/study/sweep_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"
#include "study/page_text.h"

namespace pdc {
namespace {

Sweep twoSteps() {
  Sweep sweep{.parameter = SweepParameter::kSigmaNormal};
  SweepStep first{.value = 0.1, .voxelSize = 0.5, .seconds = 0.25, .vertices = 12, .faces = 10};
  first.vertexRms = 0.0625;
  first.vertexMax = 0.5;
  first.contour.clamped = 1;
  first.contour.shortened = 2;
  first.contour.drawnIn = 4;
  first.eulerNumber = -6;
  SweepStep second{.value = std::numeric_limits<double>::infinity(), .voxelSize = 0.5};
  sweep.steps = {first, second};
  sweep.recommended = 0;
  sweep.reason = "It is <best> & \"least\".";
  return sweep;
}

SweepDescription description() {
  Image picture{2, 1, {{1, 2, 3}, {4, 5, 6}}};
  return {.title = "a <b>", .command = "pdc sweep 'x & y'", .pictures = {picture, picture}};
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

TEST(SweepWriter, CsvHasAColumnPerFigure) {
  std::istringstream csv(sweepCsv(twoSteps()));
  std::string names, first, second, none;
  std::getline(csv, names);
  std::getline(csv, first);
  std::getline(csv, second);
  EXPECT_FALSE(std::getline(csv, none));
  const auto keys = cells(names), a = cells(first), b = cells(second);
  ASSERT_EQ(keys.size(), a.size());
  ASSERT_EQ(keys.size(), b.size());
  const auto at = [&](const std::vector<std::string>& row, const std::string& key) {
    return row[static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin())];
  };
  EXPECT_EQ(at(a, "sigma_n"), "0.1");
  EXPECT_EQ(at(a, "vertex_rms"), "0.0625");
  EXPECT_EQ(at(a, "crease_rms"), "");
  EXPECT_EQ(at(a, "moved"), "7");
  EXPECT_EQ(at(a, "euler_number"), "-6");
  EXPECT_EQ(at(b, "sigma_n"), "inf");
  EXPECT_EQ(at(b, "vertex_rms"), "");
}

TEST(SweepWriter, JsonSaysTheSame) {
  const std::string json = sweepJson(twoSteps(), description());
  for (const char* part : {"\"parameter\": \"sigma_n\"", "\"recommended\": 0.1",
                           R"("reason": "It is <best> & \"least\".")", "{\"sigma_n\": \"inf\", ",
                           "\"vertex_rms\": 0.0625", "\"crease_rms\": null", "\"command\": \"pdc sweep 'x & y'\""})
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
}

TEST(SweepWriter, PageStandsAlone) {
  const std::string page = sweepPage(twoSteps(), description());
  EXPECT_NE(page.find("<title>a &#60;b&#62;</title>"), std::string::npos);
  EXPECT_NE(page.find("pdc sweep &#39;x &#38; y&#39;"), std::string::npos);
  // A picture per step, all of it inside, nothing from elsewhere.
  std::size_t pictures = 0;
  for (std::size_t at = page.find("src=\""); at != std::string::npos; at = page.find("src=\"", at + 1)) {
    EXPECT_EQ(page.compare(at + 5, 22, "data:image/png;base64,"), 0);
    ++pictures;
  }
  EXPECT_EQ(pictures, 2u);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  // Nothing is known of creases, so there is no curve of them.
  EXPECT_EQ(page.find("true crease to mesh, RMS, voxels</span>"), std::string::npos);
}

TEST(SweepWriter, WritesThreeFilesIntoAFolderItMakes) {
  const TemporaryFolder folder;
  makeSweepFolder(folder / "new");
  writeSweep(twoSteps(), description(), folder / "new");
  EXPECT_EQ(contentsOf(folder / "new/sweep.csv"), sweepCsv(twoSteps()));
  EXPECT_EQ(contentsOf(folder / "new/sweep.json"), sweepJson(twoSteps(), description()));
  EXPECT_EQ(contentsOf(folder / "new/index.html"), sweepPage(twoSteps(), description()));
  makeSweepFolder(folder / "new");
}

TEST(SweepWriter, Refusals) {
  const TemporaryFolder folder;
  EXPECT_THROW(makeSweepFolder(folder / "none/new"), Error);
  writeContents(folder / "file", "x");
  EXPECT_THROW(makeSweepFolder(folder / "file"), Error);
  SweepDescription onePicture = description();
  onePicture.pictures.pop_back();
  EXPECT_THROW(writeSweep(twoSteps(), onePicture, folder.path()), std::invalid_argument);
}

TEST(PageText, Base64IsThatOfTheStandard) {
  const auto of = [](std::string_view text) {
    return detail::base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe"), "//4=");
}

TEST(PageText, JsonEscapes) { EXPECT_EQ(detail::jsonText("a\"b\\c\n\x01"), R"("a\"b\\c\u000a\u0001")"); }

}  // namespace
}  // namespace pdc
