#include "reports/volume_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "io/open_volume.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;
using Pixel = std::array<std::uint8_t, 3>;

constexpr int kShownBins = 16;

const char* nameOf(ScalarType type) {
  switch (type) {
    case ScalarType::kBool:
      return "bool";
    case ScalarType::kInt8:
      return "int8";
    case ScalarType::kUint8:
      return "uint8";
    case ScalarType::kInt16:
      return "int16";
    case ScalarType::kUint16:
      return "uint16";
    case ScalarType::kInt32:
      return "int32";
    case ScalarType::kUint32:
      return "uint32";
    case ScalarType::kInt64:
      return "int64";
    case ScalarType::kUint64:
      return "uint64";
    case ScalarType::kFloat16:
      return "float16";
    case ScalarType::kFloat32:
      return "float32";
    case ScalarType::kFloat64:
      return "float64";
  }
  return "";
}

/// The counts in fewer bins, of equal width but for rounding.
std::vector<std::uint64_t> inBins(const std::vector<std::uint64_t>& counts, std::size_t bins) {
  std::vector<std::uint64_t> sums(bins);
  for (std::size_t i = 0; i < counts.size(); ++i) sums[i * bins / counts.size()] += counts[i];
  return sums;
}

void addPlace(const DenseVolume& volume, Json& facts) {
  const Vec3d& t = volume.translation;
  Json spacing = Json::array();
  for (int axis = 0; axis < 3; ++axis) spacing.push_back(length(volume.linear.column(axis)));
  facts["spacing"] = std::move(spacing);
  facts["spacing_known"] = volume.spacingKnown;
  facts["unit"] = volume.unit;
  facts["space"] = volume.space;
  facts["orientation"] = volume.orientation;
  for (int row = 0; row < 3; ++row) {
    const Vec3d& r = volume.linear.row[static_cast<std::size_t>(row)];
    facts[std::array{"world_x", "world_y", "world_z"}[static_cast<std::size_t>(row)]] = {r.x, r.y, r.z, t[row]};
  }
  facts["mirrored"] = volume.linear.determinant() < 0;
}

std::string suggestedCommand(const std::filesystem::path& path, double iso) {
  std::string stem = path.stem().string();
  if (const std::size_t dot = stem.find('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
  return fmt::format("pdc mesh {} {}.ply --iso {:.6g}", path.string(), stem, iso);
}

}  // namespace

VolumeFacts gatherVolumeFacts(const std::filesystem::path& path, const VolumeReadOptions& options,
                              const Monitor& monitor) {
  const detail::OpenedVolume opened =
      detail::openVolume(path, {.read = options, .source = {.acceptNonFinite = true}}, monitor);
  const DenseVolume& volume = opened.volume;
  constexpr int kBins = 1024;
  VolumeFacts result;
  result.histogram = valueHistogram(volume.view, kBins, monitor);
  result.threshold = otsuThreshold(result.histogram);
  Json& facts = result.facts;
  facts = {{"kind", "volume"},
           {"format", volume.format},
           {"encoding", volume.encoding},
           {"size", volume.view.size},
           {"value_type", nameOf(volume.view.type)},
           {"slope", volume.view.slope},
           {"intercept", volume.view.intercept}};
  addPlace(volume, facts);
  const GridMeaning& meaning = opened.source->meaning();
  facts["value_min"] = result.histogram.lowest;
  facts["value_max"] = result.histogram.highest;
  facts["non_finite"] = result.histogram.nonFinite;
  facts["read_as"] = nameOf(meaning.gridClass);
  facts["inside"] = nameOf(meaning.inside);
  facts["iso"] = opened.source->iso();
  if (result.threshold) {
    facts["otsu"] = result.threshold->value;
    facts["otsu_separation"] = result.threshold->separation;
  }
  facts["histogram"] = inBins(result.histogram.count, kShownBins);
  facts["warnings"] = opened.warnings;
  if (result.histogram.lowest < result.histogram.highest)
    facts["command"] = suggestedCommand(path, opened.source->iso());
  return result;
}

void printHistogram(const nlohmann::ordered_json& facts) {
  const auto counts = facts.at("histogram").get<std::vector<std::uint64_t>>();
  const double low = facts.at("value_min"), high = facts.at("value_max");
  const std::uint64_t most = *std::max_element(counts.begin(), counts.end());
  if (most == 0) return;
  constexpr double kWidth = 50;
  fmt::print("\n{:>12}  values from there on; bars are logarithms\n", "from");
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double share = std::log1p(static_cast<double>(counts[i])) / std::log1p(static_cast<double>(most));
    const double from = low + (high - low) * static_cast<double>(i) / static_cast<double>(counts.size());
    fmt::print("{:>12.6g}  {:>12}  {}\n", from, counts[i],
               std::string(static_cast<std::size_t>(std::lround(kWidth * share)), '#'));
  }
}

Image drawHistogram(const ValueHistogram& histogram, const std::optional<OtsuThreshold>& threshold) {
  constexpr int kWidth = 1024, kHeight = 512;
  constexpr Pixel kWhite{255, 255, 255}, kLight{190, 205, 225}, kDark{40, 80, 140}, kRed{210, 40, 40};
  Image image{kWidth, kHeight, std::vector<Pixel>(std::size_t{kWidth} * kHeight, kWhite)};
  constexpr std::size_t kBins = 256;
  const std::vector<std::uint64_t> counts = inBins(histogram.count, kBins);
  const auto most = static_cast<double>(std::max<std::uint64_t>(*std::max_element(counts.begin(), counts.end()), 1));
  const auto fill = [&](int x, double share, const Pixel& colour) {
    const int top = kHeight - static_cast<int>(std::lround(share * (kHeight - 1)));
    for (int y = top; y < kHeight; ++y) image.pixels[static_cast<std::size_t>(y * kWidth + x)] = colour;
  };
  for (int x = 0; x < kWidth; ++x) {
    const auto count = static_cast<double>(counts[static_cast<std::size_t>(x) * kBins / kWidth]);
    fill(x, std::log1p(count) / std::log1p(most), kLight);
    fill(x, count / most, kDark);
  }
  if (threshold && histogram.highest > histogram.lowest) {
    const double share = (threshold->value - histogram.lowest) / (histogram.highest - histogram.lowest);
    fill(std::clamp(static_cast<int>(std::lround(share * kWidth)), 0, kWidth - 1), 1.0, kRed);
  }
  return image;
}

}  // namespace pdc
