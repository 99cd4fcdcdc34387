// Plots and bars: well-formed, marks at the right places, text escaped.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/report/svg_bars.h"
#include "experiments/report/svg_plot.h"
#include "experiments/report/svg_style.h"
#include "tests/report/xml.h"

namespace restlab::report_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

PlotSpec logPlot() {
  PlotSpec plot;
  plot.title = "MSE over time";
  plot.x = {"render time (s)", true};
  plot.y = {"MSE", true};
  plot.series = {{"path",
                  {{0.1, 1.0, 0.8, 1.25}, {1.0, 0.1, 0.08, 0.125}, {10.0, 0.01, 0.008, 0.0125}},
                  PlotFit{-1.0, -1.1, -0.9, -1.0}},
                 {"gi", {{0.1, 0.05}, {1.0, 0.02}, {10.0, 0.01}}, std::nullopt}};
  return plot;
}

// Returns where a value must be drawn, from the ends of the axis.
double expectedX(const PlotSpec& plot, double value) {
  const Axis axis = plotAxisX(plot);
  const double at = plot.x.log ? std::log10(value / axis.lo) / std::log10(axis.hi / axis.lo)
                               : (value - axis.lo) / (axis.hi - axis.lo);
  return kPlotArea.left + kPlotArea.width * at;
}
double expectedY(const PlotSpec& plot, double value) {
  const Axis axis = plotAxisY(plot);
  const double at = plot.y.log ? std::log10(value / axis.lo) / std::log10(axis.hi / axis.lo)
                               : (value - axis.lo) / (axis.hi - axis.lo);
  return kPlotArea.top + kPlotArea.height * (1.0 - at);
}

TEST(Plot, LineIsWhereTheNumbersAre) {
  const PlotSpec plot = logPlot();
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto lines = findAll(svg, "polyline");
  ASSERT_EQ(lines.size(), 2u);
  for (size_t s = 0; s < 2; ++s) {
    const auto points = pointList(lines[s]->attributes.at("points"));
    ASSERT_EQ(points.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(points[i].first, expectedX(plot, plot.series[s].points[i].x), 0.01);
      EXPECT_NEAR(points[i].second, expectedY(plot, plot.series[s].points[i].y), 0.01);
    }
  }
}

TEST(Plot, MarkersDifferAndTellTheirNumbers) {
  const XmlElement svg = parseXml(plotSvg(logPlot()));
  const auto circles = findAll(svg, "circle", "mark");
  ASSERT_EQ(circles.size(), 4u) << "three points and the legend";
  EXPECT_NEAR(circles[1]->number("cx"), expectedX(logPlot(), 1.0), 0.01);
  EXPECT_NEAR(circles[1]->number("cy"), expectedY(logPlot(), 0.1), 0.01);
  EXPECT_EQ(circles[1]->children.at(0).text,
            "path\nrender time (s): 1\nMSE: 0.100 [0.0800, 0.125]");
  EXPECT_EQ(findAll(svg, "polygon", "mark").size(), 4u) << "the other series has squares";
}

TEST(Plot, BandHasBothEnds) {
  const PlotSpec plot = logPlot();
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto bands = findAll(svg, "polygon", "band");
  ASSERT_EQ(bands.size(), 1u) << "the other series has no intervals";
  const auto points = pointList(bands[0]->attributes.at("points"));
  ASSERT_EQ(points.size(), 6u);
  EXPECT_NEAR(points[0].second, expectedY(plot, 1.25), 0.01);
  EXPECT_NEAR(points[2].second, expectedY(plot, 0.0125), 0.01);
  EXPECT_NEAR(points[3].second, expectedY(plot, 0.008), 0.01);
  EXPECT_NEAR(points[3].first, expectedX(plot, 10.0), 0.01);
  EXPECT_NEAR(points[5].second, expectedY(plot, 0.8), 0.01);
}

TEST(Plot, IntervalsMayBeBars) {
  ReportModel block = ReportModel::parse(R"({
    "rows": [{"method": "path"}, {"method": "gi"}],
    "plot": {"title": "", "intervals": "bars", "x": {"title": ""}, "y": {"title": ""}, "series": [
      {"name": "swept", "points": [[1, 4, 3, 5], [2, 8, 7, 9], [3, 8], [4, 8, 7, 9]]}]}})");
  const PlotSpec plot = plotFromModel(block, block["plot"]);
  EXPECT_EQ(plot.series[0].style, 0u) << "of no row, as are all others";
  const XmlElement svg = parseXml(plotSvg(plot));
  EXPECT_EQ(findAll(svg, "path", "whisker").size(), 3u);
  EXPECT_TRUE(findAll(svg, "polygon", "band").empty());
  block["plot"].erase("intervals");
  const XmlElement bands = parseXml(plotSvg(plotFromModel(block, block["plot"])));
  EXPECT_EQ(findAll(bands, "polygon", "band").size(), 1u);
}

