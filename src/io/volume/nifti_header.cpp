#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/deflate/inflate.h"
#include "io/file/mapped_file.h"
#include "io/file/suffix.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kBytes1 = 348, kBytes2 = 540;

/// An affine map of a header, and whether it says one.
struct NiftiMap {
  int code = 0;
  Mat3d linear{};
  Vec3d translation{};

  [[nodiscard]] bool regular() const {
    const double d = linear.determinant();
    return d != 0 && std::isfinite(d) && std::isfinite(translation.x + translation.y + translation.z);
  }
};

/// The fields of both versions that matter.
struct NiftiFields {
  bool second = false, pair = false, swapped = false;
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  int datatype = 0, units = 0;
  double offset = 0, slope = 0, intercept = 0;
  NiftiMap sform, qform;
};

/// The beginning of a file, inflated where its name says so.
std::string beginningOf(const std::filesystem::path& path) {
  const MappedFile file(path);
  const std::span<const char> bytes = file.bytes();
  std::string head(kBytes2, '\0');
  if (suffixOf(path) == ".gz") {
    head.resize(InflateStream(bytes).readSome(head.data(), head.size()));
  } else {
    head.assign(bytes.data(), std::min(bytes.size(), kBytes2));
  }
  return head;
}

Vec3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The map of a unit quaternion of which three parts are given, with the spacing and the sense of the third axis.
Mat3d quaternionMap(const Vec3d& bcd, const std::array<double, 8>& pixdim) {
  double b = bcd.x, c = bcd.y, d = bcd.z, a = 1 - dot(bcd, bcd);
  constexpr double kNearHalfTurn = 1e-7;
  if (a < kNearHalfTurn) {
    const double s = 1 / std::sqrt(dot(bcd, bcd));
    b *= s, c *= s, d *= s, a = 0;
  } else {
    a = std::sqrt(a);
  }
  const Mat3d rotation{{Vec3d{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
                        Vec3d{2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
                        Vec3d{2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - c * c - b * b}}};
  return rotation * Mat3d::diagonal(pixdim[1], pixdim[2], pixdim[0] < 0 ? -pixdim[3] : pixdim[3]);
}

/// Reads the fields of one version. `Real`, `Code`, `Size`: how it stores numbers.
template <typename Real, typename Code, typename Size>
class FieldReader {
 public:
  FieldReader(std::string_view bytes, bool swapped) : mBytes(bytes), mSwapped(swapped) {}

  [[nodiscard]] Code code(std::size_t offset) const { return numberAt<Code>(mBytes, offset, mSwapped); }
  [[nodiscard]] double real(std::size_t offset) const {
    return static_cast<double>(numberAt<Real>(mBytes, offset, mSwapped));
  }
  void sizes(std::size_t offset, std::array<std::int64_t, 8>& to) const {
    for (std::size_t i = 0; i < to.size(); ++i)
      to[i] = static_cast<std::int64_t>(numberAt<Size>(mBytes, offset + i * sizeof(Size), mSwapped));
  }
  void reals(std::size_t offset, std::array<double, 8>& to) const {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = real(offset + i * sizeof(Real));
  }
  [[nodiscard]] Vec3d vector(std::size_t offset) const {
    return vectorOf({real(offset), real(offset + sizeof(Real)), real(offset + 2 * sizeof(Real))});
  }
  /// Three rows of four numbers.
  void rows(std::size_t offset, NiftiMap& map) const {
    for (int i = 0; i < 3; ++i) {
      const std::size_t row = offset + static_cast<std::size_t>(i) * 4 * sizeof(Real);
      map.linear.row[static_cast<std::size_t>(i)] = vector(row);
      map.translation[i] = real(row + 3 * sizeof(Real));
    }
  }

 private:
  std::string_view mBytes;
  bool mSwapped;
};

NiftiFields readFirst(std::string_view bytes, bool swapped) {
  const FieldReader<float, std::int16_t, std::int16_t> from(bytes, swapped);
  NiftiFields f;
  f.swapped = swapped;
  f.pair = bytes.substr(344, 3) == "ni1";
  if (!f.pair && bytes.substr(344, 3) != "n+1")
    throw Error(
        "the header has no NIfTI signature; an older ANALYZE header says nothing of orientation and is not read");
  from.sizes(40, f.dim);
  f.datatype = from.code(70);
  from.reals(76, f.pixdim);
  f.offset = from.real(108);
  f.slope = from.real(112);
  f.intercept = from.real(116);
  f.units = static_cast<unsigned char>(bytes[123]);
  f.qform.code = from.code(252);
  f.sform.code = from.code(254);
  f.qform.linear = quaternionMap(from.vector(256), f.pixdim);
  f.qform.translation = from.vector(268);
  from.rows(280, f.sform);
  return f;
}

NiftiFields readSecond(std::string_view bytes, bool swapped) {
  const FieldReader<double, std::int32_t, std::int64_t> from(bytes, swapped);
  NiftiFields f;
  f.second = true;
  f.swapped = swapped;
  f.pair = bytes.substr(4, 3) == "ni2";
  if (!f.pair && bytes.substr(4, 3) != "n+2") throw Error("the header has no NIfTI-2 signature");
  f.datatype = numberAt<std::int16_t>(bytes, 12, swapped);
  from.sizes(16, f.dim);
  from.reals(104, f.pixdim);
  f.offset = static_cast<double>(numberAt<std::int64_t>(bytes, 168, swapped));
  f.slope = from.real(176);
  f.intercept = from.real(184);
  f.qform.code = from.code(344);
  f.sform.code = from.code(348);
  f.qform.linear = quaternionMap(from.vector(352), f.pixdim);
  f.qform.translation = from.vector(376);
  from.rows(400, f.sform);
  f.units = from.code(500);
  return f;
}

NiftiFields readFields(std::string_view bytes) {
  for (const bool swapped : {false, true}) {
    if (bytes.size() < sizeof(std::int32_t)) break;
    const auto size = numberAt<std::int32_t>(bytes, 0, swapped);
    if (size == static_cast<std::int32_t>(kBytes1) && bytes.size() >= kBytes1) return readFirst(bytes, swapped);
    if (size == static_cast<std::int32_t>(kBytes2) && bytes.size() >= kBytes2) return readSecond(bytes, swapped);
  }
  throw Error("not NIfTI: it does not begin with a header of 348 or 540 bytes");
}

/// Type and values a point.
struct NiftiType {
  ScalarType type;
  std::int64_t channels = 1;
};

NiftiType typeOf(int datatype) {
  switch (datatype) {
    case 2:
      return {ScalarType::kUint8};
    case 4:
      return {ScalarType::kInt16};
    case 8:
      return {ScalarType::kInt32};
    case 16:
      return {ScalarType::kFloat32};
    case 64:
      return {ScalarType::kFloat64};
    case 128:
      return {ScalarType::kUint8, 3};
    case 256:
      return {ScalarType::kInt8};
    case 512:
      return {ScalarType::kUint16};
    case 768:
      return {ScalarType::kUint32};
    case 1024:
      return {ScalarType::kInt64};
    case 1280:
      return {ScalarType::kUint64};
    case 2304:
      return {ScalarType::kUint8, 4};
    default:
      throw Error(fmt::format("NIfTI values of type {} are not read: they are no integers or reals of up to 64 bits",
                              datatype));
  }
}

std::vector<MemoryAxis> axesOf(const NiftiFields& f, std::int64_t channels) {
  const std::int64_t dimensions = f.dim[0];
  if (dimensions < 1 || dimensions > 7) throw Error(fmt::format("the header says {} dimensions", dimensions));
  std::vector<MemoryAxis> axes;
  if (channels > 1) axes.push_back({channels, MemoryAxis::kChannel});
  for (int i = 0; i < 3; ++i) axes.push_back({i < dimensions ? f.dim[static_cast<std::size_t>(i) + 1] : 1, i});
  if (dimensions > 3 && f.dim[4] != 1) axes.push_back({f.dim[4], MemoryAxis::kVolume});
  for (std::int64_t i = 5; i <= dimensions; ++i)
    if (const std::int64_t size = f.dim[static_cast<std::size_t>(i)]; size != 1)
      axes.push_back({size, MemoryAxis::kChannel});
  if (std::count_if(axes.begin(), axes.end(), [](const MemoryAxis& a) { return a.role == MemoryAxis::kChannel; }) > 1)
    throw Error("the header has several dimensions of more than 1 beyond the fourth");
  return axes;
}

/// The largest distance between what two maps make of the corners of the volume.
double differenceOf(const NiftiMap& a, const NiftiMap& b, const std::array<std::int64_t, 3>& size) {
  double most = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3d index;
    for (int axis = 0; axis < 3; ++axis)
      index[axis] = (corner >> axis & 1) != 0 ? static_cast<double>(size[static_cast<std::size_t>(axis)] - 1) : 0;
    most = std::max(most, length(a.linear * index + a.translation - b.linear * index - b.translation));
  }
  return most;
}

void takeMap(const NiftiMap& map, const char* name, DenseVolume& volume) {
  volume.linear = map.linear;
  volume.translation = map.translation;
  volume.orientation = fmt::format("{}, code {}", name, map.code);
  volume.space = "RAS";
}

/// Takes the sform, the qform or the spacing alone, as the codes say.
void chooseMap(const NiftiFields& f, DenseVolume& volume) {
  const auto usable = [&](const NiftiMap& map, const char* name) {
    if (map.code <= 0) return false;
    if (!map.regular())
      volume.warnings.push_back(fmt::format("the {} has code {} but is no map; it is passed over", name, map.code));
    return map.regular();
  };
  const bool sform = usable(f.sform, "sform"), qform = usable(f.qform, "qform");
  if (sform) {
    takeMap(f.sform, "sform", volume);
    constexpr double kMostDifference = 0.01;  // voxels
    const double difference = differenceOf(f.sform, f.qform, volume.view.size);
    if (qform && difference > kMostDifference * std::cbrt(std::abs(f.sform.linear.determinant())))
      volume.warnings.push_back(
          fmt::format("sform and qform differ, by up to {:.4g}; the sform was taken", difference));
    return;
  }
  if (qform) return takeMap(f.qform, "qform", volume);
  const Vec3d spacing = regularSpacing({f.pixdim[1], f.pixdim[2], f.pixdim[3]}, "pixdim", volume);
  volume.linear = Mat3d::diagonal(spacing.x, spacing.y, spacing.z);
  volume.orientation = "pixdim";
  volume.warnings.push_back("has neither sform nor qform; only its spacing is known, not which way it lies");
}

std::string unitOf(int units) {
  switch (units & 7) {
    case 1:
      return "m";
    case 2:
      return "mm";
    case 3:
      return "um";
    default:
      return "";
  }
}

/// The file beside `path` that has its name but another suffix, in the case of the given one.
std::filesystem::path sibling(std::filesystem::path path, const char* lower, const char* upper) {
  const bool isUpper = path.extension().string().find_first_of("HI") != std::string::npos;
  return path.replace_extension(isUpper ? upper : lower);
}

}  // namespace

