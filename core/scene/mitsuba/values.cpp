#include "core/scene/mitsuba/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/image/color.h"
#include "core/scene/mitsuba/spectrum.h"

namespace restlab::mitsuba {
namespace {

constexpr uint64_t kMostSpectrumBytes = 1u << 20;

bool isGap(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r'; }

std::string shortened(const std::string& text) {
  return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

// "#rrggbb", each 0 to 1.
glm::dvec3 hexColor(const std::string& text, const std::string& place, const Report& report) {
  uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, value, 16);
  if (text.size() != 7 || error != std::errc() || stop != end)
    report.fail(place, fmt::format("'{}' is no colour; #rrggbb expected", shortened(text)));
  return glm::dvec3(value >> 16, (value >> 8) & 255u, value & 255u) / 255.0;
}

glm::dvec3 tripleOf(const std::string& text, const std::string& place, const Report& report) {
  const size_t first = text.find_first_not_of(" \t\n\r");
  if (first != std::string::npos && text[first] == '#')
    return hexColor(text.substr(first, text.find_last_not_of(" \t\n\r") + 1 - first), place,
                    report);
  const std::vector<double> v = parseNumbers(text, place, report);
  if (v.size() == 1) return glm::dvec3(v[0]);
  if (v.size() != 3)
    report.fail(place, fmt::format("'{}' has {} numbers; 3 or #rrggbb expected", shortened(text),
                                   v.size()));
  return {v[0], v[1], v[2]};
}

// "400:0.1, 500:0.2" or, in files, "400 0.1" a line.
Spectrum spectrumOf(std::string text, const std::string& place, const Report& report) {
  for (char& c : text)
    if (c == ':') c = ' ';
  const std::vector<double> v = parseNumbers(text, place, report);
  if (v.size() < 4 || v.size() % 2 != 0)
    report.fail(place,
                fmt::format("a spectrum of {} numbers; at least two pairs of a wavelength in "
                            "nanometres and a value expected",
                            v.size()));
  Spectrum spectrum;
  for (size_t i = 0; i < v.size(); i += 2) {
    if (i > 0 && !(v[i] > v[i - 2]))
      report.fail(place, fmt::format("wavelength {:g} does not follow {:g} in ascending order",
                                     v[i], v[i - 2]));
    spectrum.emplace_back(v[i], v[i + 1]);
  }
  return spectrum;
}

std::string spectrumText(const Element& element, Files& files, const Report& report) {
  const std::string* name = element.attribute("filename");
  if (name == nullptr) return valueOf(element, report);
  const std::vector<uint8_t> bytes =
      files.read(files.find(*name, element.place), element.place, kMostSpectrumBytes);
  std::string text(bytes.begin(), bytes.end()), kept;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find('#') == std::string::npos) kept += line + "\n";
    begin = end + 1;
  }
  return kept;
}

double partOf(const Element& element, const char* name, double fallback, const Report& report) {
  const std::string* text = element.attribute(name);
  return text == nullptr ? fallback : parseNumber(*text, element.place, report);
}

glm::dvec3 partsOf(const Element& element, double fallback, const Report& report) {
  const std::string* value = element.attribute("value");
  if (value == nullptr)
    return {partOf(element, "x", fallback, report), partOf(element, "y", fallback, report),
            partOf(element, "z", fallback, report)};
  const std::vector<double> v = parseNumbers(*value, element.place, report);
  if (v.size() == 1 && element.tag == "scale") return glm::dvec3(v[0]);
  if (v.size() != 3)
    report.fail(element.place,
                fmt::format("'{}' has {} numbers; 3 expected", shortened(*value), v.size()));
  return {v[0], v[1], v[2]};
}

glm::dmat4 matrixOf(const Element& element, bool isPlanar, const Report& report) {
  const std::vector<double> v = parseNumbers(valueOf(element, report), element.place, report);
  glm::dmat4 matrix(1.0);
  if (v.size() == 16) {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) matrix[column][row] = v[size_t(4 * row + column)];
    constexpr double kTolerance = 1e-6;
    if (glm::length(glm::dvec4(v[12], v[13], v[14], v[15] - 1.0)) > kTolerance)
      report.fail(element.place,
                  fmt::format("the last row is {:g} {:g} {:g} {:g}; 0 0 0 1 expected", v[12], v[13],
                              v[14], v[15]));
    for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1.0 : 0.0;
    return matrix;
  }
  if (v.size() != 9)
    report.fail(element.place, fmt::format("a matrix of {} numbers; 16 or 9 expected", v.size()));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double value = v[size_t(3 * row + column)];
      if (!isPlanar) {
        matrix[column][row] = value;
      } else if (row < 2) {
        matrix[column == 2 ? 3 : column][row] = value;
      }
    }
  return matrix;
}

glm::dmat4 rotationOf(const Element& element, const Report& report) {
  const glm::dvec3 axis = partsOf(element, 0.0, report);
  const std::string* angle = element.attribute("angle");
  if (angle == nullptr) report.fail(element.place, "<rotate> has no 'angle', in degrees");
  if (!(glm::length(axis) > 0.0))
    report.fail(element.place, "<rotate> has no axis; x=\"1\", y=\"1\" or z=\"1\" expected");
  return glm::rotate(glm::dmat4(1.0),
                     parseNumber(*angle, element.place, report) * std::numbers::pi / 180.0,
                     glm::normalize(axis));
}

