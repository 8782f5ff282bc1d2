#include "pdc/io/scene/scene_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "folders.h"
#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = test::sourceFolder() / "scenes";

/// A scene of which only the shape matters; it stands on line 3, indented by two.
std::string withShape(std::string shape) {
  for (std::size_t at = 0; (at = shape.find('\n', at)) != std::string::npos; ++at) shape.insert(at + 1, "  ");
  return "box: [[-1, -1, -1], [1, 1, 1]]\nresolution: 8\nshape:\n  " + shape + "\n";
}

Scene readText(const std::string& text) {
  const TemporaryFolder folder;
  writeContents(folder / "scene.yaml", text);
  return readScene(folder / "scene.yaml");
}

double valueOf(const std::string& shape, const Vec3d& p) { return readText(withShape(shape)).field->valueAt(p); }

/// The message without the folder's name.
std::string errorOf(const fs::path& file) {
  try {
    (void)readScene(file);
  } catch (const Error& error) {
    const std::string message = error.what(), folder = file.parent_path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }
  return "no error";
}

std::string errorOfText(const std::string& text) {
  const TemporaryFolder folder;
  writeContents(folder / "s.yaml", text);
  return errorOf(folder / "s.yaml");
}

std::string errorOfShape(const std::string& shape) { return errorOfText(withShape(shape)); }

std::string nested(int depth) {
  std::string shape = "{sphere: {radius: 0.5}}";
  for (int i = 0; i < depth; ++i) shape = "{complement: {of: " + shape + "}}";
  return "box: [[-1, -1, -1], [1, 1, 1]]\nresolution: 8\nshape: " + shape + "\n";
}

TEST(SceneReader, ReadsAllKeys) {
  const Scene scene = readText(
      "name: a title\nbox: [[-1, -2, -3], [1, 2, 5]]\nresolution: 32\nsigma_n: 0.25\niso: -0.5\n"
      "expect: {euler: -4, area: 2.5, volume: 1e-3, tolerance: 0.125}\nshape: {sphere: {radius: 0.75}}\n");
  EXPECT_EQ(scene.name, "a title");
  EXPECT_EQ(scene.box.lo, (Vec3d{-1, -2, -3}));
  EXPECT_EQ(scene.box.hi, (Vec3d{1, 2, 5}));
  EXPECT_EQ(scene.voxelSize, 0.25);
  EXPECT_EQ(scene.sigmaNormal, 0.25);
  EXPECT_EQ(scene.iso, -0.5);
  EXPECT_EQ(scene.expect.eulerNumber, -4);
  EXPECT_EQ(scene.expect.area, 2.5);
  EXPECT_EQ(scene.expect.volume, 1e-3);
  EXPECT_EQ(scene.expect.relativeTolerance, 0.125);
  EXPECT_EQ(scene.field->valueAt({0, 0, 2}), 1.25);
}

TEST(SceneReader, OptionalKeysHaveTheirDefaults) {
  const Scene scene = readText("box: [[0, 0, 0], [1, 1, 1]]\nvoxel_size: 0.03\nshape: {sphere: {radius: +.5}}\n");
  EXPECT_EQ(scene.name, "");
  EXPECT_EQ(scene.voxelSize, 0.03);
  EXPECT_EQ(scene.sigmaNormal, std::nullopt);
  EXPECT_EQ(scene.iso, 0);
  EXPECT_EQ(scene.expect.eulerNumber, std::nullopt);
  EXPECT_EQ(scene.expect.area, std::nullopt);
  EXPECT_EQ(scene.expect.volume, std::nullopt);
  EXPECT_EQ(scene.expect.relativeTolerance, 0.01);
}

TEST(SceneReader, SigmaMayBeInfinite) {
  for (const char* infinity : {"inf", ".inf"}) {
    const Scene scene = readText(std::string("sigma_n: ") + infinity + "\n" + withShape("sphere: {radius: 1}"));
    EXPECT_EQ(scene.sigmaNormal, std::numeric_limits<double>::infinity());
  }
}