TEST(Plot, FitIsTheLineOfItsSlope) {
  const PlotSpec plot = logPlot();
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto fits = findAll(svg, "line", "fit");
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_NEAR(fits[0]->number("x1"), expectedX(plot, 0.1), 0.01);
  EXPECT_NEAR(fits[0]->number("y1"), expectedY(plot, 1.0), 0.01);
  EXPECT_NEAR(fits[0]->number("x2"), expectedX(plot, 10.0), 0.01);
  EXPECT_NEAR(fits[0]->number("y2"), expectedY(plot, 0.01), 0.01);
  const auto texts = findAll(svg, "text", "slope");
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts[0]->text, "slope -1.00 [-1.10, -0.90]");
}

TEST(Plot, FitEndsAtTheAxes) {
  PlotSpec plot = logPlot();
  plot.series[0].fit = PlotFit{-8.0, kNan, kNan, -1.0};
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto fits = findAll(svg, "line", "fit");
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_NEAR(fits[0]->number("y1"), kPlotArea.top, 0.01);
  EXPECT_NEAR(fits[0]->number("y2"), kPlotArea.top + kPlotArea.height, 0.01);
}

TEST(Plot, WhatCannotBeShownIsCounted) {
  PlotSpec plot = logPlot();
  plot.series[1].points = {{0.1, 0.0}, {1.0, kNan}, {2.0, -1.0},
                           {0.0, 1.0}, {kInf, 1.0}, {3.0, 0.1}};
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto notes = findAll(svg, "text", "hidden");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0]->text, "5 points left out: not finite, or not above 0");
  EXPECT_EQ(findAll(svg, "polygon", "mark").size(), 2u);
  EXPECT_TRUE(findAll(parseXml(plotSvg(logPlot())), "text", "hidden").empty());
}

TEST(Plot, PointsThatTheLineLeavesOutAreHollow) {
  const ReportModel block = ReportModel::parse(R"({
    "rows": [{"method": "path"}],
    "plot": {"title": "", "x": {"title": "", "log": true}, "y": {"title": "", "log": true},
      "series": [{"name": "path", "points": [[1, 1], [2, 0.5], [4, 0.25]], "hollow": [1]}]}})");
  const PlotSpec plot = plotFromModel(block, block["plot"]);
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto hollow = findAll(svg, "circle", "hollow");
  ASSERT_EQ(hollow.size(), 1u);
  EXPECT_NEAR(hollow[0]->number("cx"), expectedX(plot, 2.0), 0.01);
  EXPECT_EQ(hollow[0]->attributes.at("stroke"), svg::colour(0));
  EXPECT_EQ(findAll(svg, "circle", "mark").size(), 3u) << "two points and the legend";
  EXPECT_EQ(findAll(svg, "text", "hidden").at(0)->text, "1 hollow point left out of the lines");
}

TEST(Plot, IntervalsBeyondTheAxesEndThere) {
  PlotSpec plot = logPlot();
  plot.series[0].points[1].lo = -kInf;
  plot.series[0].points[2].lo = 0.0;
  plot.series[0].points[2].hi = kInf;
  const XmlElement svg = parseXml(plotSvg(plot));
  const auto points = pointList(findAll(svg, "polygon", "band").at(0)->attributes.at("points"));
  EXPECT_NEAR(points[2].second, kPlotArea.top, 0.01);
  EXPECT_NEAR(points[3].second, kPlotArea.top + kPlotArea.height, 0.01);
  EXPECT_NEAR(points[4].second, kPlotArea.top + kPlotArea.height, 0.01);
}

TEST(Plot, NothingToShow) {
  PlotSpec plot;
  plot.x.log = true;
  EXPECT_NO_THROW(parseXml(plotSvg(plot)));
  plot.series = {{"one", {{5.0, 5.0, 4.0, 6.0}}, PlotFit{kNan, kNan, kNan, kNan}}};
  const XmlElement one = parseXml(plotSvg(plot));
  EXPECT_EQ(findAll(one, "path", "whisker").size(), 1u) << "a single point has whiskers";
}

// Errors of a noise-free image differ by rounding only.
TEST(Plot, ValuesThatDifferByRoundingHaveTicks) {
  for (const bool log : {false, true}) {
    const double value = 1.43e-5;
    const Axis axis = fitAxis(log, {value, std::nextafter(value, 1.0)}, {});
    const size_t ticks = axisTicks(axis).size();
    EXPECT_GE(ticks, 2u) << log;
    EXPECT_LT(ticks, 40u) << log;
  }
}

TEST(Plot, TicksStandAtTheirValues) {
  const PlotSpec plot = logPlot();
  const XmlElement svg = parseXml(plotSvg(plot));
  std::map<std::string, double> labels;
  for (const XmlElement* text : findAll(svg, "text", "tick")) {
    if (text->attributes.at("text-anchor") == "middle") labels[text->text] = text->number("x");
  }
  ASSERT_TRUE(labels.count("0.1") && labels.count("1") && labels.count("10"));
  EXPECT_NEAR(labels["1"], expectedX(plot, 1.0), 0.01);
  EXPECT_NEAR(labels["10"], expectedX(plot, 10.0), 0.01);
}

