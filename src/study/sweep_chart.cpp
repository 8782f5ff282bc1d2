#include "study/sweep_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/sweep_columns.h"

namespace pdc::detail {
namespace {

constexpr double kWidth = 480, kHeight = 280, kLeft = 68, kRight = 14, kTop = 14, kBottom = 46;

bool known(const Sweep& sweep, const std::string& key) {
  const SweepColumn& column = sweepColumn(key);
  return std::any_of(sweep.steps.begin(), sweep.steps.end(),
                     [&](const SweepStep& s) { return column.get(s).has_value(); });
}

/// The distance of ticks: 1, 2 or 5 times a power of ten, so that about four of them make `range`.
double tickStep(double range) {
  const double raw = range / 4, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (raw <= digit * power) return digit * power;
  return 10 * power;
}

/// Where values lie in the picture.
struct Axes {
  Axes(std::size_t steps, double largest)
      : tick(largest > 0 ? tickStep(largest) : 1), top(std::max(1.0, std::ceil(largest / tick)) * tick), count(steps) {}

  [[nodiscard]] double x(std::size_t i) const {
    const double room = kWidth - kLeft - kRight;
    return kLeft + room * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  }
  [[nodiscard]] double y(double value) const { return kHeight - kBottom - (kHeight - kTop - kBottom) * value / top; }

  double tick, top;
  std::size_t count;
};

std::string axesSvg(const Sweep& sweep, const SweepChart& chart, const Axes& axes) {
  std::string svg;
  for (int i = 0; i * axes.tick <= axes.top * 1.0001; ++i) {
    const double y = axes.y(i * axes.tick);
    svg += fmt::format(R"(<line class="grid" x1="{}" x2="{}" y1="{:.1f}" y2="{:.1f}"/>)", kLeft, kWidth - kRight, y, y);
    svg += fmt::format(R"(<text x="{}" y="{:.1f}" text-anchor="end">{}</text>)", kLeft - 6, y + 4,
                       sweepNumber(i * axes.tick));
  }
  for (std::size_t i = 0; i < sweep.steps.size(); ++i)
    svg += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", axes.x(i), kHeight - kBottom + 18,
                       sweepNumber(sweep.steps[i].value));
  svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", (kWidth + kLeft - kRight) / 2,
                     kHeight - 8, namesOf(sweep.parameter).label);
  svg += fmt::format(R"_(<text transform="translate(13 {}) rotate(-90)" text-anchor="middle">{}</text>)_",
                     (kHeight - kBottom + kTop) / 2, chart.unit);
  svg += fmt::format(R"(<line class="axis" x1="{0}" x2="{1}" y1="{2}" y2="{2}"/>)", kLeft, kWidth - kRight,
                     kHeight - kBottom);
  return svg;
}

std::string curveSvg(const Sweep& sweep, const SweepColumn& column, std::size_t number, const Axes& axes) {
  std::string points, dots;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const auto value = column.get(sweep.steps[i]);
    if (!value) continue;
    points += fmt::format("{:.1f},{:.1f} ", axes.x(i), axes.y(*value));
    dots += fmt::format(R"(<circle class="c{}" cx="{:.1f}" cy="{:.1f}" r="3.5"><title>{}: {}</title></circle>)", number,
                        axes.x(i), axes.y(*value), column.label, sweepNumber(*value));
  }
  return fmt::format(R"(<polyline class="c{}" points="{}"/>{})", number, points, dots);
}

}  // namespace

std::vector<SweepChart> sweepCharts(const Sweep& sweep) {
  std::vector<SweepChart> charts{
      {"Distance to the truth", "voxels", {"vertex_rms", "crease_rms"}},
      {"Roughness of flat parts", "voxels", {"roughness"}},
      {"Smallest angles of triangles", "degrees", {"min_angle_p1", "min_angle_p5", "min_angle_p50"}},
      {"Vertices", "count", {"out_of_cell", "moved"}},
      {"Self-intersections", "pairs", {"self_intersections"}},
      {"Time", "seconds", {"seconds"}}};
  if (sweep.parameter == SweepParameter::kAdaptive)
    charts.insert(charts.begin(),
                  {{"Triangles", "count", {"triangles"}}, {"Distance to the full mesh", "voxels", {"adapted_max"}}});
  for (SweepChart& chart : charts) std::erase_if(chart.keys, [&](const auto& key) { return !known(sweep, key); });
  std::erase_if(charts, [](const SweepChart& chart) { return chart.keys.empty(); });
  return charts;
}

std::string sweepChartSvg(const Sweep& sweep, const SweepChart& chart) {
  double largest = 0;
  for (const std::string& key : chart.keys)
    for (const SweepStep& step : sweep.steps) largest = std::max(largest, sweepColumn(key).get(step).value_or(0));
  const Axes axes(sweep.steps.size(), largest);
  std::string svg =
      fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kWidth, kHeight, chart.title);
  const double first = axes.x(0), step = sweep.steps.size() > 1 ? axes.x(1) - first : 0;
  svg += fmt::format(
      R"(<line class="now" data-first="{0:.1f}" data-step="{1:.2f}" x1="{0:.1f}" x2="{0:.1f}" y1="{2}" y2="{3}"/>)",
      first, step, kTop, kHeight - kBottom);
  svg += axesSvg(sweep, chart, axes);
  for (std::size_t i = 0; i < chart.keys.size(); ++i) svg += curveSvg(sweep, sweepColumn(chart.keys[i]), i, axes);
  return svg + "</svg>";
}

}  // namespace pdc::detail
