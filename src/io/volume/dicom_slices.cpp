#include <fmt/format.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/file_error.h"
#include "io/volume/dicom_module.h"
#include "io/volume/header_text.h"
#include "pdc/error.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

using gdcm::DataSet;
using gdcm::Tag;
using gdcm::TransferSyntax;

const Tag kPixelData(0x7fe0, 0x0010);
constexpr double kUnsaid = std::numeric_limits<double>::quiet_NaN();

/// GDCM takes the memory that a length in a damaged file asks for, and writes zeros to all of it.
void limitMemory(std::uint64_t bytes) {
  std::ifstream usage("/proc/self/statm");
  std::uint64_t pages = 0;
  if (!(usage >> pages)) return;
  constexpr std::uint64_t kPageBytes = 4096, kSpare = std::uint64_t{1} << 29;
  const rlim_t most = pages * kPageBytes + kSpare + 4 * bytes;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// In the child process alone: what GDCM and its assertions say is not for users.
void beQuiet() {
  if (std::freopen("/dev/null", "w", stderr) == nullptr) std::fclose(stderr);
  gdcm::Trace::SetDebug(false);
  gdcm::Trace::SetWarning(false);
  gdcm::Trace::SetError(false);
}

std::string_view bytesOf(const DataSet& data, const Tag& tag) {
  if (!data.FindDataElement(tag)) return {};
  const gdcm::ByteValue* value = data.GetDataElement(tag).GetByteValue();
  if (value == nullptr || value->GetPointer() == nullptr) return {};
  return {value->GetPointer(), value->GetLength()};
}

/// Numbers in text with backslashes between them; those that are not said stay as they are.
void readReals(const DataSet& data, const Tag& tag, std::span<double> to) {
  std::string_view text = bytesOf(data, tag);
  if (text.empty()) return;
  for (double& number : to) {
    const std::size_t end = text.find('\\');
    std::string_view one = trimmed(text.substr(0, std::min(end, text.find('\0'))));
    if (one.starts_with('+')) one.remove_prefix(1);
    number = TextScanner::parse<double>(one).value_or(kUnsaid);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
}

double realOf(const DataSet& data, const Tag& tag, double otherwise) {
  double number = otherwise;
  readReals(data, tag, {&number, 1});
  return number;
}

std::int64_t countOf(const DataSet& data, const Tag& tag, std::int64_t otherwise) {
  const double number = realOf(data, tag, static_cast<double>(otherwise));
  constexpr double kMost = 2147483647;
  return std::abs(number) <= kMost ? static_cast<std::int64_t>(number) : otherwise;
}

std::int32_t shortOf(const DataSet& data, const Tag& tag, std::int32_t otherwise) {
  const std::string_view bytes = bytesOf(data, tag);
  std::uint16_t number = 0;
  if (bytes.size() < sizeof(number)) return otherwise;
  std::memcpy(&number, bytes.data(), sizeof(number));
  return number;
}

void copyText(const DataSet& data, const Tag& tag, std::array<char, 72>& to) {
  std::string_view text = bytesOf(data, tag);
  text = text.substr(0, std::min(text.find('\0'), to.size() - 1));
  while (text.ends_with(' ')) text.remove_suffix(1);
  std::copy(text.begin(), text.end(), to.begin());
}

/// The data of item `index`, from 0, of a sequence; nothing if it is not there.
std::optional<DataSet> itemOf(const DataSet& data, const Tag& tag, std::int64_t index) {
  if (!data.FindDataElement(tag)) return std::nullopt;
  const gdcm::SmartPointer<gdcm::SequenceOfItems> sequence = data.GetDataElement(tag).GetValueAsSQ();
  if (!sequence || index >= static_cast<std::int64_t>(sequence->GetNumberOfItems())) return std::nullopt;
  return sequence->GetItem(static_cast<gdcm::SequenceOfItems::SizeType>(index) + 1).GetNestedDataSet();
}

void readPlace(const DataSet& data, DicomSlice& slice) {
  readReals(data, Tag(0x0020, 0x0032), slice.position);
  readReals(data, Tag(0x0020, 0x0037), slice.orientation);
  readReals(data, Tag(0x0028, 0x0030), slice.spacing);
  slice.thickness = realOf(data, Tag(0x0018, 0x0050), slice.thickness);
  slice.between = realOf(data, Tag(0x0018, 0x0088), slice.between);
  slice.intercept = realOf(data, Tag(0x0028, 0x1052), slice.intercept);
  slice.slope = realOf(data, Tag(0x0028, 0x1053), slice.slope);
}

/// What groups of facts, which enhanced files have for all frames and for each one, say in the sequences in them.
void readGroups(const std::optional<DataSet>& groups, DicomSlice& slice) {
  if (!groups) return;
  for (const Tag& tag : {Tag(0x0020, 0x9113), Tag(0x0020, 0x9116), Tag(0x0028, 0x9110), Tag(0x0028, 0x9145)})
    if (const std::optional<DataSet> item = itemOf(*groups, tag, 0)) readPlace(*item, slice);
}

/// Puts the frames of a dose where its GridFrameOffsetVector says, along their normal.
void placeFrames(const DataSet& data, std::span<DicomSlice> frames) {
  std::vector<double> offsets(frames.size(), kUnsaid);
  readReals(data, Tag(0x3004, 0x000c), offsets);
  if (!std::all_of(offsets.begin(), offsets.end(), [](double o) { return std::isfinite(o); })) return;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    auto& [x, y, z] = frames[i].position;
    const auto& o = frames[i].orientation;
    const Vec3d normal = cross(Vec3d{o[0], o[1], o[2]}, Vec3d{o[3], o[4], o[5]});
    const Vec3d place = Vec3d{x, y, z} + normal * (offsets[i] - offsets[0]);
    frames[i].position = {place.x, place.y, place.z};
  }
}

void checkPixels(const DataSet& data, const DicomSlice& slice, bool packed, std::uint64_t fileBytes) {
  const std::int32_t samples = shortOf(data, Tag(0x0028, 0x0002), 1);
  if (samples != 1 || bytesOf(data, Tag(0x0028, 0x0004)).starts_with("PALETTE")) throw Error("colours are not read");
  if (slice.bits != 8 && slice.bits != 16 && slice.bits != 32)
    throw Error(fmt::format("DICOM values of {} bits are not read", slice.bits));
  const std::int32_t highest = shortOf(data, Tag(0x0028, 0x0102), slice.storedBits - 1);
  if (slice.storedBits < 1 || slice.storedBits > slice.bits || highest != slice.storedBits - 1)
    throw Error(fmt::format("DICOM values with {} of {} bits up to bit {} are not read", slice.storedBits, slice.bits,
                            highest));
  // Slices of one value are packed better than most; their headers are long, though.
  constexpr std::uint64_t kMostRatio = 4096;
  const std::uint64_t most = packed ? kMostRatio * fileBytes : fileBytes;
  const auto pixels = static_cast<std::uint64_t>(slice.columns * slice.rows);
  if (slice.frames < 1 || static_cast<std::uint64_t>(slice.frames) > most / pixels)
    throw Error(fmt::format("ends early: {} frames of {} x {} values are not in {} bytes", slice.frames, slice.columns,
                            slice.rows, fileBytes));
}

/// Appends the slices of a file that was read up to its values.
void addSlices(const gdcm::File& file, std::uint64_t fileBytes, DicomSlice slice, std::vector<DicomSlice>& slices) {
  const DataSet& data = file.GetDataSet();
  slice.rows = shortOf(data, Tag(0x0028, 0x0010), 0);
  slice.columns = shortOf(data, Tag(0x0028, 0x0011), 0);
  if (slice.rows == 0 || slice.columns == 0) return;
  slice.frames = countOf(data, Tag(0x0028, 0x0008), 1);
  slice.bits = shortOf(data, Tag(0x0028, 0x0100), 0);
  slice.storedBits = shortOf(data, Tag(0x0028, 0x0101), slice.bits);
  slice.isSigned = shortOf(data, Tag(0x0028, 0x0103), 0) == 1 ? 1 : 0;
  const TransferSyntax& syntax = file.GetHeader().GetDataSetTransferSyntax();
  checkPixels(data, slice, syntax.IsEncapsulated() || syntax == TransferSyntax::DeflatedExplicitVRLittleEndian,
              fileBytes);
  copyText(data, Tag(0x0020, 0x000e), slice.series);
  copyText(data, Tag(0x0008, 0x103e), slice.description);
  slice.seriesNumber = countOf(data, Tag(0x0020, 0x0011), 0);
  slice.instance = countOf(data, Tag(0x0020, 0x0013), 0);
  slice.position.fill(kUnsaid);
  slice.orientation.fill(kUnsaid);
  slice.spacing.fill(kUnsaid);
  slice.between = slice.thickness = kUnsaid;
  readPlace(data, slice);
  slice.slope = realOf(data, Tag(0x3004, 0x000e), slice.slope);  // DoseGridScaling.
  readGroups(itemOf(data, Tag(0x5200, 0x9229), 0), slice);
  for (slice.frame = 0; slice.frame < slice.frames; ++slice.frame) {
    DicomSlice one = slice;
    readGroups(itemOf(data, Tag(0x5200, 0x9230), slice.frame), one);
    if (!std::isfinite(one.slope) || one.slope == 0 || !std::isfinite(one.intercept)) one.slope = 1, one.intercept = 0;
    slices.push_back(one);
  }
  placeFrames(data, std::span(slices).last(static_cast<std::size_t>(slice.frames)));
}

template <typename Number>
void spreadSign(std::span<char> values, const DicomSlice& slice) {
  using Bits = std::make_unsigned_t<Number>;
  const int free = slice.bits - slice.storedBits;
  for (std::size_t at = 0; at + sizeof(Number) <= values.size(); at += sizeof(Number)) {
    Bits bits = 0;
    std::memcpy(&bits, values.data() + at, sizeof(bits));
    const auto high = static_cast<Bits>(bits << free);
    const Bits value =
        slice.isSigned != 0 ? static_cast<Bits>(static_cast<Number>(high) >> free) : static_cast<Bits>(high >> free);
    std::memcpy(values.data() + at, &value, sizeof(value));
  }
}

void spreadSigns(std::span<char> values, const DicomSlice& slice) {
  if (slice.storedBits == slice.bits) return;
  if (slice.bits == 8) spreadSign<std::int8_t>(values, slice);
  if (slice.bits == 16) spreadSign<std::int16_t>(values, slice);
  if (slice.bits == 32) spreadSign<std::int32_t>(values, slice);
}

void swapWords(std::span<char> values) {
  for (std::size_t at = 0; at + 4 <= values.size(); at += 4)
    std::swap_ranges(&values[at], &values[at] + 2, &values[at] + 2);
}

/// Whether a file ends within its values, which GDCM would make zeros. \param bytes how many there are, not compressed.
bool endsEarly(const fs::path& path, std::size_t bytes) {
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  constexpr std::string_view kTag("\xe0\x7f\x10\x00", 4);
  for (std::size_t at = content.find(kTag); at != std::string::npos; at = content.find(kTag, at + 1)) {
    // The length follows the tag, or a type of two letters and two bytes of nothing.
    for (const std::size_t before : {kTag.size(), kTag.size() + 4}) {
      std::uint32_t length = 0;
      if (at + before + sizeof(length) > content.size()) continue;
      std::memcpy(&length, content.data() + at + before, sizeof(length));
      if (length - bytes <= 1) return content.size() - (at + before + sizeof(length)) < bytes;
    }
  }
  return false;
}

/// All frames of a file.
void decode(const fs::path& path, const DicomSlice& slice, Buffer<char>& values) {
  gdcm::ImageReader reader;
  reader.SetFileName(path.c_str());
  if (!reader.Read()) throw Error("its values cannot be decoded");
  const gdcm::Image& image = reader.GetImage();
  const auto bytes = static_cast<std::size_t>(slice.columns * slice.rows * slice.frames * (slice.bits / 8));
  const bool fits = static_cast<std::int64_t>(image.GetColumns()) == slice.columns &&
                    static_cast<std::int64_t>(image.GetRows()) == slice.rows && image.GetBufferLength() == bytes;
  values.resize(bytes);
  if (endsEarly(path, bytes)) throw Error("ends early");
  if (!fits || !image.GetBuffer(values.data())) throw Error("its values cannot be decoded");
  // GDCM turns the bytes of words of 16 bits, also where values have 32.
  if (slice.bits == 32 &&
      reader.GetFile().GetHeader().GetDataSetTransferSyntax() == TransferSyntax::ExplicitVRBigEndian)
    swapWords(values);
  spreadSigns(values, slice);
}

/// Calls f(), and says which of several files it failed on.
template <typename F>
void naming(const std::vector<fs::path>& files, std::size_t i, const F& f) {
  if (files.size() == 1) return f();
  try {
    f();
  } catch (const Error& error) {
    throw fileError(files[i].filename(), error.what());
  }
}

void writeDicomSlices(const std::vector<fs::path>& files, ChildOutput& out) {
  beQuiet();
  std::uintmax_t largest = 0;
  for (const fs::path& file : files) largest = std::max(largest, fs::file_size(file));
  limitMemory(largest);
  std::vector<DicomSlice> slices;
  for (std::size_t i = 0; i < files.size(); ++i)
    naming(files, i, [&] {
      gdcm::Reader reader;
      reader.SetFileName(files[i].c_str());
      if (!reader.ReadUpToTag(kPixelData)) throw Error("not DICOM, or damaged");
      DicomSlice slice;
      slice.file = static_cast<std::int64_t>(i);
      addSlices(reader.GetFile(), fs::file_size(files[i]), slice, slices);
    });
  const auto count = static_cast<std::int64_t>(slices.size());
  out.write(&count, sizeof(count));
  out.write(slices.data(), slices.size() * sizeof(DicomSlice));
}

void writeDicomValues(const std::vector<fs::path>& files, std::span<const DicomSlice> slices, ChildOutput& out) {
  beQuiet();
  std::int64_t decoded = -1;
  std::uint64_t most = 0;
  for (const DicomSlice& slice : slices)
    most = std::max(most, fs::file_size(files[static_cast<std::size_t>(slice.file)]) +
                              static_cast<std::uint64_t>(slice.columns * slice.rows * slice.frames * slice.bits / 8));
  limitMemory(most);
  Buffer<char> values;
  for (const DicomSlice& slice : slices) {
    const auto file = static_cast<std::size_t>(slice.file);
    if (slice.file != decoded) naming(files, file, [&] { decode(files[file], slice, values); });
    decoded = slice.file;
    const std::size_t bytes = values.size() / static_cast<std::size_t>(slice.frames);
    out.write(values.data() + static_cast<std::size_t>(slice.frame) * bytes, bytes);
  }
}

}  // namespace
}  // namespace pdc::detail

const pdc::detail::DicomModule pdcDicomModule{&pdc::detail::writeDicomSlices, &pdc::detail::writeDicomValues};