TEST(SceneReader, PrimitivesHaveTheirValues) {
  EXPECT_NEAR(valueOf("sphere: {center: [1, 0, 0], radius: 0.5}", {1, 2, 0}), 1.5, 1e-12);
  EXPECT_NEAR(valueOf("box: {size: [1, 2, 4]}", {0, 1.5, 0}), 0.5, 1e-12);
  EXPECT_NEAR(valueOf("rounded_box: {center: [0, 1, 0], size: [2, 2, 2], radius: 0.5}", {2, 1, 0}), 1, 1e-12);
  EXPECT_NEAR(valueOf("plane: {point: [0, 0, 1], normal: [0, 0, 5]}", {3, 3, 4}), 3, 1e-12);
  EXPECT_NEAR(valueOf("cylinder: {from: [0, 0, 0], to: [0, 0, 2], radius: 0.5}", {0, 2, 1}), 1.5, 1e-12);
  EXPECT_NEAR(valueOf("capped_cone: {from: [0, 0, 0], to: [0, 0, 2], radius_from: 1, radius_to: 0}", {0, 0, -1}), 1,
              1e-12);
  EXPECT_NEAR(valueOf("torus: {axis: [1, 0, 0], radius: 1, tube: 0.25}", {0, 0, 1.5}), 0.25, 1e-12);
  EXPECT_NEAR(valueOf("torus: {radius: 1, tube: 0.25}", {0, 1.5, 0}), 0.25, 1e-12);
  EXPECT_NEAR(valueOf("capsule: {from: [0, 0, 0], to: [0, 0, 2], radius: 0.5}", {0, 0, 3}), 0.5, 1e-12);
  EXPECT_NEAR(valueOf("ellipsoid: {semi_axes: [1, 2, 3]}", {0, 2, 0}), 0, 1e-12);
  EXPECT_NEAR(valueOf("gyroid: {period: 2}", {0.5, 0, 0}), 1 / (std::sqrt(3) * 3.14159265358979), 1e-12);
  EXPECT_LT(valueOf("gyroid: {period: 2, thickness: 0.1}", {0, 0, 0}), 0);
  EXPECT_NEAR(valueOf("formula: {expression: x*y - z}", {2, 3, 1}), 5, 1e-12);
}

TEST(SceneReader, NoiseTakesItsParameters) {
  const Vec3d p{0.3, 0.2, 0.1};
  const double plain = valueOf("simplex_noise: {}", p);
  EXPECT_NE(plain, 0);
  EXPECT_EQ(valueOf("simplex_noise: {seed: 0, octaves: 4, frequency: 1, gain: 0.5, lacunarity: 2, amplitude: 1}", p),
            plain);
  EXPECT_NEAR(valueOf("simplex_noise: {amplitude: 3}", p), 3 * plain, 1e-12);
  for (const char* change : {"seed: 4294967295", "octaves: 3", "frequency: 1.5", "gain: 0.6", "lacunarity: 1.9"})
    EXPECT_NE(valueOf(std::string("simplex_noise: {") + change + "}", p), plain) << change;
}

TEST(SceneReader, OperatorsHaveTheirValues) {
  const std::string a = "{sphere: {center: [-1, 0, 0], radius: 0.5}}", b = "{sphere: {center: [1, 0, 0], radius: 0.5}}";
  const Vec3d p{1, 0, 0};
  EXPECT_NEAR(valueOf("union: [" + a + ", " + b + "]", p), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("union: {of: [" + a + ", " + b + "]}", p), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("intersection: [" + a + ", " + b + "]", p), 1.5, 1e-12);
  EXPECT_NEAR(valueOf("difference: [" + b + ", " + a + "]", p), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("difference: [" + a + ", " + b + "]", p), 1.5, 1e-12);
  for (const char* name : {"union", "intersection", "difference"}) {
    const std::string operands = "of: [" + a + ", " + b + "]}";
    EXPECT_NE(valueOf(std::string(name) + ": {smooth: 2, " + operands, {0, 0.1, 0}),
              valueOf(std::string(name) + ": {" + operands, {0, 0.1, 0}))
        << name;
  }
  EXPECT_NEAR(valueOf("complement: {of: " + b + "}", p), 0.5, 1e-12);
  EXPECT_NEAR(valueOf("offset: {distance: 0.25, of: " + b + "}", p), -0.75, 1e-12);
  EXPECT_NEAR(valueOf("shell: {thickness: 0.25, of: " + b + "}", {1.5, 0, 0}), -0.125, 1e-12);
  EXPECT_NEAR(valueOf("translate: {by: [0, 0, 2], of: " + b + "}", {1, 0, 2}), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("rotate: {degrees: 90, of: " + b + "}", {0, 1, 0}), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("rotate: {axis: [0, 1, 0], degrees: 90, of: " + b + "}", {0, 0, -1}), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("scale: {factor: 2, of: " + b + "}", {2, 0, 0}), -1, 1e-12);
  EXPECT_NEAR(valueOf("scale: {factor: [1, 3, 2], of: " + b + "}", {1, 1.5, 0}), 0, 1e-12);
  EXPECT_NEAR(valueOf("mirror: {axis: x, of: " + b + "}", {-1, 0, 0}), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("repeat: {period: [4, 0, 0], of: " + b + "}", {13, 0, 0}), -0.5, 1e-12);
  EXPECT_NEAR(valueOf("repeat: {period: [4, 0, 0], count: [1, 0, 0], of: " + b + "}", {13, 0, 0}), 7.5, 1e-12);
}

