// Plots of series with confidence bands and fitted lines as SVG, for a page and for print.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/report/axis.h"
#include "experiments/report/report_model.h"

namespace restlab {

struct PlotPoint {
  double x = 0.0, y = 0.0;
  // Interval of y; NaN: unknown.
  double lo = std::numeric_limits<double>::quiet_NaN();
  double hi = std::numeric_limits<double>::quiet_NaN();
  bool isHollow = false;  // left out of the fit
};

// y = intercept + slope x; a logarithmic axis enters as log10. slopeLo and slopeHi NaN: unknown.
struct PlotFit {
  double slope = 0.0, slopeLo = 0.0, slopeHi = 0.0, intercept = 0.0;
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  // in order of x
  std::optional<PlotFit> fit = std::nullopt;
  std::optional<size_t> style =
      std::nullopt;  // colour and marker; default: the index of the series
};

struct PlotAxis {
  std::string title;
  bool log = false;
  std::string note = "";  // behind the title, in brackets
};

struct PlotSpec {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  // Intervals as bars; false: as bands between points.
  bool hasBars = false;
};

// Area inside the axes, in pixels of the image.
struct PlotArea {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};
constexpr double kPlotWidth = 640.0;
constexpr PlotArea kPlotArea = {68.0, 36.0, 556.0, 300.0};

// Axes that plotSvg() draws.
Axis plotAxisX(const PlotSpec& plot);
Axis plotAxisY(const PlotSpec& plot);

// Returns a complete SVG document, identical bytes for identical plots. Points that an axis cannot
// show (not finite; not positive on a logarithmic axis) are left out and counted in a line below
// the plot.
std::string plotSvg(const PlotSpec& plot);

// Reads a member of "plots" of a block of a checked model. A series with the name of one of the
// block's rows gets the style of that row's index: a method looks the same in every plot. A plot
// none of whose series is a row has styles of its own.
PlotSpec plotFromModel(const ReportModel& block, const ReportModel& plot);

}  // namespace restlab
