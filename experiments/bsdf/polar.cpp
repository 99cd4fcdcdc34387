#include "experiments/bsdf/polar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/report/svg_style.h"

namespace restlab {
namespace {

constexpr double kAngles[] = {0.0, 30.0, 45.0, 60.0, 80.0};
constexpr double kWidth = 640.0, kRadius = 280.0, kTop = 48.0;
constexpr int kSteps = 1440;  // over the half circle: an eighth of a degree each

struct Curve {
  std::string points;
  double most = 0.0;
};

glm::dvec3 inPlane(double theta) { return {std::sin(theta), 0.0, std::cos(theta)}; }

// wo leans to the left by `degrees`; the mirrored direction lies on the right.
Curve curveOf(const BsdfProbe& bsdf, double degrees, bool isBelow) {
  const glm::dvec3 wo = inPlane(-degrees * std::numbers::pi / 180.0);
  std::vector<glm::dvec3> values;  // theta, value
  Curve curve;
  const int end = isBelow ? 2 * kSteps : kSteps;
  for (int i = 0; i <= end; ++i) {
    const double theta = (double(i) / kSteps - 0.5) * std::numbers::pi;
    double pdf = 0.0;
    const glm::dvec3 f = bsdf.eval(wo, inPlane(theta), pdf);
    const double y = 0.2126 * f.x + 0.7152 * f.y + 0.0722 * f.z;
    curve.most = std::max(curve.most, y);
    values.emplace_back(theta, y, 0.0);
  }
  for (const glm::dvec3& v : values) {
    const double r = curve.most > 0.0 ? kRadius * v.y / curve.most : 0.0;
    curve.points += fmt::format("{} {} ", svg::coordinate(0.5 * kWidth + r * std::sin(v.x)),
                                svg::coordinate(kTop + kRadius - r * std::cos(v.x)));
  }
  return curve;
}

}  // namespace

std::string polarSvg(const BsdfProbe& bsdf, const std::string& title) {
  const bool isBelow = bsdf.hasTransmission();
  const double bottom = kTop + kRadius * (isBelow ? 2.0 : 1.0) + 16.0;
  const double height = bottom + svg::kLegendRow * double(std::size(kAngles)) + 16.0;
  std::string text = svg::open(kWidth, height, title, "polar");
  text += svg::text(0.5 * kWidth, 24.0, "middle", title, "class=\"title\"");
  const double y = kTop + kRadius, x = 0.5 * kWidth;
  text += svg::line(x - kRadius, y, x + kRadius, y, "axis");
  text += svg::line(x, kTop, x, y, "grid");
  for (const double share : {0.5, 1.0}) {
    const double r = share * kRadius;
    text +=
        fmt::format("<path d=\"M {} {} A {} {} 0 0 1 {} {}\" fill=\"none\" stroke=\"#bbbbbb\"/>\n",
                    svg::coordinate(x - r), svg::coordinate(y), svg::coordinate(r),
                    svg::coordinate(r), svg::coordinate(x + r), svg::coordinate(y));
  }
  size_t index = 0;
  for (const double degrees : kAngles) {
    const Curve curve = curveOf(bsdf, degrees, isBelow);
    text +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
                    curve.points, svg::colour(index));
    const double row = bottom + svg::kLegendRow * double(index + 1);
    text += fmt::format(
        "<line x1=\"40\" y1=\"{0}\" x2=\"64\" y2=\"{0}\" stroke=\"{1}\" stroke-width=\"2\"/>\n",
        svg::coordinate(row - 4.0), svg::colour(index));
    text += svg::text(
        72.0, row, "start",
        fmt::format("light from {:g} degrees: at most {:.3g} per sr", degrees, curve.most));
    ++index;
  }
  return text + "</svg>\n";
}

}  // namespace restlab
