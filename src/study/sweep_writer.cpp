#include "pdc/study/sweep_writer.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <stdexcept>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "study/page_text.h"
#include "study/sweep_columns.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

constexpr auto kTable = "sweep.csv", kReport = "sweep.json", kPage = "index.html";

void writeText(const std::string& text, const fs::path& path) {
  detail::AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

/// A number that reads back to the same; JSON has no infinity, so that becomes the string "inf".
std::string jsonNumber(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "\"inf\""; }

}  // namespace

std::string sweepCsv(const Sweep& sweep) {
  const std::string swept = namesOf(sweep.parameter).key;
  std::string csv = swept;
  for (const detail::SweepColumn& column : detail::sweepColumns())
    if (column.key != swept) csv += fmt::format(",{}", column.key);
  csv += "\n";
  for (const SweepStep& step : sweep.steps) {
    csv += fmt::format("{}", step.value);
    for (const detail::SweepColumn& column : detail::sweepColumns()) {
      if (column.key == swept) continue;
      const auto value = column.get(step);
      csv += value ? fmt::format(",{}", *value) : ",";
    }
    csv += "\n";
  }
  return csv;
}

std::string sweepJson(const Sweep& sweep, const SweepDescription& description) {
  const std::string swept = namesOf(sweep.parameter).key;
  std::string json = fmt::format(
      "{{\n  \"title\": {},\n  \"command\": {},\n  \"parameter\": \"{}\",\n  \"length_unit\": \"voxel\",\n"
      "  \"seconds_sample\": {},\n  \"normal_noise\": {},\n  \"recommended\": {},\n  \"reason\": {},\n  \"steps\": [",
      detail::jsonText(description.title), detail::jsonText(description.command), swept,
      jsonNumber(sweep.secondsSample), jsonNumber(sweep.normalNoise),
      sweep.recommended ? jsonNumber(sweep.steps[*sweep.recommended].value) : "null", detail::jsonText(sweep.reason));
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const SweepStep& step = sweep.steps[i];
    json += fmt::format("{}\n    {{\"{}\": {}", i > 0 ? "," : "", swept, jsonNumber(step.value));
    for (const detail::SweepColumn& column : detail::sweepColumns()) {
      if (column.key == swept) continue;
      const auto value = column.get(step);
      json += fmt::format(", \"{}\": {}", column.key, value ? jsonNumber(*value) : "null");
    }
    json += "}";
  }
  return json + "\n  ]\n}\n";
}

void makeSweepFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (!fs::is_directory(folder))
    throw detail::fileError(folder, "cannot be made a folder", error ? error.value() : ENOTDIR);
  for (const char* name : {kTable, kReport, kPage}) detail::checkWritable(folder / name);
}

void writeSweep(const Sweep& sweep, const SweepDescription& description, const fs::path& folder) {
  if (!description.pictures.empty() && description.pictures.size() != sweep.steps.size())
    throw std::invalid_argument(
        fmt::format("writeSweep: {} pictures for {} steps", description.pictures.size(), sweep.steps.size()));
  writeText(sweepCsv(sweep), folder / kTable);
  writeText(sweepJson(sweep, description), folder / kReport);
  writeText(sweepPage(sweep, description), folder / kPage);
}

}  // namespace pdc
