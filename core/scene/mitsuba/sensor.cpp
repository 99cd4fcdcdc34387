#include "core/scene/mitsuba/sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace restlab::mitsuba {
namespace {

struct Film {
  double width = 768.0, height = 576.0;  // pixels
  // The window that is drawn, and the middle that is looked at, of the whole film.
  double x = 0.0, y = 0.0, windowWidth = 768.0, windowHeight = 576.0;
};

Film filmOf(Parameters& sensor, const Context& context) {
  Film film;
  const std::vector<const Element*> films = sensor.plugins("film");
  if (films.empty()) return film;
  Parameters p(*films[0], context);
  const auto side = [&](const char* name, int64_t fallback, int64_t most) {
    return p.integer(name, fallback, 1, most);
  };
  const int64_t width = side("width", 768, 1 << 20), height = side("height", 576, 1 << 20);
  const int64_t x = p.integer("crop_offset_x", 0, 0, width - 1),
                y = p.integer("crop_offset_y", 0, 0, height - 1);
  film.windowWidth = double(side("crop_width", width - x, width - x));
  film.windowHeight = double(side("crop_height", height - y, height - y));
  film.width = double(width);
  film.height = double(height);
  film.x = double(x);
  film.y = double(y);
  return film;
}

// Half the height of the image at a distance of 1 from the given angle.
double halfHeight(Parameters& p, const Film& film) {
  const double aspect = film.width / film.height;
  std::string axis = p.choice("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
  double half = 0.0;  // tangent of half the angle along the axis
  if (p.has("fov")) {
    half = std::tan(0.5 * p.number("fov", 50.0, 1e-3, 179.9) * std::numbers::pi / 180.0);
  } else {
    std::string length = p.text("focal_length", "50mm");
    if (length.ends_with("mm")) length.resize(length.size() - 2);
    double millimetres = 0.0;
    try {
      millimetres = std::stod(length);
    } catch (const std::exception&) {
    }
    if (!(millimetres >= 0.1 && millimetres <= 1e5))
      p.fail("focal_length",
             "'focal_length' is no length in millimetres of a film of 35 mm, as 50mm");
    half = 0.5 * std::hypot(36.0, 24.0) / millimetres;
    axis = "diagonal";
  }
  if (axis == "smaller") axis = aspect > 1.0 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1.0 ? "x" : "y";
  if (axis == "diagonal") return half / std::hypot(1.0, aspect);
  return axis == "x" ? half / aspect : half;
}

// Axes of restlab's cameras: +X right, -Z ahead.
void place(SceneCamera& camera, const glm::dmat4& toWorld) {
  const glm::dmat3 axes(toWorld);
  camera.isMirrored = glm::determinant(axes) < 0.0;
  const double side = camera.isMirrored ? 1.0 : -1.0;
  camera.cameraToWorld[0] = glm::dvec4(side * axes[0], 0.0);
  camera.cameraToWorld[1] = glm::dvec4(axes[1], 0.0);
  camera.cameraToWorld[2] = glm::dvec4(-axes[2], 0.0);
  camera.cameraToWorld[3] = toWorld[3];
}

// The part of the film that is drawn. `half`: half extents of the whole.
void showWindow(Parameters& p, const Film& film, const glm::dvec2& half, bool isFlat,
                SceneCamera& camera) {
  const glm::dvec2 share(film.windowWidth / film.width, film.windowHeight / film.height);
  const double offX = isFlat ? 0.0 : p.number("principal_point_offset_x", 0.0, -100.0, 100.0),
               offY = isFlat ? 0.0 : p.number("principal_point_offset_y", 0.0, -100.0, 100.0);
  const glm::dvec2 shown = half * share;
  camera.shift = {half.x * (2.0 * (film.x / film.width + offX) + share.x - 1.0),
                  half.y * (1.0 - share.y - 2.0 * (film.y / film.height + offY))};
  if (glm::length(camera.shift) < 1e-12 * glm::length(half)) camera.shift = glm::dvec2(0.0);
  camera.aspect = shown.x / shown.y;
  if (isFlat) {
    camera.xmag = shown.x;
    camera.ymag = shown.y;
  } else {
    camera.yfov = 2.0 * std::atan(shown.y);
  }
  // Pixels are square here: a film of others keeps its width.
  const double rows = std::round(film.windowWidth / camera.aspect);
  camera.film = {uint32_t(film.windowWidth), uint32_t(std::clamp(rows, 1.0, double(1 << 20)))};
}

}  // namespace

void addSensor(const Element& element, const Context& context) {
  Parameters p(element, context);
  const std::string& type = element.type;
  const bool isFlat = type == "orthographic";
  if (type != "perspective" && type != "thinlens" && !isFlat) {
    const std::string text = fmt::format(
        "sensor '{}' is unknown; one of perspective, thinlens, orthographic expected", type);
    if (!context.allowsUnknown) context.report.fail(element.place, text);
    context.report.warn("unknown sensor", element.place, text + "; it is left out");
    return;
  }
  SceneCamera camera;
  const Film film = filmOf(p, context);
  camera.name =
      element.id.empty() ? fmt::format("camera{}", context.scene.cameras.size()) : element.id;
  const glm::dmat4 toWorld = p.transform("to_world");
  place(camera, toWorld);
  // Half extents of the whole film.
  glm::dvec2 half(0.0);
  if (isFlat) {
    camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
    half = {glm::length(glm::dvec3(toWorld[0])),
            glm::length(glm::dvec3(toWorld[1])) * film.height / film.width};
  } else {
    camera.kind = rl::RL_CAMERA_PERSPECTIVE;
    half.y = halfHeight(p, film);
    half.x = half.y * film.width / film.height;
  }
  showWindow(p, film, half, isFlat, camera);
  if (type == "thinlens") {
    p.ignore({"aperture_radius", "focus_distance"});
    context.report.warn("thin lens", p.place(),
                        "sensor 'thinlens' is drawn as a pinhole: all is sharp");
  }
  p.plugins("sampler");
  p.ignore(
      {"near_clip", "far_clip", "shutter_open", "shutter_close", "focus_distance", "fov_axis"});
  p.finish();
  context.report.note(
      "film", p.place(),
      fmt::format("images have the {}x{} pixels of the film, unless --resolution says otherwise{}",
                  camera.film.x, camera.film.y,
                  camera.film.y == uint32_t(film.windowHeight)
                      ? ""
                      : fmt::format(" (not {:g} rows, whose pixels would not be square)",
                                    film.windowHeight)));
  context.scene.cameras.push_back(std::move(camera));
}

}  // namespace restlab::mitsuba
