#include "core/scene/mitsuba/spectrum.h"

#include <algorithm>
#include <cmath>

namespace restlab::mitsuba {
namespace {

constexpr double kFirst = 360.0, kLast = 830.0;  // nanometres

// A lobe with another width on each side of its centre.
double lobe(double wavelength, double centre, double below, double above) {
  const double t = (wavelength - centre) / (wavelength < centre ? below : above);
  return std::exp(-0.5 * t * t);
}

double valueAt(const Spectrum& spectrum, double wavelength) {
  const auto isBelow = [](double w, const auto& entry) { return w < entry.first; };
  const auto next = std::upper_bound(spectrum.begin(), spectrum.end(), wavelength, isBelow);
  if (next == spectrum.begin()) return 0.0;
  const auto& [w0, v0] = *(next - 1);
  if (next == spectrum.end()) return wavelength > w0 ? 0.0 : v0;
  return v0 + (next->second - v0) * (wavelength - w0) / (next->first - w0);
}

// XYZ to linear Rec. 709 (IEC 61966-2-1).
glm::dvec3 rec709Of(const glm::dvec3& xyz) {
  return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
          -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
          0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

template <class Value>
glm::dvec3 integrated(const Value& value) {
  glm::dvec3 sum(0.0);
  double white = 0.0;
  for (double w = kFirst; w <= kLast; w += 1.0) {
    const glm::dvec3 weights = colorMatching(w);
    sum += weights * value(w);
    white += weights.y;
  }
  return rec709Of(sum / white);
}

}  // namespace

glm::dvec3 colorMatching(double w) {
  return {1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
              0.065 * lobe(w, 501.1, 20.4, 26.2),
          0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
          1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

glm::dvec3 radianceOf(const Spectrum& spectrum) {
  return integrated([&](double w) { return valueAt(spectrum, w); });
}

glm::dvec3 reflectanceOf(const Spectrum& spectrum) {
  static const glm::dvec3 kWhite = integrated([](double) { return 1.0; });
  return radianceOf(spectrum) / kWhite;
}

}  // namespace restlab::mitsuba
