#include "io/volume/dicom_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/suffix.h"
#include "io/volume/child_stream.h"
#include "io/volume/dicom_module.h"
#include "io/volume/header_text.h"
#include "pdc/error.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;
using Slices = std::vector<DicomSlice>;

bool beginsAsDicom(const fs::path& path) {
  constexpr std::size_t kPreamble = 128;
  std::array<char, kPreamble + 4> begin{};
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  return file.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()).ends_with("DICM");
}

std::vector<fs::path> filesOf(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path))
    if (beginsAsDicom(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Slices readSlices(const std::vector<fs::path>& files, const Monitor& monitor) {
  monitor.throwIfStopped();
  const DicomModule& dicom = dicomModule();
  ChildStream stream("reading DICOM", [&](ChildOutput& out) { dicom.writeSlices(files, out); });
  std::int64_t count = 0;
  stream.read({reinterpret_cast<char*>(&count), sizeof(count)});
  Slices slices(static_cast<std::size_t>(count));
  stream.read({reinterpret_cast<char*>(slices.data()), slices.size() * sizeof(DicomSlice)});
  if (slices.empty()) throw Error("has no pictures");
  return slices;
}

std::string_view textOf(const std::array<char, 72>& text) { return text.data(); }

/// Parts slices by their series, in the order of the series' numbers.
std::vector<Slices> seriesOf(const Slices& slices) {
  std::vector<Slices> series;
  for (const DicomSlice& slice : slices) {
    const auto same =
        std::find_if(series.begin(), series.end(), [&](const Slices& s) { return s.front().series == slice.series; });
    if (same == series.end())
      series.push_back({slice});
    else
      same->push_back(slice);
  }
  std::sort(series.begin(), series.end(), [](const Slices& a, const Slices& b) {
    const DicomSlice &x = a.front(), &y = b.front();
    return x.seriesNumber != y.seriesNumber ? x.seriesNumber < y.seriesNumber : x.series < y.series;
  });
  return series;
}

std::string namesOf(const std::vector<Slices>& series) {
  constexpr std::size_t kMostNamed = 10;
  std::string names;
  for (std::size_t i = 0; i < std::min(series.size(), kMostNamed); ++i)
    names += fmt::format("{}{} is \"{}\", {} slices, {}", i == 0 ? "" : "; ", i + 1,
                         oneLine(textOf(series[i].front().description)), series[i].size(),
                         oneLine(textOf(series[i].front().series)));
  return names + (series.size() > kMostNamed ? "; and so on" : "");
}

Slices chooseSeries(const Slices& slices, const VolumeReadOptions& options) {
  const std::vector<Slices> series = seriesOf(slices);
  if (!options.series) {
    if (series.size() == 1) return series.front();
    throw Error(fmt::format("holds {} series; --series takes one of them: {}", series.size(), namesOf(series)));
  }
  for (const Slices& one : series)
    if (textOf(one.front().series) == *options.series) return one;
  const auto number = TextScanner::parse<std::size_t>(*options.series).value_or(0);
  if (number < 1 || number > series.size())
    throw Error(fmt::format("there is no series {}: {}", oneLine(*options.series), namesOf(series)));
  return series[number - 1];
}

bool isSaid(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

Vec3d positionOf(const DicomSlice& slice) { return {slice.position[0], slice.position[1], slice.position[2]}; }

/// Where columns count up (0), and where rows do (1).
Vec3d directionOf(const DicomSlice& slice, std::size_t which) {
  return {slice.orientation[3 * which], slice.orientation[3 * which + 1], slice.orientation[3 * which + 2]};
}

/// Whether all slices say where they are.
bool arePlaced(const Slices& slices) {
  return std::all_of(slices.begin(), slices.end(),
                     [](const DicomSlice& s) { return isSaid(s.position) && isSaid(s.orientation); });
}

void checkAlike(const Slices& slices, bool placed) {
  const DicomSlice& first = slices.front();
  for (const DicomSlice& s : slices) {
    if (s.columns != first.columns || s.rows != first.rows || s.bits != first.bits || s.isSigned != first.isSigned)
      throw Error(fmt::format("slices differ: {} x {} values of {} bits, and {} x {} of {}", first.columns, first.rows,
                              first.bits, s.columns, s.rows, s.bits));
    constexpr double kAlike = 1e-3;
    const bool aligned =
        !placed ||
        length(directionOf(s, 0) - directionOf(first, 0)) + length(directionOf(s, 1) - directionOf(first, 1)) < kAlike;
    const bool same = std::equal(s.spacing.begin(), s.spacing.end(), first.spacing.begin(), [](double a, double b) {
      return a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) < kAlike * std::abs(b);
    });
    if (!aligned || !same) throw Error("slices differ in orientation or spacing");
  }
}

/// How many slices lie in each place of sorted ones; the first is in its place with that many.
std::int64_t timesOf(const std::vector<double>& heights) {
  const double extent = heights.back() - heights.front(), tolerance = 1e-6 * extent;
  std::int64_t times = 0, run = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    ++run;
    if (i + 1 < heights.size() && heights[i + 1] - heights[i] <= tolerance) continue;
    if (times == 0) times = run;
    if (run != times)
      throw Error(fmt::format("{} slices lie in one place and {} in another; they are not one volume", times, run));
    run = 0;
  }
  return times;
}

/// Sorts the slices along their normal. \returns how many lie in each place.
std::int64_t sortByPlace(Slices& slices) {
  const Vec3d normal = cross(directionOf(slices.front(), 0), directionOf(slices.front(), 1));
  const auto height = [&](const DicomSlice& s) { return dot(normal, positionOf(s)); };
  std::vector<double> heights;
  for (const DicomSlice& s : slices) heights.push_back(height(s));
  std::sort(heights.begin(), heights.end());
  const std::int64_t times = timesOf(heights);
  std::stable_sort(slices.begin(), slices.end(),
                   [&](const DicomSlice& a, const DicomSlice& b) { return height(a) < height(b); });
  for (auto place = slices.begin(); place != slices.end(); place += times)
    std::stable_sort(place, place + times,
                     [](const DicomSlice& a, const DicomSlice& b) { return a.instance < b.instance; });
  return times;
}

/// Whether slices are frames of one file that says one place for all.
bool areFramesOfOnePlace(const Slices& slices) {
  const DicomSlice& first = slices.front();
  return slices.size() > 1 && std::all_of(slices.begin(), slices.end(), [&](const DicomSlice& s) {
           return s.file == first.file && s.position == first.position;
         });
}

/// Says how many files have no slice.
void notePassedOver(const Slices& slices, std::size_t files, DenseVolume& volume) {
  std::size_t used = 0;
  std::int64_t last = -1;
  for (const DicomSlice& slice : slices) {
    if (slice.file != last) ++used;
    last = slice.file;
  }
  if (used < files)
    volume.warnings.push_back(fmt::format("{} DICOM files without pictures are passed over", files - used));
}

/// Says where steps from place to place differ: one map for all points puts some slices elsewhere than they are.
void checkSteps(const Slices& slices, std::int64_t times, const Vec3d& step, DenseVolume& volume) {
  double off = 0, least = INFINITY, most = 0;
  const Vec3d first = positionOf(slices.front());
  const auto stride = static_cast<std::size_t>(times);
  for (std::size_t i = stride; i < slices.size(); i += stride) {
    const Vec3d here = positionOf(slices[i]);
    const double gap = length(here - positionOf(slices[i - stride]));
    off = std::max(off, length(here - first - step * static_cast<double>(i / stride)));
    least = std::min(least, gap);
    most = std::max(most, gap);
  }
  constexpr double kWorthSaying = 0.01;
  if (off > kWorthSaying * length(step))
    volume.warnings.push_back(
        fmt::format("steps from slice to slice are {:.6g} to {:.6g}; they were taken as equal, which puts slices up to "
                    "{:.6g} from their places: are some missing?",
                    least, most, off));
}

/// Where slices lie, and in which order they are.
enum class Order {
  kPositions,  ///< Along the normal, by their positions.
  kFrames,     ///< Frames of a file, one after the other from its one position.
  kNumbers,    ///< Nothing says where they are.
};

void place(const Slices& slices, std::int64_t times, Order order, DenseVolume& volume) {
  const bool placed = order != Order::kNumbers;
  const DicomSlice& first = slices.front();
  const std::int64_t places = static_cast<std::int64_t>(slices.size()) / times;
  if (!placed) volume.warnings.push_back("does not say where its slices are; they are in the order of their numbers");
  const Vec3d x = placed ? directionOf(first, 0) : Vec3d{1, 0, 0}, y = placed ? directionOf(first, 1) : Vec3d{0, 1, 0};
  Vec3d step = cross(x, y) * (std::isfinite(first.between) ? first.between : first.thickness);
  if (order == Order::kPositions && places > 1) {
    step = (positionOf(slices[slices.size() - static_cast<std::size_t>(times)]) - positionOf(first)) *
           (1 / static_cast<double>(places - 1));
    checkSteps(slices, times, step, volume);
  }
  const Vec3d spacing = regularSpacing({first.spacing[1], first.spacing[0], length(step)}, "its spacing", volume);
  if (!std::isfinite(length(step)) || length(step) == 0) step = cross(x, y) * spacing.z;
  const Vec3d along = x * spacing.x, up = y * spacing.y;
  for (int row = 0; row < 3; ++row) volume.linear.row[static_cast<std::size_t>(row)] = {along[row], up[row], step[row]};
  volume.translation = placed ? positionOf(first) : Vec3d{};
  volume.orientation = placed ? "positions of slices" : "";
  volume.space = placed ? "LPS" : "";
  volume.unit = "mm";
}

ScalarType typeOf(const DicomSlice& slice) {
  const bool isSigned = slice.isSigned != 0;
  if (slice.bits == 8) return isSigned ? ScalarType::kInt8 : ScalarType::kUint8;
  if (slice.bits == 16) return isSigned ? ScalarType::kInt16 : ScalarType::kUint16;
  return isSigned ? ScalarType::kInt32 : ScalarType::kUint32;
}

bool isScaledAlike(const Slices& slices) {
  return std::all_of(slices.begin(), slices.end(), [&](const DicomSlice& s) {
    return s.slope == slices.front().slope && s.intercept == slices.front().intercept;
  });
}

/// The values of a slice with its own scale.
void scale(std::span<const char> stored, const DicomSlice& slice, std::span<char> to) {
  const std::size_t bytes = static_cast<std::size_t>(slice.bits) / 8;
  for (std::size_t i = 0; i < stored.size() / bytes; ++i) {
    std::int64_t value = 0;
    std::memcpy(&value, stored.data() + i * bytes, bytes);
    const int free = 64 - slice.bits;
    const auto high = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << free);
    const std::int64_t number = slice.isSigned != 0 ? high >> free : value;
    const auto scaled = static_cast<float>(slice.slope * static_cast<double>(number) + slice.intercept);
    std::memcpy(to.data() + i * sizeof(scaled), &scaled, sizeof(scaled));
  }
}

