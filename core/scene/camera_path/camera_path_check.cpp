// cameraPathWarnings(): tests a few rays per path against the scene's triangles one by one, in
// double precision.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/error.h"
#include "core/scene/camera_path/camera_path.h"

namespace restlab {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
// Limits on the frames of a path that are checked; both ends are always checked. Scenes with many
// triangles get fewer frames, to stay within kMostTests ray-triangle tests.
constexpr uint32_t kMostSteps = 16, kMostViews = 8;
constexpr double kMostTests = 2e8;
// Rays per side of a view, to find out what fills it and what is near.
constexpr int kViewSide = 5;
// Tolerance of a step, relative to coordinates and to the edges of a triangle.
constexpr double kBeginSlack = 1e-12, kEdgeSlack = 1e-9;

struct Ray {
  glm::dvec3 originW, dirW;
  double length = kNone;  // in lengths of dirW
  // Above 0 only for a step of the camera: rounding error of the step's start, in lengths of dirW.
  // A face within it counts if the step enters the face from the front.
  double slack = 0.0;
  // First hit: distance, instance, whether from behind, and unit normal.
  double t = kNone;
  size_t instance = 0;
  bool isBehind = false;
  glm::dvec3 normalW{0.0};
};

struct Triangle {
  glm::dvec3 a, edge1, edge2;
};

void meet(const Triangle& triangle, size_t instance, bool isFlipped, Ray& ray) {
  const glm::dvec3 across = glm::cross(ray.dirW, triangle.edge2);
  const double determinant = glm::dot(triangle.edge1, across);
  if (determinant == 0.0) return;
  const glm::dvec3 offset = ray.originW - triangle.a;
  const double u = glm::dot(offset, across) / determinant;
  // Widen edges for steps: a step through the middle of a box meets the edge that two triangles
  // share.
  const double edge = ray.slack > 0.0 ? kEdgeSlack : 0.0;
  if (!(u >= -edge && u <= 1.0 + edge)) return;
  const glm::dvec3 turned = glm::cross(offset, triangle.edge1);
  const double v = glm::dot(ray.dirW, turned) / determinant;
  if (!(v >= -edge && u + v <= 1.0 + edge)) return;
  const double t = glm::dot(triangle.edge2, turned) / determinant;
  const bool isBehind = (determinant < 0.0) != isFlipped;
  const bool isAtBegin = std::abs(t) <= ray.slack;
  if (isAtBegin ? isBehind : !(t > 0.0)) return;
  if (!(t <= ray.length && t < ray.t)) return;
  ray.t = t;
  ray.instance = instance;
  ray.isBehind = isBehind;
  ray.normalW = glm::normalize(glm::cross(triangle.edge1, triangle.edge2));
}

void meetAll(const Scene& scene, std::vector<Ray>& rays) {
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    const MeshGeometry& geometry = scene.geometries[instance.geometry];
    const bool isFlipped = glm::determinant(glm::dmat3(instance.objectToWorld)) < 0.0;
    const auto corner = [&](uint32_t index) {
      return glm::dvec3(instance.objectToWorld * glm::dvec4(geometry.positions[index], 1.0));
    };
    for (const glm::uvec3& indices : geometry.triangles) {
      const glm::dvec3 a = corner(indices.x);
      const Triangle triangle = {a, corner(indices.y) - a, corner(indices.z) - a};
      for (Ray& ray : rays) meet(triangle, i, isFlipped, ray);
    }
  }
}

size_t trianglesOf(const Scene& scene) {
  size_t count = 0;
  for (const MeshInstance& instance : scene.instances)
    count += scene.geometries[instance.geometry].triangles.size();
  return count;
}

