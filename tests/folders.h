#pragma once

#include <filesystem>

namespace pdc::test {

/// The folder with real grids, volumes and meshes, which need not exist: tests that want a file of it skip without it.
[[nodiscard]] std::filesystem::path dataFolder();
/// The project's own folder.
[[nodiscard]] std::filesystem::path sourceFolder();

}  // namespace pdc::test
