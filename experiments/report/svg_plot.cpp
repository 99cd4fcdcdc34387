#include "experiments/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/report/svg_style.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

constexpr double kLegendTop = 56.0;
constexpr double kNameWidth = 330.0;

struct Canvas {
  Axis x, y;

  double px(double value) const {
    return kPlotArea.left + kPlotArea.width * std::clamp(x.position(value), 0.0, 1.0);
  }
  double py(double value) const {
    return kPlotArea.top + kPlotArea.height * (1.0 - std::clamp(y.position(value), 0.0, 1.0));
  }
  bool shows(const PlotPoint& point) const { return x.shows(point.x) && y.shows(point.y); }
};

std::vector<PlotPoint> shownPoints(const Canvas& canvas, const PlotSeries& series) {
  std::vector<PlotPoint> shown;
  for (const PlotPoint& point : series.points) {
    if (canvas.shows(point)) shown.push_back(point);
  }
  return shown;
}

// Draws a tick's label; an exponent is raised.
std::string tickLabel(double x, double y, const char* anchor, const Tick& tick) {
  if (tick.exponent.empty()) return svg::text(x, y, anchor, tick.label, "class=\"tick\"");
  return fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" class=\"tick\">{}<tspan dy=\"-4.5\" "
      "font-size=\"9\">{}</tspan></text>\n",
      svg::coordinate(x), svg::coordinate(y), anchor, tick.label, tick.exponent);
}

std::string axes(const Canvas& canvas, const PlotSpec& plot) {
  const double left = kPlotArea.left, right = left + kPlotArea.width;
  const double top = kPlotArea.top, bottom = top + kPlotArea.height;
  std::string grid, labels;
  for (const Tick& tick : axisTicks(canvas.x)) {
    const double at = canvas.px(tick.value);
    grid += svg::line(at, top, at, bottom, tick.label.empty() ? "fine" : "grid");
    if (!tick.label.empty()) labels += tickLabel(at, bottom + 17.0, "middle", tick);
  }
  for (const Tick& tick : axisTicks(canvas.y)) {
    const double at = canvas.py(tick.value);
    grid += svg::line(left, at, right, at, tick.label.empty() ? "fine" : "grid");
    if (!tick.label.empty()) labels += tickLabel(left - 7.0, at + 4.0, "end", tick);
  }
  const std::string frame =
      svg::line(left, bottom, right, bottom, "frame") + svg::line(left, top, left, bottom, "frame");
  const double middle = top + kPlotArea.height / 2.0;
  const auto whole = [](const PlotAxis& axis) {
    return axis.note.empty() ? axis.title : fmt::format("{} ({})", axis.title, axis.note);
  };
  const std::string titles =
      svg::text(left + kPlotArea.width / 2.0, bottom + 37.0, "middle", whole(plot.x)) +
      svg::text(15.0, middle, "middle", whole(plot.y),
                fmt::format("transform=\"rotate(-90 15 {})\"", svg::coordinate(middle)));
  return grid + frame + labels + titles;
}

bool hasInterval(const PlotPoint& point) { return !std::isnan(point.lo) && !std::isnan(point.hi); }

// Returns the end of an interval, clamped to the axis.
double clamped(const Canvas& canvas, double value) {
  return std::isfinite(value) ? std::clamp(value, canvas.y.lo, canvas.y.hi)
         : value > 0.0        ? canvas.y.hi
                              : canvas.y.lo;
}

// Draws a band for each unbroken sequence of intervals; whiskers for a single one, and for all if
// intervals are bars.
std::string band(const Canvas& canvas, const std::vector<PlotPoint>& points, size_t index,
                 bool hasBars) {
  std::string out;
  for (size_t begin = 0; begin < points.size(); ++begin) {
    size_t end = begin;
    while (end < points.size() && hasInterval(points[end]) && !(hasBars && end > begin)) ++end;
    if (end == begin) continue;
    std::string upper, lower;
    for (size_t i = begin; i < end; ++i) {
      const double x = canvas.px(points[i].x);
      const double hi = canvas.py(clamped(canvas, points[i].hi));
      const double lo = canvas.py(clamped(canvas, points[i].lo));
      upper += fmt::format("{},{} ", svg::coordinate(x), svg::coordinate(hi));
      lower.insert(0, fmt::format("{},{} ", svg::coordinate(x), svg::coordinate(lo)));
      if (end - begin > 1) continue;
      out += fmt::format(
          "<path d=\"M{0} {1}V{2}M{3} {1}h8M{3} {2}h8\" stroke=\"{4}\" fill=\"none\" "
          "class=\"whisker "
          "s{5}\"/>\n",
          svg::coordinate(x), svg::coordinate(hi), svg::coordinate(lo), svg::coordinate(x - 4.0),
          svg::colour(index), index % svg::kColours);
    }
    if (end - begin > 1) {
      lower.pop_back();
      out += fmt::format(
          "<polygon points=\"{}{}\" fill=\"{}\" fill-opacity=\"0.2\" class=\"band f{}\"/>\n", upper,
          lower, svg::colour(index), index % svg::kColours);
    }
    begin = end - 1;
  }
  return out;
}

