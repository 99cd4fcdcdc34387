#include "core/scene/mitsuba/emitters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/textures/daylight.h"

namespace restlab::mitsuba {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint64_t kMostMapBytes = uint64_t(1) << 32;

std::string nameOfEmitter(const Element& element, const Context& context) {
  return element.id.empty() ? fmt::format("{} {}", element.type, context.scene.lights.size())
                            : element.id;
}

// +Z of the transform.
glm::dvec3 forwardOf(const glm::dmat4& toWorld) { return glm::normalize(glm::dvec3(toWorld[2])); }

PunctualLight lampOf(const Element& element, const Context& context, Parameters& p,
                     const char* quantity, uint32_t kind) {
  PunctualLight light;
  light.name = nameOfEmitter(element, context);
  light.kind = kind;
  const glm::dmat4 toWorld = p.transform("to_world");
  light.posW = glm::dvec3(toWorld[3]);
  light.dirW = forwardOf(toWorld);
  light.intensity =
      p.color(quantity, glm::dvec3(1.0), Quantity::radiance) * p.number("scale", 1.0, 0.0, 1e12);
  p.ignore({"sampling_weight"});
  return light;
}

void addSpot(const Element& element, const Context& context, Parameters& p) {
  PunctualLight light = lampOf(element, context, p, "intensity", rl::RL_LIGHT_SPOT);
  const double cutoff = p.number("cutoff_angle", 20.0, 0.01, 90.0);
  const double beam = p.number("beam_width", 0.75 * cutoff, 0.0, cutoff);
  if (p.has("texture"))
    context.report.warn("spot texture", p.place(), "the texture of a 'spot' is not read");
  light.outerConeAngle = float(cutoff * kPi / 180.0);
  light.innerConeAngle = float(std::min(beam, 0.999 * cutoff) * kPi / 180.0);
  context.report.note(
      "spot", p.place(),
      "emitter 'spot' falls off between beam_width and cutoff_angle as glTF's does, "
      "not linearly");
  context.scene.lights.push_back(light);
}

void addPoint(const Element& element, const Context& context, Parameters& p) {
  PunctualLight light = lampOf(element, context, p, "intensity", rl::RL_LIGHT_POINT);
  if (p.has("position")) light.posW = p.vector("position", glm::dvec3(0.0));
  context.scene.lights.push_back(light);
}

void addDirectional(const Element& element, const Context& context, Parameters& p) {
  PunctualLight light = lampOf(element, context, p, "irradiance", rl::RL_LIGHT_DIRECTIONAL);
  if (p.has("direction")) {
    const glm::dvec3 direction = p.vector("direction", glm::dvec3(0.0, 0.0, 1.0));
    if (!(glm::length(direction) > 0.0)) p.fail("direction", "'direction' has no length");
    light.dirW = glm::normalize(direction);
  }
  context.scene.lights.push_back(light);
}

void setEnvironment(const Element& element, const Context& context, EnvironmentMap map) {
  if (context.scene.environment)
    context.report.fail(element.place, fmt::format("emitter '{}' is a second one around the scene; "
                                                   "one expected",
                                                   element.type));
  context.scene.environment = std::move(map);
}

// The map turned by any rotation: each texel takes the value that lies in its direction.
void turnMap(EnvironmentMap& map, const glm::dmat3& toMap) {
  std::vector<glm::vec3> turned(map.radiance.size());
  const double w = map.width, h = map.height;
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      const double phi = ((x + 0.5) / w) * 2.0 * kPi, theta = ((y + 0.5) / h) * kPi;
      const glm::dvec3 d = toMap * glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                              -std::sin(theta) * std::cos(phi));
      double u = std::atan2(d.x, -d.z) / (2.0 * kPi);
      u -= std::floor(u);
      const double v = std::atan2(std::hypot(d.x, d.z), d.y) / kPi;
      const double column = u * w - 0.5, row = v * h - 0.5;
      const double fx = std::floor(column), fy = std::floor(row);
      const auto texel = [&](double i, double j) {
        const uint32_t xx = uint32_t(std::fmod(i + w, w)),
                       yy = uint32_t(std::clamp(j, 0.0, h - 1.0));
        return map.radiance[size_t(yy) * map.width + xx];
      };
      const glm::vec3 above = glm::mix(texel(fx, fy), texel(fx + 1, fy), float(column - fx)),
                      below =
                          glm::mix(texel(fx, fy + 1), texel(fx + 1, fy + 1), float(column - fx));
      turned[size_t(y) * map.width + x] = glm::mix(above, below, float(row - fy));
    }
  }
  map.radiance = std::move(turned);
}