// Adds rays of a view. dirW has length 1 along the view axis, so that `t` is the depth.
void addView(const SceneCamera& camera, std::vector<Ray>& rays) {
  const glm::dvec3 back = glm::normalize(glm::dvec3(camera.cameraToWorld[2]));
  const glm::dvec3 up =
      glm::normalize(glm::cross(back, glm::normalize(glm::dvec3(camera.cameraToWorld[0]))));
  const glm::dvec3 right = glm::cross(up, back);
  const bool isFlat = camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC;
  const double aspect = camera.aspect > 0.0 ? camera.aspect : 1.0;
  const double halfHeight = isFlat ? camera.ymag : std::tan(0.5 * camera.yfov);
  const double halfWidth = isFlat ? camera.xmag : halfHeight * aspect;
  for (int y = 0; y < kViewSide; ++y) {
    for (int x = 0; x < kViewSide; ++x) {
      // Stay inside the corners, and off the edges that triangles of a wall share.
      const glm::dvec3 aside =
          right * (halfWidth * (2.0 * (x + 0.53) / kViewSide - 1.0) + camera.shift.x) +
          up * (halfHeight * (2.0 * (y + 0.47) / kViewSide - 1.0) + camera.shift.y);
      Ray ray;
      ray.originW = positionOf(camera) + (isFlat ? aside : glm::dvec3(0.0));
      ray.dirW = -back + (isFlat ? glm::dvec3(0.0) : aside);
      rays.push_back(ray);
    }
  }
}

// Adds rays to all sides, off the axes: edges of a scene often lie along the axes.
void addSides(const SceneCamera& camera, std::vector<Ray>& rays) {
  for (const double x : {-1.0, 0.07, 1.0}) {
    for (const double y : {-0.83, 0.91}) {
      Ray ray;
      ray.originW = positionOf(camera);
      ray.dirW = glm::normalize(glm::dvec3(x, y, x * y > 0.0 ? 0.79 : -0.87));
      rays.push_back(ray);
    }
  }
}

std::string objectName(const Scene& scene, const Ray& ray) {
  const std::string& name = scene.instances[ray.instance].name;
  return name.empty() ? "an object" : fmt::format("'{}'", oneLine(name));
}

using Rays = std::span<const Ray>;

// Returns a ray to the object if all sides see the inside of one object, else null.
const Ray* insideOf(Rays sides) {
  const bool isInside = std::all_of(sides.begin(), sides.end(), [&](const Ray& ray) {
    return ray.t < kNone && ray.isBehind && ray.instance == sides[0].instance;
  });
  return isInside ? &sides[0] : nullptr;
}

const Ray* nearestOf(Rays view) {
  return &*std::min_element(view.begin(), view.end(),
                            [](const Ray& a, const Ray& b) { return a.t < b.t; });
}

// Returns whether one flat surface fills the view.
bool isBlank(Rays view) {
  constexpr double kFlat = 0.9998;  // the cosine of a degree
  return std::all_of(view.begin(), view.end(), [&](const Ray& ray) {
    return ray.t < kNone && ray.instance == view[0].instance &&
           std::abs(glm::dot(ray.normalW, view[0].normalW)) > kFlat;
  });
}

bool isEmpty(Rays view) {
  return std::all_of(view.begin(), view.end(), [](const Ray& ray) { return ray.t == kNone; });
}

std::string bodyLine(const Scene& scene, const Ray& inside) {
  return fmt::format("the camera is inside {}, whose back it sees to all sides",
                     objectName(scene, inside));
}

std::string nearLine(const Scene& scene, const Ray& nearest, const SceneCamera& camera) {
  return fmt::format("{} is {:.3g} m before the camera, nearer than its near distance of {:g} m",
                     objectName(scene, nearest), nearest.t, camera.znear);
}

// Picks frames evenly over 0 .. frames - 1, including both ends.
std::vector<uint32_t> someOf(uint32_t frames, uint32_t most) {
  const uint32_t count = std::max(std::min(frames, most), 1u);
  std::vector<uint32_t> chosen;
  for (uint32_t i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : uint32_t(uint64_t(i) * (frames - 1) / (count - 1)));
  return chosen;
}

constexpr size_t kSides = 6, kView = size_t(kViewSide) * kViewSide;

}  // namespace

