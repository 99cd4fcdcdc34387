#include "experiments/python/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "experiments/python/values.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLeastYfov = 0.01, kMostYfov = 179.0;  // degrees
// The sine of the angle between view and up below which right is not defined.
constexpr double kLeastSine = 1e-6;
// Largest number of a vector: squares of float32 beyond it are infinite, and rays have no
// direction.
constexpr double kMostOfVector = 1e15;

glm::dvec3 vectorOf(const py::handle& object, const std::string& name) {
  glm::dvec3 vector(0.0);
  bool isGood = py::isinstance<py::sequence>(object) && !py::isinstance<py::str>(object) &&
                py::len(object) == 3;
  for (int i = 0; isGood && i < 3; ++i) {
    const py::object item = py::reinterpret_borrow<py::sequence>(object)[size_t(i)];
    const double number = PyFloat_AsDouble(item.ptr());
    if (PyErr_Occurred()) PyErr_Clear(), isGood = false;
    vector[i] = number;
    isGood = isGood && std::abs(number) <= kMostOfVector;
  }
  if (!isGood)
    failUsage(
        fmt::format("{} {}: must be three numbers of at most 1e15, for example (0.0, 1.0, 4.0)",
                    name, py::repr(object).cast<std::string>()));
  return vector;
}

py::tuple tupleOf(const glm::dvec3& vector) { return py::make_tuple(vector.x, vector.y, vector.z); }

glm::dvec3 axisOf(const SceneCamera& camera, int column) {
  return glm::normalize(glm::dvec3(camera.cameraToWorld[column]));
}

}  // namespace

SceneCamera cameraWith(const SceneCamera& camera, const py::kwargs& keywords) {
  SceneCamera changed = camera;
  glm::dvec3 position = positionOf(camera), direction = -axisOf(camera, 2), up = axisOf(camera, 1);
  bool isTurned = false;
  if (keywords.contains("target") && keywords.contains("direction"))
    failUsage("set_camera: target and direction exclude each other");
  if (keywords.contains("position")) position = vectorOf(keywords["position"], "position");
  for (const auto& [key, value] : keywords) {
    const std::string name = py::str(key);
    if (name == "position") continue;
    if (name == "target") {
      direction = vectorOf(value, name) - position;
    } else if (name == "direction") {
      direction = vectorOf(value, name);
    } else if (name == "up") {
      up = vectorOf(value, name);
    } else if (name == "yfov") {
      const ParameterValue given = valueOf(value, name);
      const double* number = std::get_if<double>(&given);
      const int64_t* whole = std::get_if<int64_t>(&given);
      const double degrees = number ? *number : whole ? double(*whole) : 0.0;
      if (!(degrees >= kLeastYfov && degrees <= kMostYfov))
        failUsage(fmt::format("yfov {}: must be {:g} to {:g} degrees",
                              py::str(value).cast<std::string>(), kLeastYfov, kMostYfov));
      if (camera.kind != rl::RL_CAMERA_PERSPECTIVE)
        failUsage("yfov: the camera is orthographic and has no angle");
      changed.yfov = degrees / kDegrees;
      continue;
    } else {
      failUsage(fmt::format(
          "set_camera: unknown keyword '{}' (known: position, target, direction, up, yfov){}", name,
          didYouMean(name, {"position", "target", "direction", "up", "yfov"})));
    }
    isTurned = true;
  }
  if (!isTurned) {
    changed.cameraToWorld[3] = glm::dvec4(position, 1.0);
    return changed;
  }
  const glm::dvec3 right = glm::cross(direction, up);
  if (!(glm::length(right) > kLeastSine * glm::length(direction) * glm::length(up)))
    failUsage("set_camera: the camera would look along its up; give another up or target");
  const glm::dvec3 back = -glm::normalize(direction), side = glm::normalize(right);
  changed.cameraToWorld = glm::dmat4(glm::dvec4(side, 0.0), glm::dvec4(glm::cross(back, side), 0.0),
                                     glm::dvec4(back, 0.0), glm::dvec4(position, 1.0));
  return changed;
}

py::dict cameraDict(const SceneCamera& camera) {
  py::dict words;
  words["name"] = strOf(camera.name);
  words["position"] = tupleOf(positionOf(camera));
  words["direction"] = tupleOf(-axisOf(camera, 2));
  words["up"] = tupleOf(axisOf(camera, 1));
  words["yfov"] = camera.kind == rl::RL_CAMERA_PERSPECTIVE
                      ? py::object(py::float_(camera.yfov * kDegrees))
                      : py::object(py::none());
  return words;
}

}  // namespace restlab::python