TEST(Plot, AMethodLooksTheSameInEveryPlot) {
  const ReportModel block = ReportModel::parse(R"({
    "rows": [{"method": "path"}, {"method": "gi"}],
    "plot": {"title": "", "x": {"title": ""}, "y": {"title": ""}, "series": [
      {"name": "gi", "points": []}, {"name": "path", "points": []}, {"name": "x", "points": []}]}})");
  const PlotSpec plot = plotFromModel(block, block["plot"]);
  EXPECT_EQ(plot.series[0].style, 1u);
  EXPECT_EQ(plot.series[1].style, 0u);
  EXPECT_EQ(plot.series[2].style, 4u) << "none of a method";
  const XmlElement svg = parseXml(plotSvg(plot));
  EXPECT_EQ(findAll(svg, "line", "line").at(0)->attributes.at("stroke"), svg::colour(1));
}

TEST(Plot, IsDeterministic) { EXPECT_EQ(plotSvg(logPlot()), plotSvg(logPlot())); }

TEST(Plot, TextIsHarmless) {
  PlotSpec plot = logPlot();
  const std::string hostile = "<b>&\"'</svg><script>\x01";
  plot.title = plot.x.title = plot.y.title = plot.series[0].name = hostile;
  const XmlElement svg = parseXml(plotSvg(plot));
  EXPECT_TRUE(findAll(svg, "script").empty());
  EXPECT_EQ(svg.attributes.at("aria-label"), "<b>&\"'</svg><script>\xef\xbf\xbd");
}

TEST(AxisTicks, LabelsOfDecades) {
  Axis axis;
  axis.log = true;
  axis.lo = 5e-7;
  axis.hi = 2e5;
  std::vector<std::string> labels;
  for (const Tick& tick : axisTicks(axis)) {
    if (!tick.label.empty()) labels.push_back(tick.label + tick.exponent);
  }
  // With many decades every second one is labelled; long numbers use raised exponents.
  const std::string minus = "\xe2\x88\x92";
  const std::vector<std::string> expected = {
      "10" + minus + "6", "10" + minus + "4", "0.01", "1", "100", "10000"};
  EXPECT_EQ(labels, expected);
}

TEST(AxisTicks, LessThanADecadeStillHasLabels) {
  for (const bool log : {true, false}) {
    for (const double hi : {1.02, 1.2, 1.9, 5.0}) {
      const Axis axis = fitAxis(log, {1.0, hi}, {});
      size_t labels = 0;
      for (const Tick& tick : axisTicks(axis)) {
        EXPECT_TRUE(axis.shows(tick.value));
        labels += !tick.label.empty();
      }
      EXPECT_GE(labels, 2u) << (log ? "log " : "linear ") << hi;
    }
  }
}

TEST(FitAxis, WideIntervalsDoNotSqueezeTheValues) {
  const Axis axis = fitAxis(true, {1.0, 10.0}, {1e-12, 11.0, kInf, kNan});
  EXPECT_GT(axis.lo, 0.05);
  EXPECT_LT(axis.hi, 15.0);
}

TEST(Svg, FitTextCutsWholeCharacters) {
  EXPECT_EQ(svg::fitText("short", 200.0, 12.0), "short");
  const std::string cut =
      svg::fitText("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", 30.0, 12.0);
  EXPECT_EQ(cut, "\xc3\xa9\xc3\xa9\xe2\x80\xa6");
}

TEST(Bars, WidthsAreInProportion) {
  BarsSpec bars;
  bars.title = "Time <of> each pass";
  bars.unit = "ms";
  bars.rows = {{"path", {{"trace", 40.0}}}, {"gi & co", {{"trace", 60.0}, {"spatial", 20.0}}}};
  const XmlElement svg = parseXml(barsSvg(bars));
  const auto parts = findAll(svg, "rect", "part");
  ASSERT_EQ(parts.size(), 5u) << "three parts and two of the legend";
  EXPECT_NEAR(parts[1]->number("width") / parts[0]->number("width"), 1.5, 1e-3);
  EXPECT_NEAR(parts[2]->number("width") / parts[0]->number("width"), 0.5, 1e-3);
  EXPECT_NEAR(parts[2]->number("x"), parts[1]->number("x") + parts[1]->number("width"), 0.02);
  EXPECT_EQ(parts[0]->attributes.at("fill"), parts[1]->attributes.at("fill"));
  EXPECT_NE(parts[1]->attributes.at("fill"), parts[2]->attributes.at("fill"));
  EXPECT_EQ(parts[1]->children.at(0).text, "gi & co, trace: 60 ms");
  EXPECT_EQ(barsSvg(bars), barsSvg(bars));
}

TEST(Bars, NothingIsNoDivisionByZero) {
  BarsSpec bars;
  bars.rows = {{"nothing", {{"a", 0.0}}}, {"less", {}}};
  const std::string text = barsSvg(bars);
  EXPECT_NO_THROW(parseXml(text));
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

}  // namespace
}  // namespace restlab::report_test
