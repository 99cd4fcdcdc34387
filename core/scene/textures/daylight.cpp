#include "core/scene/textures/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.h"

namespace restlab {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSunRadius = 0.2665 * kPi / 180.0;
// Illuminance of the sun above the atmosphere, in klx.
constexpr double kSunIlluminance = 128.0;

double radiansOf(double degrees) { return degrees * kPi / 180.0; }

glm::dvec3 sunDirection(const Daylight& d) {
  const double e = radiansOf(d.elevation), a = radiansOf(d.azimuth);
  return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

// Perez' five coefficients of Y, x and y (table 2 of the paper, appendix A.2).
std::array<glm::dvec3, 5> perezCoefficients(double t) {
  return {glm::dvec3(0.1787 * t - 1.4630, -0.0193 * t - 0.2592, -0.0167 * t - 0.2608),
          glm::dvec3(-0.3554 * t + 0.4275, -0.0665 * t + 0.0008, -0.0950 * t + 0.0092),
          glm::dvec3(-0.0227 * t + 5.3251, -0.0004 * t + 0.2125, -0.0079 * t + 0.2102),
          glm::dvec3(0.1206 * t - 2.5771, -0.0641 * t - 0.8989, -0.0441 * t - 1.6537),
          glm::dvec3(-0.0670 * t + 0.3703, -0.0033 * t + 0.0452, -0.0109 * t + 0.0529)};
}

glm::dvec3 perez(const std::array<glm::dvec3, 5>& c, double cosTheta, double gamma) {
  const double cosGamma = std::cos(gamma);
  return (1.0 + c[0] * glm::exp(c[1] / cosTheta)) *
         (1.0 + c[2] * glm::exp(c[3] * gamma) + c[4] * (cosGamma * cosGamma));
}

// Value of a cubic in the sun's angle from the zenith.
double cubic(double theta, double a, double b, double c, double d) {
  return ((a * theta + b) * theta + c) * theta + d;
}

// Y, x, y overhead.
glm::dvec3 zenithYxy(double t, double theta) {
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * theta);
  const double luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  const double x = cubic(theta, 0.00166, -0.00375, 0.00209, 0.0) * t * t +
                   cubic(theta, -0.02903, 0.06377, -0.03202, 0.00394) * t +
                   cubic(theta, 0.11693, -0.21196, 0.06052, 0.25886);
  const double y = cubic(theta, 0.00275, -0.00610, 0.00317, 0.0) * t * t +
                   cubic(theta, -0.04214, 0.08970, -0.04153, 0.00516) * t +
                   cubic(theta, 0.15346, -0.26756, 0.06670, 0.26688);
  return {luminance, x, y};
}

glm::dvec3 rec709Of(const glm::dvec3& yxy) {
  const double scale = yxy.x / yxy.z;
  const glm::dvec3 xyz(yxy.y * scale, yxy.x, (1.0 - yxy.y - yxy.z) * scale);
  return {3.240970 * xyz.x - 1.537383 * xyz.y - 0.498611 * xyz.z,
          -0.969244 * xyz.x + 1.875968 * xyz.y + 0.041555 * xyz.z,
          0.055630 * xyz.x - 0.203977 * xyz.y + 1.056972 * xyz.z};
}

// Share of the sun's light that air and haze let through, at a wavelength of each channel (um).
glm::dvec3 sunTransmittance(const Daylight& d) {
  const double fromZenith = 90.0 - d.elevation;
  const double mass =
      1.0 / (std::cos(radiansOf(fromZenith)) + 0.15 * std::pow(93.885 - fromZenith, -1.253));
  const double haze = 0.04608 * d.turbidity - 0.04586;
  glm::dvec3 through;
  const std::array<double, 3> wavelengths{0.612, 0.549, 0.465};
  for (int c = 0; c < 3; ++c) {
    const double w = wavelengths[size_t(c)];
    through[c] = std::exp(-mass * (0.008735 * std::pow(w, -4.08) + haze * std::pow(w, -1.3)));
  }
  return through;
}

class Builder {
 public:
  Builder(const Daylight& d, uint32_t width, uint32_t height)
      : d_(d), sun_(sunDirection(d)), coefficients_(perezCoefficients(d.turbidity)) {
    map_.source = "daylight";
    map_.width = width;
    map_.height = height;
    map_.radiance.resize(size_t(width) * height);
    const double theta = radiansOf(90.0 - d.elevation);
    const glm::dvec3 zenith = zenithYxy(d.turbidity, theta);
    scale_ = zenith / perez(coefficients_, 1.0, theta);
  }

  glm::dvec3 skyYxy(const glm::dvec3& dir) const {
    // The formula has no value at the horizon itself.
    const double gamma = std::acos(std::clamp(glm::dot(dir, sun_), -1.0, 1.0));
    return scale_ * perez(coefficients_, std::max(dir.y, 1e-3), gamma);
  }

  EnvironmentMap take() {
    addSky();
    addSun();
    addGround();
    return std::move(map_);
  }

 private:
  // Direction of a place in the map, in texels.
  glm::dvec3 directionAt(double x, double y) const {
    const double theta = kPi * y / map_.height, phi = 2.0 * kPi * (x / map_.width - 0.5);
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
  }
  double solidAngleOf(uint32_t y) const {
    const double h = map_.height;
    return 2.0 * kPi / map_.width * (std::cos(kPi * y / h) - std::cos(kPi * (y + 1) / h));
  }
  glm::vec3& texel(uint32_t x, uint32_t y) { return map_.radiance[size_t(y) * map_.width + x]; }

