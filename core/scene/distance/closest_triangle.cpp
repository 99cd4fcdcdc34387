#include "core/scene/distance/closest_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/backend/embree.h"
#include "core/base/error.h"

namespace restlab {

namespace {

struct ClosestQuery {
  const ClosedTriangles* surface = nullptr;
  glm::dvec3 from{0.0};
  double distance2 = 0.0;
};

double distance2ToEdge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a, to = p - a;
  const double s = std::clamp(glm::dot(to, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 away = to - s * along;
  return glm::dot(away, away);
}

// Straight above the triangle the distance is that of its plane, else that of an edge.
double distance2To(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                   const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double n2 = glm::dot(n, n);
  const auto isWithin = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(n, to - from), p - from) >= 0.0;
  };
  if (n2 > 0.0 && isWithin(a, b) && isWithin(b, c) && isWithin(c, a)) {
    const double height = glm::dot(p - a, n);
    return height * height / n2;
  }
  return std::min({distance2ToEdge(p, a, b), distance2ToEdge(p, b, c), distance2ToEdge(p, c, a)});
}

float radiusOf(double distance2) {
  const auto radius = static_cast<float>(std::sqrt(distance2));
  return std::nextafter(radius * 1.000001f, std::numeric_limits<float>::max());
}

bool visitTriangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<ClosestQuery*>(arguments->userPtr);
  const ClosedTriangles& s = *query.surface;
  const glm::uvec3 t = s.triangles[arguments->primID];
  const double d2 = distance2To(query.from, glm::dvec3(s.positions[t.x]),
                                glm::dvec3(s.positions[t.y]), glm::dvec3(s.positions[t.z]));
  if (!(d2 < query.distance2)) return false;
  query.distance2 = d2;
  const float radius = radiusOf(d2);
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

}  // namespace

ClosestTriangle::ClosestTriangle(const ClosedTriangles& surface)
    : surface_(surface), device_(rtcNewDevice("")) {
  if (device_ == nullptr)
    throw Error(ExitCode::deviceUnavailable, "Embree could not create a device");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(glm::vec3), surface.positions.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(glm::uvec3), surface.triangles.size());
  if (positions != nullptr && triangles != nullptr) {
    std::copy(surface.positions.begin(), surface.positions.end(),
              static_cast<glm::vec3*>(positions));
    std::copy(surface.triangles.begin(), surface.triangles.end(),
              static_cast<glm::uvec3*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcCommitScene(scene_);
  }
  rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(device_) == RTC_ERROR_NONE) return;
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
  throw Error(ExitCode::deviceUnavailable, "Embree could not hold the triangles");
}

ClosestTriangle::~ClosestTriangle() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

double ClosestTriangle::distance(const glm::dvec3& from, double atMost) const {
  ClosestQuery query{&surface_, from, std::numeric_limits<double>::infinity()};
  const glm::vec3 at(from);
  // Rounding of the place is part of the radius.
  const double farthest = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)});
  const double radius = atMost * 1.00001 + 1e-6 * farthest;
  RTCPointQuery around{at.x, at.y, at.z, 0.0f, radiusOf(radius * radius)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_, &around, &context, visitTriangle, &query);
  return std::sqrt(query.distance2);
}

}  // namespace restlab
