#include "experiments/report/graph_svg.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/report/svg_style.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

using Use = GraphDrawing::Use;

constexpr double kLeft = 14.0, kRow = 30.0, kBox = 22.0, kLane = 24.0, kGap = 26.0, kFont = 12.0;

struct Layout {
  double boxWidth = 0.0, firstLane = 0.0, top = 0.0, width = 0.0, height = 0.0, bottom = 0.0;

  double lane(size_t buffer) const { return firstLane + kLane * double(buffer); }
  double row(size_t pass) const { return top + kRow * (double(pass) + 0.5); }
};

std::string noted(const std::string& name, const std::string& note) {
  return note.empty() ? name : fmt::format("{}  {}", name, note);
}

Layout layoutOf(const GraphDrawing& graph) {
  Layout at;
  double longest = 0.0;
  for (const GraphDrawing::Pass& pass : graph.passes)
    at.boxWidth = std::max(at.boxWidth, svg::textWidth(noted(pass.name, pass.note), kFont) + 20.0);
  for (const GraphDrawing::DrawnBuffer& buffer : graph.buffers)
    longest = std::max(longest, svg::textWidth(noted(buffer.name, buffer.note), kFont));
  at.firstLane = kLeft + at.boxWidth + kGap;
  at.top = 44.0 + longest;
  at.bottom = at.top + kRow * double(graph.passes.size()) + 8.0;
  at.height = at.bottom + 34.0;
  const double lanes = at.firstLane + kLane * double(graph.buffers.size()) + 12.0;
  at.width = std::max({lanes, svg::textWidth(graph.title, 14.5) + 28.0,
                       svg::textWidth(graph.footnote, kFont) + 28.0});
  return at;
}

// Tip of a downward arrow at x, y.
std::string tip(double x, double y, size_t buffer) {
  return fmt::format("<polygon points=\"{},{} {},{} {},{}\" fill=\"{}\" class=\"part f{}\"/>\n",
                     svg::coordinate(x), svg::coordinate(y), svg::coordinate(x - 4.0),
                     svg::coordinate(y - 8.0), svg::coordinate(x + 4.0), svg::coordinate(y - 8.0),
                     svg::colour(buffer), buffer % svg::kColours);
}

// A filled mark: the pass writes; a hollow one: it reads; a filled one in a ring: both.
std::string mark(double x, double y, Use use, size_t buffer) {
  const auto circle = [&](double radius, bool isFilled) {
    return fmt::format(
        "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.75\" "
        "class=\"mark\"/>\n",
        svg::coordinate(x), svg::coordinate(y), svg::coordinate(radius),
        isFilled ? svg::colour(buffer) : "#ffffff", svg::colour(buffer));
  };
  if (use == Use::written) return circle(5.0, true);
  return circle(use == Use::both ? 7.0 : 5.0, false) + (use == Use::both ? circle(3.0, true) : "");
}

std::string lane(const GraphDrawing& graph, const Layout& at, size_t buffer) {
  const double x = at.lane(buffer);
  double from = at.bottom, to = at.top;
  std::string marks;
  for (size_t pass = 0; pass < graph.passes.size(); ++pass) {
    const Use use = graph.passes[pass].uses[buffer];
    if (use == Use::none) continue;
    from = std::min(from, at.row(pass));
    to = std::max(to, at.row(pass));
    marks += mark(x, at.row(pass), use, buffer);
  }
  const GraphDrawing::DrawnBuffer& drawn = graph.buffers[buffer];
  if (drawn.isFromLastFrame) from = at.top - 4.0;
  if (drawn.isForNextFrame) to = at.bottom;
  std::string out = fmt::format(
      "<line x1=\"{0}\" y1=\"{1}\" x2=\"{0}\" y2=\"{2}\" stroke=\"{3}\" stroke-width=\"2\" "
      "class=\"line s{4}\"/>\n",
      svg::coordinate(x), svg::coordinate(from), svg::coordinate(to), svg::colour(buffer),
      buffer % svg::kColours);
  if (drawn.isForNextFrame) out += tip(x, at.bottom + 6.0, buffer);
  return out + marks;
}

}  // namespace

std::string graphSvg(const GraphDrawing& graph) {
  const Layout at = layoutOf(graph);
  std::string out = svg::open(at.width, at.height, graph.title, "graph");
  out += svg::text(kLeft, 22.0, "start", graph.title, "font-size=\"14\" font-weight=\"bold\"");
  for (size_t b = 0; b < graph.buffers.size(); ++b) {
    const double x = at.lane(b) + 4.0, y = at.top - 8.0;
    out += svg::text(x, y, "start", noted(graph.buffers[b].name, graph.buffers[b].note),
                     fmt::format("font-size=\"12\" transform=\"rotate(-90 {} {})\"",
                                 svg::coordinate(x), svg::coordinate(y)));
  }
  const double right = at.lane(graph.buffers.size()) - kLane / 2.0;
  for (size_t p = 0; p < graph.passes.size(); ++p)
    out += svg::line(kLeft + at.boxWidth, at.row(p), right, at.row(p), "grid");
  for (size_t b = 0; b < graph.buffers.size(); ++b) out += lane(graph, at, b);
  for (size_t p = 0; p < graph.passes.size(); ++p) {
    const GraphDrawing::Pass& pass = graph.passes[p];
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"4\" fill=\"#ffffff\" "
        "stroke=\"#444444\"{} class=\"pass\"/>\n",
        svg::coordinate(kLeft), svg::coordinate(at.row(p) - kBox / 2.0),
        svg::coordinate(at.boxWidth), svg::coordinate(kBox),
        pass.runsInStillView ? "" : " stroke-dasharray=\"4 3\"");
    out += svg::text(kLeft + 8.0, at.row(p) + 4.0, "start", pass.name, "font-size=\"12\"");
    out += svg::text(kLeft + at.boxWidth - 8.0, at.row(p) + 4.0, "end", pass.note,
                     "font-size=\"11\" class=\"tick\"");
  }
  out += svg::text(kLeft, at.height - 8.0, "start", graph.footnote, "font-size=\"11\"");
  return out + "</svg>\n";
}

}  // namespace restlab