  void addSky() {
    size_t negative = 0;
    for (uint32_t y = 0; y < map_.height / 2; ++y) {
      for (uint32_t x = 0; x < map_.width; ++x) {
        const glm::dvec3 color = rec709Of(skyYxy(directionAt(x + 0.5, y + 0.5)));
        if (std::min({color.r, color.g, color.b}) < 0.0) ++negative;
        texel(x, y) = glm::vec3(glm::max(color, glm::dvec3(0.0)));
      }
    }
    if (negative > 0)
      map_.warnings.push_back(fmt::format(
          "daylight: {} of {} directions have a channel below 0 in Rec. 709; it is set to 0",
          negative, map_.radiance.size()));
  }

  // Adds to each texel the share of it that the disc covers.
  void addSun() {
    struct Part {
      uint32_t x, y;
      double share;
    };
    std::vector<Part> parts;
    double covered = 0.0;
    constexpr int n = 16;
    const double reach = 2.0 * kSunRadius + 2.0 * kPi / map_.height;
    for (uint32_t y = 0; y < map_.height; ++y) {
      for (uint32_t x = 0; x < map_.width; ++x) {
        if (glm::dot(directionAt(x + 0.5, y + 0.5), sun_) < std::cos(reach)) continue;
        int inside = 0;
        for (int i = 0; i < n * n; ++i) {
          const glm::dvec3 dir = directionAt(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n);
          inside += glm::length(glm::cross(dir, sun_)) < std::sin(kSunRadius);
        }
        if (inside == 0) continue;
        parts.push_back({x, y, double(inside) / (n * n)});
        covered += parts.back().share * solidAngleOf(y);
      }
    }
    if (parts.empty()) {  // texels larger than the disc: it is in one of them
      const double turns = d_.azimuth / 360.0 + 0.5;
      const auto x = static_cast<uint32_t>((turns - std::floor(turns)) * map_.width);
      const auto y = static_cast<uint32_t>((90.0 - d_.elevation) / 180.0 * map_.height);
      parts.push_back({x % map_.width, y, 1.0});
      covered = solidAngleOf(y);
    }
    const glm::dvec3 radiance = sunTransmittance(d_) * (d_.sun * kSunIlluminance / covered);
    for (const Part& part : parts) texel(part.x, part.y) += glm::vec3(radiance * part.share);
  }

  void addGround() {
    glm::dvec3 irradiance(0.0);
    for (uint32_t y = 0; y < map_.height / 2; ++y) {
      const double weight = directionAt(0.5, y + 0.5).y * solidAngleOf(y);
      for (uint32_t x = 0; x < map_.width; ++x) irradiance += glm::dvec3(texel(x, y)) * weight;
    }
    const glm::vec3 ground(irradiance * (d_.ground / kPi));
    for (uint32_t y = map_.height / 2; y < map_.height; ++y) {
      for (uint32_t x = 0; x < map_.width; ++x) texel(x, y) += ground;
    }
  }

  Daylight d_;
  glm::dvec3 sun_;
  std::array<glm::dvec3, 5> coefficients_;
  glm::dvec3 scale_{0.0};
  EnvironmentMap map_;
};

struct Range {
  const char* name;
  double Daylight::*value;
  double low, high;
};
constexpr std::array<Range, 5> kParameters{{{"elevation", &Daylight::elevation, 1.0, 90.0},
                                            {"azimuth", &Daylight::azimuth, -360.0, 360.0},
                                            {"turbidity", &Daylight::turbidity, 2.0, 10.0},
                                            {"ground", &Daylight::ground, 0.0, 1.0},
                                            {"sun", &Daylight::sun, 0.0, 1.0}}};

}  // namespace

glm::dvec3 skyYxy(const Daylight& daylight, const glm::dvec3& dirW) {
  return Builder(daylight, 2, 2).skyYxy(dirW);
}

EnvironmentMap daylightMap(const Daylight& daylight, uint32_t width, uint32_t height) {
  return Builder(daylight, width, height).take();
}

bool isDaylightName(const std::string& name) {
  return name == "daylight" || name.compare(0, 9, "daylight?") == 0;
}

Daylight parseDaylight(const std::string& name) {
  Daylight daylight;
  if (name.size() <= 9) return daylight;
  std::set<std::string> seen;
  for (size_t from = 9; from <= name.size();) {
    const size_t end = std::min(name.find('&', from), name.size());
    const std::string part = name.substr(from, end - from);
    from = end + 1;
    const size_t equals = std::min(part.find('='), part.size());
    const std::string key = part.substr(0, equals);
    const std::string text = equals < part.size() ? part.substr(equals + 1) : "";
    const auto known = std::find_if(kParameters.begin(), kParameters.end(),
                                    [&](const Range& range) { return key == range.name; });
    if (known == kParameters.end()) {
      failInput(fmt::format(
          "{}: no parameter '{}'; elevation, azimuth, turbidity, ground and sun are there", name,
          key));
    }
    if (!seen.insert(key).second) failInput(fmt::format("{}: '{}' is given twice", name, key));
    double value = 0.0;
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber = status == std::errc() && stop == text.data() + text.size();
    if (!isNumber || !(value >= known->low && value <= known->high)) {
      failInput(fmt::format("{}: {} is '{}'; a number from {:g} to {:g} expected", name, key, text,
                            known->low, known->high));
    }
    daylight.*known->value = value;
  }
  return daylight;
}

}  // namespace restlab