/// Reads the values of all slices; as single-precision numbers where each has a scale of its own.
LoadedBytes readValues(const std::vector<fs::path>& files, const Slices& slices, bool alike, std::uint64_t bytes,
                       const Monitor& monitor) {
  ChildStream stream("reading DICOM", [&](ChildOutput& out) { dicomModule().writeValues(files, slices, out); });
  auto buffer = std::make_shared<Buffer<char>>(bytes);
  const DicomSlice& first = slices.front();
  Buffer<char> stored(static_cast<std::size_t>(first.columns * first.rows * first.bits / 8));
  const std::uint64_t step = bytes / slices.size();
  for (std::size_t i = 0; i < slices.size(); ++i) {
    monitor.throwIfStopped();
    stream.read(stored);
    const std::span<char> to = std::span(*buffer).subspan(i * step, step);
    if (alike)
      std::copy(stored.begin(), stored.end(), to.begin());
    else
      scale(stored, slices[i], to);
    if (monitor.progress) monitor.progress("reading", static_cast<double>(i + 1) / static_cast<double>(slices.size()));
  }
  return {reinterpret_cast<const std::byte*>(buffer->data()), buffer};
}

}  // namespace

bool isDicom(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return suffixOf(path) == ".dcm";
  for (const auto& entry : fs::directory_iterator(path, ignored))
    if (beginsAsDicom(entry.path())) return true;
  return false;
}