TEST(SceneReader, AliasesStandForTheirShapes) {
  const std::string text = "union:\n- &ball {sphere: {radius: 0.5}}\n- translate: {by: [3, 0, 0], of: *ball}";
  EXPECT_NEAR(valueOf(text, {3, 0, 0}), -0.5, 1e-12);
}

TEST(SceneReader, SceneErrorsSayWhere) {
  const std::string shape = "shape: {sphere: {radius: 1}}\n", box = "box: [[0, 0, 0], [1, 1, 1]]\n";
  EXPECT_EQ(errorOfText(box + "resolution: 8\nsize: 3\n" + shape),
            "s.yaml:3:1: unknown key 'size'; scene takes definitions, name, box, resolution, voxel_size, sigma_n, iso, "
            "nan, expect, shape");
  EXPECT_EQ(errorOfText(box + "resolution: 8\n" + box + shape), "s.yaml:3:1: key 'box' is repeated");
  EXPECT_EQ(errorOfText("resolution: 8\n" + shape), "s.yaml:1:1: box is missing in scene");
  EXPECT_EQ(errorOfText(box + "resolution: 8\n"), "s.yaml:1:1: shape is missing in scene");
  EXPECT_EQ(errorOfText(box + shape), "s.yaml:1:1: scene needs either resolution or voxel_size, not both or none");
  EXPECT_EQ(errorOfText(box + "resolution: 8\nvoxel_size: 1\n" + shape),
            "s.yaml:1:1: scene needs either resolution or voxel_size, not both or none");
  EXPECT_EQ(errorOfText(box + "resolution: 8.5\n" + shape),
            "s.yaml:2:13: resolution must be a whole number from 1 to 1048576, not '8.5'");
  EXPECT_EQ(errorOfText(box + "resolution: 0\n" + shape),
            "s.yaml:2:13: resolution must be a whole number from 1 to 1048576, not '0'");
  EXPECT_EQ(errorOfText(box + "voxel_size: -0.5\n" + shape), "s.yaml:2:13: voxel_size must be positive, not '-0.5'");
  EXPECT_EQ(errorOfText(box + "voxel_size: .inf\n" + shape),
            "s.yaml:2:13: voxel_size must be a finite number, not '.inf'");
  EXPECT_EQ(errorOfText("box: [[0, 0, 0], [1, 0, 1]]\nresolution: 8\n" + shape),
            "s.yaml:1:6: box must grow from its first to its second corner, not go from 0 to 0 along y");
  EXPECT_EQ(errorOfText("box: [1, 1, 1]\nresolution: 8\n" + shape),
            "s.yaml:1:6: box must be a list of 2, not a list of 3");
  EXPECT_EQ(errorOfText("sigma_n: -1\n" + box + "resolution: 8\n" + shape),
            "s.yaml:1:10: sigma_n must be 0 or more, or inf, not '-1'");
  EXPECT_EQ(errorOfText("sigma_n: .nan\n" + box + "resolution: 8\n" + shape),
            "s.yaml:1:10: sigma_n must be a number, not '.nan'");
  EXPECT_EQ(errorOfText("iso: .inf\n" + box + "resolution: 8\n" + shape),
            "s.yaml:1:6: iso must be a finite number, not '.inf'");
  EXPECT_EQ(errorOfText("expect: {genus: 0}\n" + box + "resolution: 8\n" + shape),
            "s.yaml:1:10: unknown key 'genus'; expect takes euler, area, volume, tolerance");
  EXPECT_EQ(errorOfText("name: [a]\n" + box + "resolution: 8\n" + shape),
            "s.yaml:1:7: name must be text, not a list of 1");
}

