#include <fmt/format.h>

#include "pdc/io/png_writer.h"
#include "pdc/study/sweep_writer.h"
#include "study/page_text.h"
#include "study/sweep_chart.h"
#include "study/sweep_columns.h"

namespace pdc {
namespace {

constexpr auto kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<style>
:root { --back: #fbfbf9; --text: #1d1d1b; --faint: #6a6a66; --line: #d9d9d4; --mark: #f0e6c8;
  --c0: #1f63a8; --c1: #b8500f; --c2: #2f7d42; }
@media (prefers-color-scheme: dark) { :root { --back: #161615; --text: #e8e8e3; --faint: #a3a39c; --line: #3a3a37;
  --mark: #46401f; --c0: #74b3f0; --c1: #f0985c; --c2: #79c98c; } img { filter: brightness(.88); } }
body { background: var(--back); color: var(--text); font: 16px/1.45 system-ui, sans-serif; margin: 0 auto;
  max-width: 1100px; padding: 16px; }
h1 { font-size: 1.5rem; margin: .3em 0; } h2 { font-size: 1.1rem; margin: 1.6em 0 .5em; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; border: 1px solid var(--line); border-radius: 6px; padding: 10px; }
.stage { display: grid; gap: 12px; justify-items: center; }
.stage img { width: min(100%, 560px); border-radius: 6px; }
.stage label { display: block; width: min(100%, 560px); }
.stage input { width: 100%; height: 32px; margin: 0; }
output { font-variant-numeric: tabular-nums; font-weight: 600; }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(130px, 1fr)); gap: 10px; }
.sheet button { all: unset; cursor: pointer; display: block; text-align: center; border-radius: 6px; padding: 4px; }
.sheet button:focus-visible { outline: 2px solid var(--c0); }
.sheet img { width: 100%; height: auto; border-radius: 4px; display: block; }
.chosen, .sheet .chosen, tr.chosen td:first-child { background: var(--mark); }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 330px), 1fr)); gap: 18px; }
figure { margin: 0; } figcaption { font-weight: 600; }
.key { font-weight: 400; font-size: .85rem; color: var(--faint); display: block; }
svg { width: 100%; height: auto; display: block; } svg text { fill: var(--faint); font-size: 14px; }
.grid { stroke: var(--line); } .axis { stroke: var(--faint); } .now { stroke: var(--mark); stroke-width: 22; }
polyline { fill: none; stroke-width: 2; }
polyline.c0 { stroke: var(--c0); } polyline.c1 { stroke: var(--c1); } polyline.c2 { stroke: var(--c2); }
circle.c0 { fill: var(--c0); } circle.c1 { fill: var(--c1); } circle.c2 { fill: var(--c2); }
b.c0 { color: var(--c0); } b.c1 { color: var(--c1); } b.c2 { color: var(--c2); }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 8px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { vertical-align: bottom; font-weight: 600; white-space: normal; min-width: 5.5em; }
td:first-child, th:first-child { position: sticky; left: 0; background: var(--back); min-width: 3em; font-weight: 600; }
</style>
)";

constexpr auto kScript = R"(<script>
const all = (what) => [...document.querySelectorAll(what)];
const slider = document.getElementById('step');
function choose(i) {
  slider.value = i;
  const pictures = all('.sheet img');
  if (pictures[i]) document.getElementById('picture').src = pictures[i].src;
  document.getElementById('value').textContent = slider.dataset.values.split(' ')[i];
  all('.sheet button').forEach((e, k) => e.classList.toggle('chosen', k === i));
  all('tbody tr').forEach((e, k) => e.classList.toggle('chosen', k === i));
  all('.now').forEach((e) => {
    const x = Number(e.dataset.first) + i * Number(e.dataset.step);
    e.setAttribute('x1', x); e.setAttribute('x2', x);
  });
}
slider.addEventListener('input', () => choose(Number(slider.value)));
all('.sheet button').forEach((e, k) => e.addEventListener('click', () => choose(k)));
choose(Number(slider.value));
</script>
)";

std::string pictures(const Sweep& sweep, const SweepDescription& description) {
  const std::string label = namesOf(sweep.parameter).label;
  std::string values, sheet;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const std::string value = detail::sweepNumber(sweep.steps[i].value);
    values += (i > 0 ? " " : "") + value;
    if (description.pictures.empty()) continue;
    const Image& picture = description.pictures[i];
    sheet += fmt::format(
        R"(<button type="button"><img alt="{0} = {1}" width="{2}" height="{3}" src="data:image/png;base64,{4}">{0} = {1}</button>)"
        "\n",
        label, value, picture.width, picture.height, detail::base64(encodePng(picture)));
  }
  const std::string picture = sheet.empty() ? "" : R"(<img id="picture" alt="the mesh at the chosen value">)";
  return fmt::format(
      R"(<div class="stage">{}<label>{} = <output id="value"></output><input id="step" type="range" min="0" max="{}" value="{}" data-values="{}"></label></div>)"
      "\n<h2>All values</h2>\n<div class=\"sheet\">\n{}</div>\n",
      picture, label, sweep.steps.size() - 1, sweep.recommended.value_or(0), values, sheet);
}

std::string charts(const Sweep& sweep) {
  std::string html = "<h2>Curves</h2>\n<div class=\"charts\">\n";
  for (const detail::SweepChart& chart : detail::sweepCharts(sweep)) {
    std::string key;
    for (std::size_t i = 0; i < chart.keys.size(); ++i)
      key += fmt::format(R"({}<b class="c{}">●</b> {})", i > 0 ? " &nbsp; " : "", i,
                         detail::sweepColumn(chart.keys[i]).label);
    html += fmt::format("<figure><figcaption>{}<span class=\"key\">{}</span></figcaption>\n{}</figure>\n", chart.title,
                        key, detail::sweepChartSvg(sweep, chart));
  }
  return html + "</div>\n";
}

std::string table(const Sweep& sweep) {
  std::string html = fmt::format("<h2>Figures</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>{}</th>",
                                 namesOf(sweep.parameter).label);
  for (const detail::SweepColumn& column : detail::sweepColumns()) html += fmt::format("<th>{}</th>", column.label);
  html += "</tr></thead>\n<tbody>\n";
  for (const SweepStep& step : sweep.steps) {
    html += fmt::format("<tr><td>{}</td>", detail::sweepNumber(step.value));
    for (const detail::SweepColumn& column : detail::sweepColumns()) {
      const auto value = column.get(step);
      html += fmt::format("<td>{}</td>", value ? detail::sweepNumber(*value) : "–");
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string sweepPage(const Sweep& sweep, const SweepDescription& description) {
  const std::string title = detail::htmlText(description.title);
  std::string html = fmt::format("{}<title>{}</title>\n</head>\n<body>\n<h1>{}</h1>\n<p id=\"reason\">{}</p>\n", kHead,
                                 title, title, detail::htmlText(sweep.reason));
  html += pictures(sweep, description) + charts(sweep) + table(sweep);
  html += fmt::format("<h2>Made by</h2>\n<pre>{}</pre>\n{}</body>\n</html>\n", detail::htmlText(description.command),
                      kScript);
  return html;
}

}  // namespace pdc
