#include "core/scene/mitsuba/sensor.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace restlab::mitsuba {
namespace {

struct Film {
  double width = 768.0, height = 576.0;  // pixels
};

Film filmOf(Parameters& sensor, const Context& context) {
  Film film;
  const std::vector<const Element*> films = sensor.plugins("film");
  if (films.empty()) return film;
  Parameters p(*films[0], context);
  film.width = double(p.integer("width", 768, 1, 1 << 20));
  film.height = double(p.integer("height", 576, 1, 1 << 20));
  if (p.has("crop_width") || p.has("crop_height") || p.has("crop_offset_x") ||
      p.has("crop_offset_y")) {
    p.ignore({"crop_width", "crop_height", "crop_offset_x", "crop_offset_y"});
    context.report.warn("crop", p.place(),
                        "the film's crop window is not read: the whole film is drawn");
  }
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
  camera.aspect = film.width / film.height;
  const glm::dmat4 toWorld = p.transform("to_world");
  place(camera, toWorld);
  if (isFlat) {
    camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
    camera.xmag = glm::length(glm::dvec3(toWorld[0]));
    camera.ymag = glm::length(glm::dvec3(toWorld[1])) / camera.aspect;
    camera.aspect = camera.xmag / camera.ymag;
  } else {
    camera.kind = rl::RL_CAMERA_PERSPECTIVE;
    camera.yfov = 2.0 * std::atan(halfHeight(p, film));
  }
  if (type == "thinlens") {
    p.ignore({"aperture_radius", "focus_distance"});
    context.report.warn("thin lens", p.place(),
                        "sensor 'thinlens' is drawn as a pinhole: all is sharp");
  }
  if (p.has("principal_point_offset_x") || p.has("principal_point_offset_y"))
    context.report.warn("principal point", p.place(),
                        "the principal point is not read: it is the middle of the image");
  p.plugins("sampler");
  p.ignore(
      {"near_clip", "far_clip", "shutter_open", "shutter_close", "focus_distance", "fov_axis"});
  p.finish();
  context.report.note(
      "film", p.place(),
      fmt::format("the film has {:g}x{:g} pixels: --resolution {:g}x{:g} renders at "
                  "that size",
                  film.width, film.height, film.width, film.height));
  context.scene.cameras.push_back(std::move(camera));
}

}  // namespace restlab::mitsuba