TEST(SceneReader, ShapeErrorsSayWhere) {
  EXPECT_EQ(errorOfShape("ball: {radius: 1}").substr(0, 52), "s.yaml:4:3: unknown shape 'ball'; known are sphere, ");
  EXPECT_EQ(errorOfShape("{}"), "s.yaml:4:3: a shape is a map with one key, its name; this one has 0");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1}\nbox: {size: [1, 1, 1]}"),
            "s.yaml:4:3: a shape is a map with one key, its name; this one has 2");
  EXPECT_EQ(errorOfShape("sphere"), "s.yaml:4:3: shape must be a map, not 'sphere'");
  EXPECT_EQ(errorOfShape("sphere:"), "s.yaml:4:3: sphere must be a map, not nothing");
  EXPECT_EQ(errorOfShape("sphere: {}"), "s.yaml:4:11: radius is missing in sphere");
  EXPECT_EQ(errorOfShape("sphere: {radus: 1}"),
            "s.yaml:4:12: unknown key 'radus' (did you mean 'radius'?); sphere takes center, radius");
  EXPECT_EQ(errorOfShape("sphere: {size: 1}"), "s.yaml:4:12: unknown key 'size'; sphere takes center, radius");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1, radius: 2}"), "s.yaml:4:23: key 'radius' is repeated");
  EXPECT_EQ(errorOfShape("sphere: {radius: -1}"), "s.yaml:4:20: radius must be positive, not '-1'");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1m}"), "s.yaml:4:20: radius must be a number, not '1m'");
  EXPECT_EQ(errorOfShape("sphere: {radius: '1'}"), "s.yaml:4:20: radius must be a number, not '1'");
  EXPECT_EQ(errorOfShape("sphere: {radius: 0x10}"), "s.yaml:4:20: radius must be a number, not '0x10'");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1e999}"), "s.yaml:4:20: radius must be a number, not '1e999'");
  EXPECT_EQ(errorOfShape("sphere: {radius: nan}"), "s.yaml:4:20: radius must be a number, not 'nan'");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1, center: [0, 0]}"),
            "s.yaml:4:31: center must be a list of 3 numbers, not a list of 2");
  EXPECT_EQ(errorOfShape("sphere: {radius: 1, center: [0, .inf, 0]}"),
            "s.yaml:4:35: center must be a finite number, not '.inf'");
  EXPECT_EQ(errorOfShape("box: {size: [1, 0, 1]}"), "s.yaml:4:19: size must be positive, not '0'");
  EXPECT_EQ(errorOfShape("simplex_noise: {octaves: 17}"),
            "s.yaml:4:28: octaves must be a whole number from 1 to 16, not '17'");
  EXPECT_EQ(errorOfShape("mirror: {axis: w, of: {sphere: {radius: 1}}}"),
            "s.yaml:4:18: axis must be x, y or z, not 'w'");
  EXPECT_EQ(errorOfShape("repeat: {period: [1, 1, 1], count: [1, -1, 1], of: {sphere: {radius: 1}}}"),
            "s.yaml:4:42: count must be a whole number from 0 to 2147483647, not '-1'");
  EXPECT_EQ(errorOfShape("union:\n- sphere: {radius: 1}\n- sphere: {radius: 0}"),
            "s.yaml:6:22: radius must be positive, not '0'");
}

TEST(SceneReader, WhatFactoriesRefuseIsReportedAtTheShape) {
  EXPECT_EQ(errorOfShape("rotate: {axis: [0, 0, 0], degrees: 1, of: {sphere: {radius: 1}}}").substr(0, 12),
            "s.yaml:4:3: ");
  EXPECT_EQ(errorOfShape("complement:\n  of:\n    plane: {normal: [0, 0, 0]}").substr(0, 12), "s.yaml:6:7: ");
  EXPECT_EQ(errorOfShape("union: []").substr(0, 12), "s.yaml:4:3: ");
  EXPECT_EQ(errorOfShape("rounded_box: {size: [1, 1, 1], radius: 0.6}").substr(0, 12), "s.yaml:4:3: ");
  EXPECT_EQ(errorOfShape("formula: {expression: x +}").substr(0, 12), "s.yaml:4:3: ");
  EXPECT_EQ(errorOfShape("grid: {file: nowhere.vdb}").substr(0, 12), "s.yaml:4:3: ");
}