std::vector<std::string> cameraWarnings(const Scene& scene, const SceneCamera& camera) {
  std::vector<Ray> rays;
  addSides(camera, rays);
  addView(camera, rays);
  meetAll(scene, rays);
  std::vector<std::string> lines;
  const Rays all = rays;
  if (const Ray* inside = insideOf(all.first(kSides))) lines.push_back(bodyLine(scene, *inside));
  const Ray* nearest = nearestOf(all.subspan(kSides));
  if (nearest->t < camera.znear) lines.push_back(nearLine(scene, *nearest, camera));
  return lines;
}

std::vector<std::string> cameraPathWarnings(const Scene& scene, const CameraMotion& motion,
                                            uint32_t frames) {
  if (frames == 0) return {};
  const double raysAllowed = kMostTests / double(std::max<size_t>(trianglesOf(scene), 1));
  const auto views = someOf(
      frames,
      std::clamp(uint32_t(std::min(raysAllowed / double(kSides + kView), 1e6)), 2u, kMostViews));
  const auto steps = someOf(frames, kMostSteps);
  std::vector<Ray> rays;
  for (const uint32_t frame : views) {
    const SceneCamera camera = cameraAt(motion, frame);
    addSides(camera, rays);
    addView(camera, rays);
  }
  // Exclude cuts: the camera does not move through the space between.
  const bool walks = motion.path.kind == CameraPathKind::orbit ||
                     motion.path.kind == CameraPathKind::dolly ||
                     motion.path.kind == CameraPathKind::keyframes;
  const size_t firstStep = rays.size();
  std::vector<size_t> stepOf;  // index of the step, by ray from `firstStep` on
  for (size_t i = 0; walks && i + 1 < steps.size(); ++i) {
    Ray ray;
    ray.originW = positionOf(cameraAt(motion, steps[i]));
    ray.dirW = positionOf(cameraAt(motion, steps[i + 1])) - ray.originW;
    ray.length = 1.0;
    if (ray.dirW == glm::dvec3(0.0)) continue;
    ray.slack = kBeginSlack * (1.0 + glm::length(ray.originW) / glm::length(ray.dirW));
    rays.push_back(ray);
    stepOf.push_back(i);
  }
  meetAll(scene, rays);

  std::vector<std::string> lines;
  const auto say = [&](uint32_t frame, const std::string& what) {
    lines.push_back(fmt::format("{}: at frame {} {}", motion.path.place, frame, what));
  };
  const Rays all = rays;
  const auto viewOf = [&](size_t i) { return all.subspan(i * (kSides + kView) + kSides, kView); };
  for (size_t i = firstStep; i < rays.size(); ++i) {
    if (rays[i].t == kNone) continue;
    lines.push_back(fmt::format("{}: the camera walks through {} between the frames {} and {}",
                                motion.path.place, objectName(scene, rays[i]),
                                steps[stepOf[i - firstStep]], steps[stepOf[i - firstStep] + 1]));
    break;
  }
  bool isInsideSaid = false, isNearSaid = false;
  for (size_t i = 0; i < views.size(); ++i) {
    const SceneCamera camera = cameraAt(motion, views[i]);
    const Ray* inside = insideOf(all.subspan(i * (kSides + kView), kSides));
    if (inside && !isInsideSaid) say(views[i], bodyLine(scene, *inside));
    isInsideSaid = isInsideSaid || inside;
    const Ray* nearest = nearestOf(viewOf(i));
    const bool isNear = nearest->t < camera.znear;
    if (isNear && !isNearSaid) say(views[i], nearLine(scene, *nearest, camera));
    isNearSaid = isNearSaid || isNear;
  }
  const Rays first = viewOf(0), last = viewOf(views.size() - 1);
  if (isBlank(last) && !isBlank(first))
    say(views.back(),
        fmt::format("one flat surface of {} fills the view", objectName(scene, last[0])));
  if (isEmpty(last) && !isEmpty(first)) say(views.back(), "no surface is in view");
  return lines;
}

}  // namespace restlab
