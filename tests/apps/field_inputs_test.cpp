// Small inputs that failed in the field, beside the shared data, and what is right.

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

namespace fs = std::filesystem;

fs::path inputs() { return dataFolder().parent_path() / "faults"; }

/// A file, what is asked for, and what comes of it.
struct FieldInput {
  std::string name;
  Arguments options{};
  std::string refusal{};        ///< What the one line says; empty if the file is taken.
  std::string warning{};        ///< What a warning says; empty if there is none.
  std::size_t components = 1;   ///< What the mesh has.
  double area = 0, volume = 0;  ///< What the mesh has; 0 if that does not matter.
  bool clean = true;
};

void PrintTo(const FieldInput& input, std::ostream* out) { *out << input.name; }

std::string testName(const testing::TestParamInfo<FieldInput>& info) {
  std::string name = info.param.name.substr(0, info.param.name.rfind('.'));
  for (const std::string& option : info.param.options) name += "_" + option;
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; });
  return name;
}

class FieldInputs : public testing::TestWithParam<FieldInput> {
 protected:
  void SetUp() override {
    if (!fs::exists(inputs() / GetParam().name)) GTEST_SKIP() << inputs() / GetParam().name << " is not there";
  }

  static void expectMesh(const fs::path& mesh, const FieldInput& input) {
    const Outcome checked = runPdc({"check", mesh, "--json", "-"});
    EXPECT_EQ(checked.exitCode, input.clean ? 0 : 1) << checked.out << checked.err;
    const auto facts = nlohmann::json::parse(checked.out);
    EXPECT_EQ(facts["components"], input.components);
    if (input.area > 0) {
      EXPECT_NEAR(facts["area"], input.area, 1e-3 * input.area);
    }
    if (input.volume > 0) {
      EXPECT_NEAR(facts["volume"], input.volume, 3e-3 * input.volume);
    }
    EXPECT_NE(checked.err.find(input.warning), std::string::npos) << checked.err;
  }
};

using MeshInputs = FieldInputs;

TEST_P(MeshInputs, AreReadOrRefused) {
  const FieldInput& input = GetParam();
  if (input.refusal.empty()) {
    expectMesh(inputs() / input.name, input);
  } else {
    expectOneLineRefusal(runPdc({"check", inputs() / input.name}), 1, {input.refusal});
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, MeshInputs,
    testing::Values(FieldInput{"obj_is_html_page.obj", {}, "an HTML page"}, FieldInput{"obj_utf16le.obj", {}, "UTF-16"},
                    FieldInput{"obj_uppercase_keywords.obj"}, FieldInput{.name = "ply_tristrips.ply", .clean = false},
                    FieldInput{"obj_utf8_bom_silent.obj"}, FieldInput{"obj_utf8_bom.obj"},
                    FieldInput{"stl_utf8_bom.stl"}, FieldInput{"stl_leading_space.stl"},
                    FieldInput{"obj_line_continuation.obj"}, FieldInput{"obj_corner_v_vt_slash.obj"},
                    FieldInput{"obj_index_out_of_range.obj", {}, "line 9: a face names vertex 99"},
                    FieldInput{"off_modelnet_header.off"}, FieldInput{"off_without_keyword.off"},
                    FieldInput{"stl_binary_trailing_bytes.stl", {}, "", "37 bytes after"},
                    FieldInput{.name = "obj_concave_ngon_L.obj", .area = 14}),
    testName);

class VolumeInputs : public FieldInputs {};

TEST_P(VolumeInputs, AreContouredOrRefused) {
  const FieldInput& input = GetParam();
  const TemporaryFolder folder;
  Arguments arguments{"mesh", inputs() / input.name, folder / "out.ply", "--quiet"};
  arguments.insert(arguments.end(), input.options.begin(), input.options.end());
  const Outcome outcome = runPdc(arguments);
  if (!input.refusal.empty()) {
    expectOneLineRefusal(outcome, 1, {input.refusal});
    EXPECT_TRUE(folder.entries().empty());
    return;
  }
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.err.find(input.warning), std::string::npos) << outcome.err;
  if (input.warning.empty()) {
    EXPECT_EQ(outcome.err, "");
  }
  FieldInput mesh = input;
  mesh.warning.clear();
  expectMesh(folder / "out.ply", mesh);
}

// A ball of radius 10 has volume 4189.
INSTANTIATE_TEST_SUITE_P(
    Files, VolumeInputs,
    testing::Values(FieldInput{.name = "scene_abutting_blocks.yaml", .volume = 9785.4},
                    FieldInput{.name = "grid_abutting_boxes.vdb", .area = 1792, .volume = 5120},
                    FieldInput{"scene_formula_20000_chars.yaml", {}, "20014 characters, must have at most 19999"},
                    FieldInput{"formula_floor.yaml"}, FieldInput{"yaml_merge_key.yaml"},
                    FieldInput{"formula_nan_half.yaml", {}, "--nan outside"},
                    FieldInput{"scene_grid_with_nan.yaml", {}, "--nan outside"},
                    FieldInput{"scene_resolution_1048576.yaml", {}, "TB"},
                    FieldInput{.name = "grid_sdf_no_class_background0.vdb", .volume = 4189},
                    FieldInput{.name = "grid_ls_positive_inside.vdb", .warning = "--inside high", .volume = 4189},
                    FieldInput{.name = "grid_ls_not_flood_filled.vdb", .warning = "--flood-fill", .components = 2},
                    FieldInput{.name = "grid_ls_not_flood_filled.vdb", .options = {"--flood-fill"}, .volume = 4189},
                    FieldInput{.name = "grid_ls_iso_near_band_end.vdb",
                               .options = {"--iso", "2.9"},
                               .warning = "from where the values end"},
                    FieldInput{.name = "grid_minus_inf_voxel.vdb", .options = {"--nan", "outside"}, .volume = 4189},
                    FieldInput{"grid_nan_center.vdb", {}, "--nan outside"},
                    FieldInput{.name = "grid_utm_1cm.vdb", .options = {"--origin", "auto"}},
                    FieldInput{.name = "grid_utm_1cm.vdb", .options = {"--double"}}),
    testName);

}  // namespace
}  // namespace pdc::test