TEST(SceneReader, LimitsHold) {
  EXPECT_EQ(errorOfText(nested(99)), "no error");
  EXPECT_EQ(errorOfText(nested(100)).substr(0, 9), "s.yaml:3:");
  EXPECT_NE(errorOfText(nested(100)).find("nested deeper than 100"), std::string::npos);
  EXPECT_NE(errorOfText(nested(5000)).find("nested deeper than"), std::string::npos);
  EXPECT_NE(errorOfText("box: [[0, 0, 0], [1, 1, 1]]\nresolution: 8\nshape: &a {complement: {of: *a}}\n")
                .find("nested deeper than 100"),
            std::string::npos);
  std::string bomb = "union:\n- &a0 {sphere: {radius: 1}}";
  for (int i = 1; i < 10; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    bomb += "\n- &a" + std::to_string(i) + " {union: [" + alias;
    for (int j = 1; j < 10; ++j) bomb += ", " + alias;
    bomb += "]}";
  }
  EXPECT_NE(errorOfShape(bomb).find("more than 100000 shapes"), std::string::npos);
}

TEST(SceneReader, FilesThatAreNoScenes) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf(folder / "none.yaml"), "none.yaml:1:1: cannot be opened: No such file or directory");
  fs::create_directory(folder / "folder.yaml");
  EXPECT_EQ(errorOf(folder / "folder.yaml"), "folder.yaml:1:1: a folder, not a file");
  EXPECT_EQ(errorOfText(""), "s.yaml:1:1: the file is empty");
  EXPECT_EQ(errorOfText("# nothing\n"), "s.yaml:1:1: the file is empty");
  EXPECT_EQ(errorOfText("- a\n- b\n"), "s.yaml:1:1: scene must be a map, not a list of 2");
  EXPECT_EQ(errorOfText("name: a\n---\nname: b\n"), "s.yaml:2:1: more than one document in the file");
  EXPECT_EQ(errorOfText("box: [1, 2\nname: }\n").substr(0, 9), "s.yaml:2:");
  EXPECT_EQ(errorOfText("name: *unknown\n").substr(0, 9), "s.yaml:1:");
  EXPECT_EQ(errorOfText(std::string("name: a\nno: \0\n", 14)), "s.yaml:2:5: byte 0x00 is not text in UTF-8");
  EXPECT_EQ(errorOfText("name: a\xC3\xA9\xFF\n"), "s.yaml:1:9: byte 0xff is not text in UTF-8");
  EXPECT_EQ(errorOfText("name: \xC0\x80\n"), "s.yaml:1:7: byte 0xc0 is not text in UTF-8");
  EXPECT_EQ(errorOfText("name: \xED\xA0\x80\n"), "s.yaml:1:7: byte 0xed is not text in UTF-8");
  EXPECT_EQ(errorOfText("#" + std::string(16 << 20, ' ')), "s.yaml:1:1: larger than 16777216 bytes");
}

TEST(SceneReader, MergesMaps) {
  const std::string two = "union:\n- sphere: &a {center: [0.5, 0, 0], radius: 0.25}\n- sphere: ";
  EXPECT_NEAR(valueOf(two + "{<<: *a, center: [-0.5, 0, 0]}", {-0.5, 0, 0}), -0.25, 1e-12);
  EXPECT_NEAR(valueOf(two + "{center: [-0.5, 0, 0], <<: *a}", {-0.5, 0, 0}), -0.25, 1e-12) << "later merges too";
  EXPECT_NEAR(valueOf(two + "{<<: [{radius: 0.125}, *a], center: [-0.5, 0, 0]}", {-0.5, 0, 0}), -0.125, 1e-12)
      << "the first of a list counts";
  EXPECT_NEAR(valueOf(two + "{<<: {<<: *a, radius: 0.125}, center: [-0.5, 0, 0]}", {-0.5, 0, 0}), -0.125, 1e-12);
  EXPECT_NEAR(valueOf(two + "{<<: *a}", {0.5, 0, 0}), -0.25, 1e-12);
}