VolumeHeader readNiftiHeader(const std::filesystem::path& path, const VolumeReadOptions& options) {
  const std::string suffix = suffixOf(path);
  const std::filesystem::path header = suffix == ".img" ? sibling(path, ".hdr", ".HDR") : path;
  const NiftiFields f = readFields(beginningOf(header));
  const bool named = suffix == ".hdr" || suffix == ".img";
  if (f.pair && !named) throw Error("the header is that of a pair, .hdr and .img, but the file is named otherwise");

  VolumeHeader result;
  DenseVolume& volume = result.volume;
  volume.format = f.second ? "NIfTI-2" : "NIfTI-1";
  const NiftiType type = typeOf(f.datatype);
  volume.view.type = type.type;
  volume.view.swapped = f.swapped && sizeOf(type.type) > 1;
  layOut(axesOf(f, type.channels), options, result);
  if (std::isfinite(f.slope) && f.slope != 0) {
    volume.view.slope = f.slope;
    volume.view.intercept = std::isfinite(f.intercept) ? f.intercept : 0;
  }
  chooseMap(f, volume);
  volume.unit = unitOf(f.units);

  constexpr double kMostOffset = 9e15;  // exact in double precision
  if (!(f.offset >= 0 && f.offset <= kMostOffset)) throw Error(fmt::format("the values' offset is {}", f.offset));
  std::uint64_t offset = static_cast<std::uint64_t>(f.offset);
  if (!f.pair) offset = std::max<std::uint64_t>(offset, (f.second ? kBytes2 : kBytes1) + 4);
  const bool deflated = suffix == ".gz";
  result.data.encoding = deflated ? VolumeEncoding::kDeflated : VolumeEncoding::kRaw;
  result.data.skip = offset;
  result.data.pieces = {{f.pair ? sibling(path, ".img", ".IMG") : header}};
  return result;
}

}  // namespace pdc::detail