std::string lineThrough(const Canvas& canvas, const std::vector<PlotPoint>& points, size_t index) {
  if (points.size() < 2) return "";
  std::string path;
  for (const PlotPoint& point : points) {
    path += fmt::format("{}{},{}", path.empty() ? "" : " ", svg::coordinate(canvas.px(point.x)),
                        svg::coordinate(canvas.py(point.y)));
  }
  const std::string dash = svg::dashes(index);
  return fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.75\" "
      "stroke-linejoin=\"round\"{} class=\"line s{}\"/>\n",
      path, svg::colour(index), dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash),
      index % svg::kColours);
}

// Draws the fitted line over the range of the series, clipped to the axes.
std::string fitted(const Canvas& canvas, const std::vector<PlotPoint>& points, const PlotFit& fit,
                   size_t index) {
  if (points.empty() || !std::isfinite(fit.slope) || !std::isfinite(fit.intercept)) return "";
  const auto scaled = [](const Axis& axis, double value) {
    return axis.log ? std::log10(value) : value;
  };
  double from = scaled(canvas.x, points.front().x), to = scaled(canvas.x, points.back().x);
  const double lo = scaled(canvas.y, canvas.y.lo), hi = scaled(canvas.y, canvas.y.hi);
  if (fit.slope != 0.0) {
    const double atLo = (lo - fit.intercept) / fit.slope, atHi = (hi - fit.intercept) / fit.slope;
    from = std::max(from, std::min(atLo, atHi));
    to = std::min(to, std::max(atLo, atHi));
  } else if (fit.intercept < lo || fit.intercept > hi) {
    return "";
  }
  if (!(from < to)) return "";
  const auto pixel = [&](double at) {
    const double y = fit.intercept + fit.slope * at;
    const double xValue = canvas.x.log ? std::pow(10.0, at) : at;
    const double yValue = canvas.y.log ? std::pow(10.0, y) : y;
    return std::pair(svg::coordinate(canvas.px(xValue)), svg::coordinate(canvas.py(yValue)));
  };
  const auto [x0, y0] = pixel(from);
  const auto [x1, y1] = pixel(to);
  return fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"1\" "
      "stroke-dasharray=\"5 4\" class=\"fit s{}\"/>\n",
      x0, y0, x1, y1, svg::colour(index), index % svg::kColours);
}

size_t styleOf(const PlotSpec& plot, size_t index) {
  return plot.series[index].style.value_or(index);
}

std::string seriesMarks(const Canvas& canvas, const PlotSpec& plot, size_t place) {
  const PlotSeries& series = plot.series[place];
  const size_t index = styleOf(plot, place);
  const std::vector<PlotPoint> points = shownPoints(canvas, series);
  std::string out = lineThrough(canvas, points, index);
  if (series.fit) out += fitted(canvas, points, *series.fit, index);
  for (const PlotPoint& point : points) {
    const std::string tip =
        fmt::format("{}\n{}: {}\n{}: {}{}", series.name, plot.x.title, shortNumber(point.x),
                    plot.y.title, shortNumber(point.y), intervalText(point.lo, point.hi));
    out += svg::marker(index, canvas.px(point.x), canvas.py(point.y),
                       point.isHollow ? tip + "\nleft out of the line" : tip, point.isHollow);
  }
  return out;
}

std::string legend(const PlotSpec& plot, double top) {
  std::string out;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const double y = top + svg::kLegendRow * double(i);
    const size_t style = styleOf(plot, i);
    const std::string dash = svg::dashes(style);
    out += fmt::format(
        "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"1.75\"{} "
        "class=\"line s{}\"/>\n",
        svg::coordinate(kPlotArea.left), svg::coordinate(y), svg::coordinate(kPlotArea.left + 30.0),
        svg::coordinate(y), svg::colour(style),
        dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash), style % svg::kColours);
    out += svg::marker(style, kPlotArea.left + 15.0, y);
    const PlotSeries& series = plot.series[i];
    const double nameLeft = kPlotArea.left + 40.0;
    out += svg::text(nameLeft, y + 4.0, "start", svg::fitText(series.name, kNameWidth, 12.0));
    if (!series.fit || !std::isfinite(series.fit->slope)) continue;
    out += svg::text(nameLeft + kNameWidth + 10.0, y + 4.0, "start",
                     fmt::format("slope {:.2f}{}", series.fit->slope,
                                 std::isnan(series.fit->slopeLo) || std::isnan(series.fit->slopeHi)
                                     ? ""
                                     : fmt::format(" [{:.2f}, {:.2f}]", series.fit->slopeLo,
                                                   series.fit->slopeHi)),
                     "class=\"slope\"");
  }
  return out;
}

void collect(const PlotSpec& plot, bool isX, std::vector<double>& inner,
             std::vector<double>& outer) {
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      // A point is ignored for both axes if one of them cannot show it.
      const auto can = [](bool log, double v) { return std::isfinite(v) && (!log || v > 0.0); };
      if (!can(plot.x.log, point.x) || !can(plot.y.log, point.y)) continue;
      inner.push_back(isX ? point.x : point.y);
      if (isX) continue;
      outer.push_back(point.lo);
      outer.push_back(point.hi);
    }
  }
}