TEST(SceneReader, RefusesBadMerges) {
  EXPECT_EQ(errorOfShape("sphere: {<<: 3}"), "s.yaml:4:16: << must be a map or a list of maps, not '3'");
  EXPECT_EQ(errorOfShape("sphere: {<<: [{radius: 1}, x]}"), "s.yaml:4:30: << must be a map or a list of maps, not 'x'");
  EXPECT_EQ(errorOfShape("sphere: {<<: {radius: 1}, <<: {}}"), "s.yaml:4:29: key '<<' is repeated");
  EXPECT_EQ(errorOfShape("sphere: {<<: {colour: 1}, radius: 1}"),
            "s.yaml:4:17: unknown key 'colour'; sphere takes center, radius");
  EXPECT_EQ(errorOfShape("sphere: {\"<<\": {radius: 1}}"),
            "s.yaml:4:12: unknown key '<<'; sphere takes center, radius");
}

TEST(SceneReader, AMapMayBeMergedIntoItself) {
  EXPECT_NEAR(valueOf("sphere: &a {<<: *a, radius: 0.5}", {0, 0, 0}), -0.5, 1e-12);
  EXPECT_EQ(errorOfShape("sphere: &a {<<: [*a, {<<: [*a, *a]}, *a]}"), "s.yaml:4:11: radius is missing in sphere");
}

TEST(SceneReader, DefinitionsHoldAnchors) {
  const std::string text =
      "definitions:\n  sizes: [&small 0.25]\n  ball: &ball {radius: *small}\n"
      "box: [[-1, -1, -1], [1, 1, 1]]\nresolution: 8\nshape: {sphere: *ball}\n";
  EXPECT_NEAR(readText(text).field->valueAt({0, 0, 0}), -0.25, 1e-12);
}

TEST(SceneReader, SaysWhatIsWrongWithALongFormula) {
  std::string terms = "x";
  while (terms.size() < 15'000) terms += " + 0.001*sin(x)";
  EXPECT_EQ(errorOfShape("formula: {expression: \"" + terms + "\"}"), "no error");
  const std::string wrong = errorOfShape("formula: {expression: \"" + terms + " + foo(x)\"}");
  EXPECT_EQ(wrong.substr(0, 21), "s.yaml:4:3: formula \"");
  EXPECT_NE(wrong.find(" + foo(x)\", position "), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("Unexpected token \"foo\""), std::string::npos) << wrong;
  EXPECT_LT(wrong.size(), 250u);
  const std::string tooLong = errorOfShape("formula: {expression: \"" + terms + " + " + terms + "\"}");
  EXPECT_NE(
      tooLong.find("The formula has " + std::to_string(2 * terms.size() + 3) + " characters, must have at most 19999"),
      std::string::npos)
      << tooLong;
}

/// The ```yaml blocks of a Markdown file.
std::vector<std::string> yamlBlocks(const fs::path& file) {
  std::vector<std::string> blocks;
  std::istringstream lines(contentsOf(file));
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```yaml") blocks.emplace_back();
    if (inside && line != "```") blocks.back() += line + "\n";
    inside = line == "```yaml" || (inside && line != "```");
  }
  return blocks;
}

TEST(SceneReader, ReadsTheExamplesOfItsReadme) {
  // Beside a link to the tests' data and a mesh, as the examples' relative paths have it.
  const TemporaryFolder folder;
  fs::create_directory(folder / "scenes");
  fs::create_directory_symlink(test::sourceFolder() / "tests", folder / "tests");
  writeContents(folder / "scenes" / "part.stl",
                "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                "endloop\nendfacet\nendsolid\n");
  const fs::path file = folder.path() / "scenes" / "example.yaml";
  const std::vector<std::string> blocks = yamlBlocks(kScenes / "README.md");
  EXPECT_EQ(blocks.size(), 2u + 13 + 11);
  for (const std::string& block : blocks) {
    writeContents(file, block.find("\nshape:") != std::string::npos ? block : withShape(block));
    EXPECT_EQ(errorOf(file), "no error") << block;
  }
}

}  // namespace
}  // namespace pdc
