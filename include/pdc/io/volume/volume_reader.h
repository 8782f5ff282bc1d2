#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pdc/math/mat3.h"
#include "pdc/monitor.h"
#include "pdc/sample/dense/volume_view.h"

namespace pdc {

/// How the values of a file without a header lie in it: x runs fastest, then y, then z.
struct RawVolume {
  std::array<std::int64_t, 3> size{};  ///< Points along x, y and z, > 0.
  ScalarType type = ScalarType::kUint8;
  bool bigEndian = false;
  std::uint64_t skip = 0;  ///< Bytes before the first value.
};

/// Reads "256x256x128:u16be": points along x, y and z; u8 i8 u16 i16 u32 i32 u64 i64 f16 f32 or f64; le, which is the
/// default, or be; and, after a further colon, the bytes to skip. \throws Error for anything else.
[[nodiscard]] RawVolume parseRawVolume(std::string_view text);

/// A frame of the world: which way its x, y and z axes point.
enum class WorldFrame {
  kFile,  ///< The one that the file has.
  kRas,   ///< Right, anterior, superior.
  kLps,   ///< Left, posterior, superior.
};

struct VolumeReadOptions {
  std::optional<RawVolume> raw{};      ///< The file has no header, whatever its suffix.
  std::optional<std::string> array{};  ///< Of an .npz with several arrays of three dimensions.
  /// Of DICOM files of several series: its SeriesInstanceUID, or its place in the order of their numbers, from 1.
  std::optional<std::string> series{};
  /// Which volume of a file that has one after the other, from 0. Empty: the first, with a warning.
  std::optional<std::int64_t> volumeIndex{};
  std::optional<std::int64_t> channel{};           ///< Which value of points that have several, from 0; needed there.
  std::optional<std::array<double, 3>> spacing{};  ///< World units from point to point along x, y, z, > 0 and finite.
  WorldFrame frame = WorldFrame::kFile;
};

/// A dense volume from a file. Point i of the lattice lies at `linear · i + translation` in the world: the centre of
/// the first voxel is at `translation`.
struct DenseVolume {
  VolumeView view;
  std::shared_ptr<const void> owner;  ///< Keeps what the view looks at alive.
  Mat3d linear{};                     ///< Regular and finite; mirrored, rotated and sheared as the file says.
  Vec3d translation{};
  std::string format;        ///< "NIfTI-1", "NRRD", "MetaImage", "npy", "npz", "raw", "Inrimage", "TIFF" or "DICOM".
  std::string encoding;      ///< "raw", "deflate", "text", or "decoded" by a library.
  std::string space;         ///< "RAS", "LPS" or what else the file calls its frame; empty where it does not say.
  std::string unit;          ///< "mm" and so on; empty where the file does not say.
  std::string orientation;   ///< What the map was taken from, such as "sform, code 1"; empty where there is nothing.
  bool spacingKnown = true;  ///< False where the spacing is 1 because the file has none.
  std::vector<std::string> warnings;  ///< A line each, without the file's name.
};

/// Whether the name is that of a volume: .nii, .hdr, .img, .nrrd, .nhdr, .mha, .mhd, .npy, .npz, .raw, .inr, .tif,
/// .tiff, .dcm, in upper or lower case; .nii, .raw and .inr also with .gz. The file need not exist. A folder is one if
/// .tif files are in it, or files that begin as DICOM does.
[[nodiscard]] bool isVolumeFile(const std::filesystem::path& path);

/// Reads a dense volume by its suffix. Values that are not compressed stay in the file, which is mapped into memory and
/// must not change while the volume lives; others are inflated, into a buffer that is no larger than the header asks
/// for and the file can hold.
///
/// NIfTI: values scaled by scl_slope and scl_inter unless the slope is 0 or not finite; the map is the sform if its
/// code is above 0, else the qform if its code is, else pixdim; frame RAS. NRRD: space directions and origin, or
/// spacings and axis mins. MetaImage: TransformMatrix, whose rows are the directions of the axes, spacing and offset;
/// frame LPS, as ITK has it. `.npy`, `.npz`: indexed [x, y, z], spacing 1. Inrimage: VX, VY, VZ. TIFF, in builds with
/// libtiff: the pages of a file, or the files of a folder in the order of the numbers in their names; spacing as ImageJ
/// writes it. DICOM, in builds with GDCM: a file, of one or several frames, or the files of a folder; slices in the
/// order of their positions along the normal of their planes, steps from slice to slice by those positions too, with a
/// warning where they are not equal; several volumes in the same places are chosen from; values scaled by slope and
/// intercept, which make them single-precision where they are not the same for all slices; frame LPS. libtiff and GDCM
/// run in child processes, which a damaged file may crash.
///
/// \throws Error for a file that cannot be read, that is malformed or shorter than its header says, for values that are
/// no real numbers, and for options that do not fit; Cancelled.
[[nodiscard]] DenseVolume readVolume(const std::filesystem::path& path, const VolumeReadOptions& options = {},
                                     const Monitor& monitor = {});

}  // namespace pdc