VolumeHeader readDicomSeries(const fs::path& path, const VolumeReadOptions& options, const Monitor& monitor) {
  const std::vector<fs::path> files = filesOf(path);
  VolumeHeader header;
  DenseVolume& volume = header.volume;
  const Slices all = readSlices(files, monitor);
  notePassedOver(all, files.size(), volume);
  Slices slices = chooseSeries(all, options);
  const Order order = !arePlaced(slices)            ? Order::kNumbers
                      : areFramesOfOnePlace(slices) ? Order::kFrames
                                                    : Order::kPositions;
  checkAlike(slices, order != Order::kNumbers);
  std::int64_t times = 1;
  if (order == Order::kPositions) times = sortByPlace(slices);
  if (order == Order::kNumbers)
    std::stable_sort(slices.begin(), slices.end(),
                     [](const DicomSlice& a, const DicomSlice& b) { return a.instance < b.instance; });
  volume.format = "DICOM";
  const bool alike = isScaledAlike(slices);
  const DicomSlice& first = slices.front();
  volume.view.type = alike ? typeOf(first) : ScalarType::kFloat32;
  if (alike) volume.view.slope = first.slope, volume.view.intercept = first.intercept;
  std::vector<MemoryAxis> axes{{first.columns, 0}, {first.rows, 1}};
  if (times > 1) axes.push_back({times, MemoryAxis::kVolume});
  axes.push_back({static_cast<std::int64_t>(slices.size()) / times, 2});
  layOut(axes, options, header);
  place(slices, times, order, volume);
  header.loaded = readValues(files, slices, alike, header.data.bytes, monitor);
  return header;
}

}  // namespace pdc::detail
