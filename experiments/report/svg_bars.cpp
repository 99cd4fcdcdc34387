#include "experiments/report/svg_bars.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/report/axis.h"
#include "experiments/report/svg_style.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

constexpr double kWidth = 640.0, kRight = 92.0, kTop = 36.0;
constexpr double kBarRow = 30.0, kBar = 20.0;
constexpr double kLongestName = 230.0;

double sum(const BarsSpec::Row& row) {
  double total = 0.0;
  for (const auto& part : row.parts) total += part.second;
  return total;
}

// Returns the parts' names in order of first appearance; the index of each selects its colour.
std::vector<std::string> partNames(const BarsSpec& bars) {
  std::vector<std::string> names;
  for (const BarsSpec::Row& row : bars.rows) {
    for (const auto& part : row.parts) {
      if (std::find(names.begin(), names.end(), part.first) == names.end()) {
        names.push_back(part.first);
      }
    }
  }
  return names;
}

// Beyond the palette the colours repeat with stripes of the background.
std::string box(double x, double y, double width, double height, size_t index,
                const std::string& tip) {
  std::string out = fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#ffffff\" "
      "stroke-width=\"0.75\" class=\"part p{}\"><title>{}</title></rect>\n",
      svg::coordinate(x), svg::coordinate(y), svg::coordinate(width), svg::coordinate(height),
      svg::passColour(index), index % svg::kPassColours, escapeMarkup(tip));
  const size_t round = index / svg::kPassColours;
  for (size_t i = 1; i <= round; ++i) {
    const double at = y + height * double(i) / double(round + 1);
    out += fmt::format(
        "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"#ffffff\" stroke-width=\"2\" "
        "class=\"stripe\"/>\n",
        svg::coordinate(x), svg::coordinate(at), svg::coordinate(x + width), svg::coordinate(at));
  }
  return out;
}

}  // namespace

std::string barsSvg(const BarsSpec& bars) {
  const std::vector<std::string> names = partNames(bars);
  double longest = 0.0, left = 40.0;
  for (const BarsSpec::Row& row : bars.rows) {
    longest = std::max(longest, sum(row));
    left = std::max(left, std::min(kLongestName, svg::textWidth(row.name, 12.0)) + 22.0);
  }
  Axis axis;
  axis.hi = longest > 0.0 ? longest : 1.0;
  const double span = kWidth - kRight - left;
  const double bottom = kTop + kBarRow * double(bars.rows.size());

  // Arrange the legend in as many columns as its longest entry allows.
  double entry = 60.0;
  for (const std::string& name : names) {
    entry = std::max(entry, std::min(kLongestName, svg::textWidth(name, 12.0)) + 34.0);
  }
  const size_t columns = std::max<size_t>(1, size_t((kWidth - 24.0) / entry));
  const double legendTop = bottom + 50.0;
  const size_t legendRows = (names.size() + columns - 1) / columns;
  const double height = legendTop + svg::kLegendRow * double(legendRows) + 2.0;

  std::string out = svg::open(kWidth, height, bars.title, "bars");
  out += svg::text(12.0, 22.0, "start", svg::fitText(bars.title, kWidth - 24.0, 14.5),
                   "font-size=\"14\" font-weight=\"bold\"");
  for (const Tick& tick : axisTicks(axis)) {
    const double x = left + span * axis.position(tick.value);
    out += svg::line(x, kTop, x, bottom, "grid");
    out += svg::text(x, bottom + 16.0, "middle", tick.label, "class=\"tick\"");
  }
  out += svg::text(left + span / 2.0, bottom + 33.0, "middle", bars.unit);
  for (size_t i = 0; i < bars.rows.size(); ++i) {
    const BarsSpec::Row& row = bars.rows[i];
    const double top = kTop + kBarRow * double(i) + (kBarRow - kBar) / 2.0;
    out += svg::text(left - 8.0, top + kBar / 2.0 + 4.0, "end",
                     svg::fitText(row.name, kLongestName, 12.0));
    double x = left;
    for (const auto& [name, value] : row.parts) {
      const double width = span * value / axis.hi;
      const size_t index = size_t(std::find(names.begin(), names.end(), name) - names.begin());
      out += box(x, top, width, kBar, index,
                 fmt::format("{}, {}: {} {}", row.name, name, shortNumber(value), bars.unit));
      x += width;
    }
    out += svg::text(x + 6.0, top + kBar / 2.0 + 4.0, "start",
                     fmt::format("{} {}", shortNumber(sum(row)), bars.unit));
  }
  out += svg::line(left, kTop, left, bottom, "frame");
  for (size_t i = 0; i < names.size(); ++i) {
    const double x = 12.0 + entry * double(i % columns);
    const size_t row = i / columns;
    const double y = legendTop + svg::kLegendRow * double(row);
    out += box(x, y - 10.0, 14.0, 12.0, i, names[i]);
    out += svg::text(x + 20.0, y, "start", svg::fitText(names[i], kLongestName, 12.0));
  }
  return out + "</svg>\n";
}

BarsSpec barsFromModel(const ReportModel& model) {
  BarsSpec bars;
  bars.title = reportText(model, "title");
  bars.unit = reportText(model, "unit");
  for (const ReportModel& from : model["rows"]) {
    BarsSpec::Row& row = bars.rows.emplace_back();
    row.name = reportText(from, "name");
    for (const ReportModel& part : from["parts"]) {
      row.parts.emplace_back(part[0].get<std::string>(), reportNumber(part[1]));
    }
  }
  return bars;
}

}  // namespace restlab
