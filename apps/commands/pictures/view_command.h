#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "pdc/math/vec3.h"

namespace pdc {

/// What the command line of `pdc view` says.
struct ViewRequest {
  std::filesystem::path mesh, page, reference;
  std::string title;
  Vec3d towardsViewer{1, -1, 1};
  std::optional<int> threads;
  bool quiet = false;
};

void addViewOptions(CLI::App& command, ViewRequest& request);

/// Writes a page with a mesh to turn. \throws Error, Cancelled; no page is made then.
void runView(const ViewRequest& request);

}  // namespace pdc