// Returns the index of the row with that name, if there is one.
std::optional<size_t> rowNamed(const ReportModel& rows, const std::string& name) {
  for (size_t i = 0; i < rows.size(); ++i) {
    if (reportText(rows[i], "method") == name) return i;
  }
  return std::nullopt;
}

// Counts the points that are not shown, or not part of the lines.
std::string notesOf(const PlotSpec& plot, size_t hidden, size_t hollow) {
  std::string notes;
  if (hidden) {
    notes = fmt::format("{} point{} left out: not finite{}", hidden, hidden > 1 ? "s" : "",
                        plot.x.log || plot.y.log ? ", or not above 0" : "");
  }
  if (hollow) {
    notes += fmt::format("{}{} hollow point{} left out of the lines", notes.empty() ? "" : "; ",
                         hollow, hollow > 1 ? "s" : "");
  }
  return notes;
}

}  // namespace

Axis plotAxisX(const PlotSpec& plot) {
  std::vector<double> inner, outer;
  collect(plot, true, inner, outer);
  return fitAxis(plot.x.log, inner, outer);
}

Axis plotAxisY(const PlotSpec& plot) {
  std::vector<double> inner, outer;
  collect(plot, false, inner, outer);
  return fitAxis(plot.y.log, inner, outer);
}

std::string plotSvg(const PlotSpec& plot) {
  const Canvas canvas = {plotAxisX(plot), plotAxisY(plot)};
  size_t hidden = 0, hollow = 0;
  for (const PlotSeries& series : plot.series) {
    const std::vector<PlotPoint> shown = shownPoints(canvas, series);
    hidden += series.points.size() - shown.size();
    for (const PlotPoint& point : shown) hollow += point.isHollow;
  }
  const std::string notes = notesOf(plot, hidden, hollow);
  const double legendTop = kPlotArea.top + kPlotArea.height + kLegendTop;
  const double legendEnd = legendTop + svg::kLegendRow * double(plot.series.size());
  std::string out = svg::open(kPlotWidth, legendEnd + (notes.empty() ? 0.0 : svg::kLegendRow),
                              plot.title, "plot");
  out += svg::text(kPlotArea.left, 22.0, "start",
                   svg::fitText(plot.title, kPlotWidth - kPlotArea.left - 8.0, 14.5),
                   "font-size=\"14\" font-weight=\"bold\"");
  out += axes(canvas, plot);
  // Draw the bands below all lines.
  for (size_t i = 0; i < plot.series.size(); ++i) {
    out += band(canvas, shownPoints(canvas, plot.series[i]), styleOf(plot, i), plot.hasBars);
  }
  for (size_t i = 0; i < plot.series.size(); ++i) out += seriesMarks(canvas, plot, i);
  out += legend(plot, legendTop);
  if (!notes.empty()) {
    out += svg::text(kPlotArea.left, legendEnd + 4.0, "start", notes,
                     "class=\"hidden\" font-style=\"italic\"");
  }
  return out + "</svg>\n";
}

PlotSpec plotFromModel(const ReportModel& block, const ReportModel& model) {
  constexpr double kUnknownEnd = std::numeric_limits<double>::quiet_NaN();
  PlotSpec plot;
  plot.title = reportText(model, "title");
  const auto axis = [](const ReportModel& from) {
    return PlotAxis{reportText(from, "title"), from.value("log", false), reportText(from, "note")};
  };
  plot.x = axis(model["x"]);
  plot.y = axis(model["y"]);
  plot.hasBars = reportText(model, "intervals") == "bars";
  const ReportModel &rows = block["rows"], &all = model["series"];
  const bool isOfRows = std::any_of(all.begin(), all.end(), [&](const ReportModel& one) {
    return rowNamed(rows, reportText(one, "name")).has_value();
  });
  for (const ReportModel& from : model["series"]) {
    PlotSeries& series = plot.series.emplace_back();
    series.name = reportText(from, "name");
    // Beside rows, a series that is none has an index after all of them.
    const size_t other = (isOfRows ? rows.size() : 0) + plot.series.size() - 1;
    series.style = rowNamed(rows, series.name).value_or(other);
    for (const ReportModel& numbers : from["points"]) {
      PlotPoint& point = series.points.emplace_back();
      point.x = reportNumber(numbers[0]);
      point.y = reportNumber(numbers[1]);
      if (numbers.size() < 4) continue;
      point.lo = reportNumber(numbers[2]);
      point.hi = reportNumber(numbers[3]);
    }
    for (const ReportModel& place : reportList(from, "hollow"))
      series.points.at(place.get<size_t>()).isHollow = true;
    const auto fit = from.find("fit");
    if (fit == from.end()) continue;
    series.fit = PlotFit{reportNumber((*fit)["slope"]), reportNumber(*fit, "lo", kUnknownEnd),
                         reportNumber(*fit, "hi", kUnknownEnd), reportNumber((*fit)["intercept"])};
  }
  return plot;
}

}  // namespace restlab
