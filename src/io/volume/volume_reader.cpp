#include "pdc/io/volume/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>

#include "io/file/file_error.h"
#include "io/file/suffix.h"
#include "io/volume/dicom_series.h"
#include "io/volume/tiff_stack.h"
#include "io/volume/volume_header.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

using HeaderReader = detail::VolumeHeader (*)(const fs::path&, const VolumeReadOptions&);

/// Has no reader: nothing is known of a file of raw values but what the options say.
detail::VolumeHeader readRaw(const fs::path& path, const VolumeReadOptions& options) {
  if (!options.raw) throw Error("raw values have no header; --raw says what they are, like 256x256x128:u16be");
  return detail::describeRaw(path, *options.raw);
}

struct Format {
  std::string_view suffix;
  HeaderReader read;
};

constexpr auto kFormats = std::to_array<Format>({{".nii", detail::readNiftiHeader},
                                                 {".nii.gz", detail::readNiftiHeader},
                                                 {".hdr", detail::readNiftiHeader},
                                                 {".img", detail::readNiftiHeader},
                                                 {".nrrd", detail::readNrrdHeader},
                                                 {".nhdr", detail::readNrrdHeader},
                                                 {".mha", detail::readMetaImageHeader},
                                                 {".mhd", detail::readMetaImageHeader},
                                                 {".npy", detail::readNpyHeader},
                                                 {".npz", detail::readNpzHeader},
                                                 {".inr", detail::readInrimageHeader},
                                                 {".inr.gz", detail::readInrimageHeader},
                                                 {".raw", readRaw},
                                                 {".raw.gz", readRaw}});

HeaderReader readerOf(const fs::path& path) {
  std::string suffix = detail::suffixOf(path);
  if (suffix == ".gz") suffix = detail::suffixOf(path.stem()) + suffix;
  for (const Format& format : kFormats)
    if (format.suffix == suffix) return format.read;
  return nullptr;
}

void setSpacing(const std::array<double, 3>& spacing, DenseVolume& volume) {
  for (int axis = 0; axis < 3; ++axis) {
    const double to = spacing[static_cast<std::size_t>(axis)], from = length(volume.linear.column(axis));
    if (!(to > 0 && std::isfinite(to))) throw Error(fmt::format("a spacing is {}; it must be finite and above 0", to));
    for (int row = 0; row < 3; ++row) volume.linear.row[static_cast<std::size_t>(row)][axis] *= to / from;
  }
  volume.spacingKnown = true;
}

/// Turns the axes of the world that point the other way in the wanted frame.
void setFrame(WorldFrame frame, DenseVolume& volume) {
  if (frame == WorldFrame::kFile) return;
  const std::string wanted = frame == WorldFrame::kRas ? "RAS" : "LPS";
  const auto isLetters = [](const std::string& s) {
    return s.size() == 3 && (s[0] == 'R' || s[0] == 'L') && (s[1] == 'A' || s[1] == 'P') &&
           (s[2] == 'S' || s[2] == 'I');
  };
  if (!isLetters(volume.space))
    throw Error(fmt::format("cannot be turned to {}: {}", wanted,
                            volume.space.empty() ? "the file does not say which way its axes point"
                                                 : fmt::format("its frame is \"{}\"", volume.space)));
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (volume.space[i] == wanted[i]) continue;
    volume.linear.row[i] = volume.linear.row[i] * -1.0;
    volume.translation[axis] = -volume.translation[axis];
  }
  volume.space = wanted;
}

void checkMap(const DenseVolume& volume) {
  const double d = volume.linear.determinant();
  const Vec3d& t = volume.translation;
  if (!(std::isfinite(d) && d != 0)) throw Error(fmt::format("its map to the world is singular: determinant {}", d));
  if (!std::isfinite(t.x + t.y + t.z)) throw Error("its place in the world is not finite");
}

const char* nameOf(detail::VolumeEncoding encoding) {
  switch (encoding) {
    case detail::VolumeEncoding::kRaw:
      return "raw";
    case detail::VolumeEncoding::kText:
      return "text";
    default:
      return "deflate";
  }
}

bool isTiff(const fs::path& path) {
  const std::string suffix = detail::suffixOf(path);
  return suffix == ".tif" || suffix == ".tiff" || detail::isTiffFolder(path);
}

detail::VolumeHeader readHeader(const fs::path& path, const VolumeReadOptions& options, const Monitor& monitor) {
  if (!options.raw && isTiff(path)) return detail::readTiffStack(path, options, monitor);
  if (!options.raw && detail::isDicom(path)) return detail::readDicomSeries(path, options, monitor);
  const HeaderReader reader = options.raw ? readRaw : readerOf(path);
  if (reader == nullptr) throw Error("not the name of a volume");
  return reader(path, options);
}

/// The bytes from point (0, 0, 0) to the last.
detail::LoadedBytes load(const detail::VolumeHeader& header, const fs::path& path, const Monitor& monitor) {
  const VolumeView& view = header.volume.view;
  std::uint64_t count = sizeOf(view.type);
  for (std::size_t axis = 0; axis < 3; ++axis)
    count += static_cast<std::uint64_t>(view.size[axis] - 1) * static_cast<std::uint64_t>(view.stride[axis]);
  if (header.loaded.data == nullptr) return detail::loadVolume(header.data, header.first, count, path, monitor);
  return {header.loaded.data + header.first, header.loaded.owner};
}

DenseVolume read(const fs::path& path, const VolumeReadOptions& options, const Monitor& monitor) {
  detail::VolumeHeader header = readHeader(path, options, monitor);
  DenseVolume& volume = header.volume;
  checkMap(volume);
  if (options.spacing) {
    if (!volume.spacingKnown)
      std::erase_if(volume.warnings, [](const std::string& w) { return w.find("--spacing") != std::string::npos; });
    setSpacing(*options.spacing, volume);
    checkMap(volume);
  }
  setFrame(options.frame, volume);
  volume.encoding = header.loaded.data == nullptr ? nameOf(header.data.encoding) : "decoded";

  const detail::LoadedBytes loaded = load(header, path, monitor);
  volume.view.data = loaded.data;
  volume.owner = loaded.owner;
  return std::move(volume);
}

}  // namespace

bool isVolumeFile(const fs::path& path) { return readerOf(path) != nullptr || isTiff(path) || detail::isDicom(path); }

DenseVolume readVolume(const fs::path& path, const VolumeReadOptions& options, const Monitor& monitor) {
  try {
    return read(path, options, monitor);
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  } catch (const std::bad_alloc&) {
    throw detail::fileError(path, "does not fit into memory: " + detail::memoryFigures());
  }
}

}  // namespace pdc
