#include "experiments/report/svg_style.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/report/text.h"

namespace restlab::svg {
namespace {

// Returns a closed outline around (x, y); all look about as large as a circle of radius 4.
std::string outline(size_t shape, double x, double y) {
  const auto polygon = [&](size_t corners, double radius, double startDegrees) {
    std::string points;
    for (size_t i = 0; i < corners; ++i) {
      const double angle =
          (startDegrees + 360.0 * double(i) / double(corners)) * std::numbers::pi / 180.0;
      points += fmt::format("{}{},{}", i ? " " : "", coordinate(x + radius * std::cos(angle)),
                            coordinate(y + radius * std::sin(angle)));
    }
    return fmt::format("<polygon points=\"{}\"", points);
  };
  switch (shape % 6) {
    case 0:
      return fmt::format(R"(<circle cx="{}" cy="{}" r="4")", coordinate(x), coordinate(y));
    case 1:
      return polygon(4, 5.2, 45.0);  // square
    case 2:
      return polygon(3, 5.6, -90.0);  // triangle
    case 3:
      return polygon(4, 5.6, 0.0);  // diamond
    case 4:
      return polygon(3, 5.6, 90.0);  // triangle on its tip
    default:
      return polygon(6, 5.0, 0.0);  // hexagon
  }
}

}  // namespace

const char* colour(size_t index) {
  static const char* const colours[kColours] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#595959"};
  return colours[index % kColours];
}

const char* passColour(size_t index) {
  static const char* const colours[kPassColours] = {"#7a7695", "#fec193", "#553318", "#a1a692",
                                                    "#2e3a73", "#9bdafd", "#955b2a"};
  return colours[index % kPassColours];
}

const char* dashes(size_t index) {
  static const char* const patterns[] = {"", "7 3", "2 3", "9 3 2 3"};
  return patterns[index / kColours % 4];
}

std::string marker(size_t index, double x, double y, std::string_view tooltip, bool isHollow) {
  const std::string shape =
      isHollow
          ? fmt::format(R"({} fill="#ffffff" stroke="{}" stroke-width="1.5" class="hollow s{}")",
                        outline(index, x, y), colour(index), index % kColours)
          : fmt::format(R"({} fill="{}" stroke="#ffffff" stroke-width="0.75" class="mark f{}")",
                        outline(index, x, y), colour(index), index % kColours);
  if (tooltip.empty()) return shape + "/>\n";
  const char* element = index % 6 == 0 ? "circle" : "polygon";
  return fmt::format("{}><title>{}</title></{}>\n", shape, escapeMarkup(tooltip), element);
}

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string line(double x0, double y0, double x1, double y1, std::string_view cssClass) {
  // Plots have only three kinds of thin lines: frame, grid and finer grid.
  const bool frame = cssClass == "frame";
  const char* stroke = frame ? "#404040" : cssClass == "grid" ? "#d4d4d4" : "#ececec";
  return fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\" "
      "class=\"{}\"/>\n",
      coordinate(x0), coordinate(y0), coordinate(x1), coordinate(y1), stroke, frame ? 1 : 0.75,
      cssClass);
}

std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view attributes) {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n", coordinate(x),
                     coordinate(y), anchor, attributes.empty() ? "" : " ", attributes,
                     escapeMarkup(content));
}

double textWidth(std::string_view content, double size) {
  double width = 0.0;
  for (const char c : content) {
    if ((uint8_t(c) & 0xc0) == 0x80) continue;  // inside a character of several bytes
    const bool narrow = std::string_view("iljtfr.,:;'|!()[] ").find(c) != std::string_view::npos;
    const bool wide = (c >= 'A' && c <= 'Z') || c == 'm' || c == 'w' || c == '%' || c == '@';
    width += narrow ? 0.36 : wide ? 0.76 : 0.6;
  }
  return width * size;
}

std::string fitText(std::string_view content, double width, double size) {
  std::string clean = cleanText(content);
  if (textWidth(clean, size) <= width) return clean;
  while (!clean.empty() && textWidth(clean, size) + 0.9 * size > width) {
    while ((uint8_t(clean.back()) & 0xc0) == 0x80) clean.pop_back();
    clean.pop_back();
  }
  return clean + "\xe2\x80\xa6";
}

std::string open(double width, double height, std::string_view title, std::string_view cssClass) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
      R"(class="{2}" role="img" aria-label="{3}" font-family="Helvetica, Arial, sans-serif" )"
      R"(font-size="12" fill="#1a1a1a">)"
      "\n<title>{3}</title>\n"
      R"(<rect width="{0}" height="{1}" fill="#ffffff" class="ground"/>)"
      "\n",
      coordinate(width), coordinate(height), cssClass, escapeMarkup(title));
}

}  // namespace restlab::svg