glm::dmat4 lookAtOf(const Element& element, const Report& report) {
  const auto part = [&](const char* name) -> glm::dvec3 {
    const std::string* text = element.attribute(name);
    if (text == nullptr) {
      if (std::string(name) == "up") return {0.0, 1.0, 0.0};
      report.fail(element.place, fmt::format("<lookat> has no '{}'", name));
    }
    const std::vector<double> v = parseNumbers(*text, element.place, report);
    if (v.size() != 3)
      report.fail(element.place, fmt::format("'{}' has {} numbers; 3 expected", name, v.size()));
    return {v[0], v[1], v[2]};
  };
  return lookAt(part("origin"), part("target"), part("up"), element.place, report);
}

}  // namespace

std::vector<double> parseNumbers(const std::string& text, const std::string& place,
                                 const Report& report) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  while (true) {
    while (at < end && isGap(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+' && at + 1 < end) ++at;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(at, end, value);
    const bool isWhole = error == std::errc() && (stop == end || isGap(*stop));
    if (!isWhole || !std::isfinite(value))
      report.fail(place, fmt::format("'{}' is not finite numbers", shortened(text)));
    numbers.push_back(value);
    at = stop;
  }
}

double parseNumber(const std::string& text, const std::string& place, const Report& report) {
  const std::vector<double> v = parseNumbers(text, place, report);
  if (v.size() != 1) report.fail(place, fmt::format("'{}' is not a number", shortened(text)));
  return v[0];
}

const std::string& valueOf(const Element& element, const Report& report) {
  const std::string* value = element.attribute("value");
  if (value == nullptr) report.fail(element.place, fmt::format("<{}> has no 'value'", element.tag));
  return *value;
}

glm::dvec3 vectorOf(const Element& element, const Report& report) {
  if (element.tag != "point" && element.tag != "vector")
    report.fail(element.place, fmt::format("'{}' is a <{}>; <point> or <vector> expected",
                                           element.name, element.tag));
  return partsOf(element, 0.0, report);
}

bool isColor(const Element& element) {
  return element.tag == "rgb" || element.tag == "srgb" || element.tag == "spectrum" ||
         element.tag == "float" || element.tag == "integer";
}

glm::dvec3 colorOf(const Element& element, Quantity quantity, Files& files, Report& report) {
  const std::string& place = element.place;
  if (element.tag == "rgb" && element.attribute("value") == nullptr) {
    const auto part = [&](const char* name) { return partOf(element, name, 0.0, report); };
    return {part("r"), part("g"), part("b")};
  }
  if (element.tag == "rgb") return tripleOf(valueOf(element, report), place, report);
  if (element.tag == "srgb") {
    glm::dvec3 color = tripleOf(valueOf(element, report), place, report);
    for (int c = 0; c < 3; ++c) color[c] = decodeSrgb(color[c]);
    return color;
  }
  if (element.tag != "spectrum")
    return glm::dvec3(parseNumber(valueOf(element, report), place, report));
  if (!element.type.empty() && element.type != "uniform")
    report.fail(place, fmt::format("spectrum '{}' is not read; <rgb>, one number, or pairs "
                                   "\"400:0.1, 500:0.2\" expected",
                                   element.type));
  const std::string text = spectrumText(element, files, report);
  if (element.attribute("filename") == nullptr && text.find(':') == std::string::npos)
    return tripleOf(text, place, report);
  const bool isLight = quantity == Quantity::radiance;
  report.note(isLight ? "spectrum of light" : "spectrum of a surface", place,
              isLight ? "the spectrum is integrated to Rec. 709 by the CIE's observer of 1931"
                      : "the spectrum is integrated to Rec. 709 by the CIE's observer of 1931, "
                        "under the illuminant E, over its white");
  const Spectrum spectrum = spectrumOf(text, place, report);
  return isLight ? radianceOf(spectrum) : reflectanceOf(spectrum);
}

glm::dmat4 lookAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                  const std::string& place, const Report& report) {
  const glm::dvec3 toTarget = target - origin;
  const glm::dvec3 left = glm::cross(up, toTarget);
  if (!(glm::length(left) > 1e-12 * glm::length(up) * glm::length(toTarget)))
    report.fail(place, "<lookat>: 'target' is at 'origin', or 'up' is parallel to the view");
  const glm::dvec3 z = glm::normalize(toTarget), x = glm::normalize(left);
  return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
                    glm::dvec4(origin, 1.0));
}

glm::dmat4 transformOf(const Element& element, bool isPlanar, const Report& report) {
  if (element.tag != "transform")
    report.fail(element.place,
                fmt::format("'{}' is a <{}>; <transform> expected", element.name, element.tag));
  glm::dmat4 all(1.0);
  for (const Element& step : element.children) {
    glm::dmat4 one(1.0);
    if (step.tag == "translate") {
      one = glm::translate(one, partsOf(step, 0.0, report));
    } else if (step.tag == "scale") {
      one = glm::scale(one, partsOf(step, 1.0, report));
    } else if (step.tag == "rotate") {
      one = rotationOf(step, report);
    } else if (step.tag == "matrix") {
      one = matrixOf(step, isPlanar, report);
    } else if (step.tag == "lookat" || step.tag == "lookAt" || step.tag == "look_at") {
      one = lookAtOf(step, report);
    } else {
      report.fail(step.place,
                  fmt::format("<{}> is no step of a transform; translate, rotate, scale, "
                              "matrix or lookat expected",
                              step.tag));
    }
    all = one * all;
  }
  const double volume = glm::determinant(glm::dmat3(all));
  bool isFinite = std::isfinite(volume);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) isFinite = isFinite && std::abs(all[column][row]) <= 1e30;
  if (!isFinite || volume == 0.0)
    report.fail(element.place,
                "the transform is singular or not finite; one that can be inverted "
                "expected");
  return all;
}

}  // namespace restlab::mitsuba
