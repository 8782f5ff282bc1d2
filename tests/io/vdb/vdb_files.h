#pragma once

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"
#include "pdc/io/vdb/vdb_reader.h"

namespace pdc {

/// A fixture for tests that write grids with OpenVDB and read them with pdc.
class VdbFiles : public testing::Test {
 protected:
  void SetUp() override { openvdb::initialize(); }

  [[nodiscard]] std::filesystem::path write(
      const openvdb::GridCPtrVec& grids,
      std::uint32_t compression = openvdb::io::Archive::DEFAULT_COMPRESSION_FLAGS) const {
    const std::filesystem::path path = mFolder / "a.vdb";
    openvdb::io::File file(path.string());
    file.setCompression(compression);
    file.write(grids);
    return path;
  }

  TemporaryFolder mFolder;
};

/// The message of the Error that `action` throws; empty if it throws none.
template <typename Action>
std::string errorOf(Action&& action) {
  try {
    action();
    return "";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }
}

inline std::string errorOfReading(const std::filesystem::path& path, const std::string& name = "") {
  return errorOf([&] { static_cast<void>(readVdbGrid(path, name)); });
}

inline std::string errorOfListing(const std::filesystem::path& path) {
  return errorOf([&] { static_cast<void>(listVdbGrids(path)); });
}

inline constexpr std::uint32_t kNone = openvdb::io::COMPRESS_NONE, kMask = openvdb::io::COMPRESS_ACTIVE_MASK,
                               kZip = openvdb::io::COMPRESS_ZIP, kBlosc = openvdb::io::COMPRESS_BLOSC;

inline openvdb::FloatGrid::Ptr sphere() {
  const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0f, openvdb::Vec3f(1, 2, 3), 0.5f);
  grid->setName("sphere");
  return grid;
}

}  // namespace pdc