void addMap(const Element& element, const Context& context, Parameters& p) {
  const std::string name = p.text("filename", "");
  if (!p.has("filename")) p.fail("filename", "the envmap has no 'filename'");
  const std::filesystem::path file = context.files.find(name, p.place());
  context.files.read(file, p.place(), kMostMapBytes);  // for the hash
  EnvironmentMap map = loadEnvironment(file);
  map.scale = float(p.number("scale", 1.0, 0.0, 1e9));
  for (const std::string& warning : map.warnings)
    context.report.warn("environment", p.place(), warning);
  map.warnings.clear();
  glm::dmat3 turn(p.transform("to_world"));
  for (int axis = 0; axis < 3; ++axis) turn[axis] = glm::normalize(turn[axis]);
  p.ignore({"sampling_weight", "mis_compensation", "cache"});
  // Mitsuba's map begins where this one has its middle: towards -Z.
  const bool isAboutY = std::abs(turn[1].y - 1.0) < 1e-6 && glm::determinant(turn) > 0.0;
  if (isAboutY) {
    map.rotation = float(kPi + std::atan2(turn[2].x, turn[2].z));
  } else {
    context.report.warn("rotation of the environment", p.place(),
                        "to_world turns the map about another axis than +Y: it is resampled");
    turnMap(map, glm::inverse(turn));
    map.rotation = float(kPi);
  }
  setEnvironment(element, context, std::move(map));
}

void addConstant(const Element& element, const Context& context, Parameters& p) {
  EnvironmentMap map;
  map.source = "constant";
  map.width = 2;
  map.height = 1;
  map.radiance.assign(2, p.color("radiance", glm::dvec3(1.0), Quantity::radiance));
  p.ignore({"sampling_weight"});
  setEnvironment(element, context, std::move(map));
}

// Sun and sky by turbidity and the sun's direction.
void addSky(const Element& element, const Context& context, Parameters& p) {
  Daylight daylight;
  daylight.turbidity = std::clamp(p.number("turbidity", 3.0, 1.0, 10.0), 2.0, 10.0);
  const glm::dvec3 sun = glm::normalize(p.vector("sun_direction", {0.0, 1.0, 1.0}));
  daylight.elevation = std::asin(std::clamp(sun.y, -1.0, 1.0)) * 180.0 / kPi;
  daylight.azimuth = std::atan2(sun.x, -sun.z) * 180.0 / kPi;
  if (!(daylight.elevation >= 1.0))
    p.fail("sun_direction", fmt::format("the sun is {:.3g} degrees above the horizon; at least 1 "
                                        "expected (+Y is up)",
                                        daylight.elevation));
  daylight.ground =
      std::clamp(p.color("albedo", glm::dvec3(0.15), Quantity::reflectance).y, 0.0, 1.0);
  daylight.sun = element.type == "sky" ? 0.0 : 1.0;
  const double scale = p.number("scale", 1.0, 0.0, 1e9);
  EnvironmentMap map = daylightMap(daylight);
  map.scale = float(scale);
  context.report.note("sky", p.place(),
                      fmt::format("emitter '{}' is Preetham's sky with a luminance in kcd/m^2; "
                                  "Mitsuba's may be brighter or darker by a factor",
                                  element.type));
  setEnvironment(element, context, std::move(map));
}

}  // namespace

void addEmitter(const Element& element, const Context& context) {
  Parameters p(element, context);
  const std::string& type = element.type;
  if (type == "point") {
    addPoint(element, context, p);
  } else if (type == "spot") {
    addSpot(element, context, p);
  } else if (type == "directional") {
    addDirectional(element, context, p);
  } else if (type == "constant") {
    addConstant(element, context, p);
  } else if (type == "envmap") {
    addMap(element, context, p);
  } else if (type == "sky" || type == "sunsky") {
    addSky(element, context, p);
  } else {
    const std::string text =
        type == "area"
            ? std::string("emitter 'area' stands outside of a shape")
            : fmt::format(
                  "emitter '{}' is unknown; one of area, point, spot, directional, constant, "
                  "envmap, sky, sunsky expected",
                  type);
    if (!context.allowsUnknown) context.report.fail(element.place, text);
    context.report.warn("unknown emitter", element.place, text + "; it is left out");
    return;
  }
  p.finish();
}

TexturedColor areaEmission(const Element& element, const Context& context, Textures& textures) {
  Parameters p(element, context);
  if (element.type != "area") {
    const std::string text =
        fmt::format("emitter '{}' of a shape is unknown; area expected", element.type);
    if (!context.allowsUnknown) context.report.fail(element.place, text);
    context.report.warn("unknown emitter", element.place, text + "; it does not shine");
    return {glm::dvec3(0.0), {}};
  }
  const TexturedColor radiance = textures.color(p, "radiance", glm::dvec3(1.0), Quantity::radiance);
  p.ignore({"sampling_weight"});
  p.finish();
  return radiance;
}

}  // namespace restlab::mitsuba
