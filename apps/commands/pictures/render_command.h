#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "pdc/render/render.h"

namespace pdc {

/// What the command line of `pdc render` says.
struct RenderRequest {
  std::filesystem::path mesh, picture, reference;
  Vec3d towardsViewer{1, -1, 1};
  int width = 1024, height = 1024;
  std::string shading = "clay";
  std::optional<double> range;
  std::optional<int> threads;
  bool edges = false, quiet = false;
};

void addRenderOptions(CLI::App& command, RenderRequest& request);

/// Draws a mesh into a .png file. \throws Error, CLI::ValidationError, Cancelled; no picture is made then.
void runRender(const RenderRequest& request);

}  // namespace pdc
