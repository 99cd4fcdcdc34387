// Distances to the closest of many triangles.
#pragma once

#include "core/scene/distance/triangles.h"

struct RTCSceneTy;
struct RTCDeviceTy;

namespace restlab {

class ClosestTriangle {
 public:
  // Throws Error (deviceUnavailable).
  explicit ClosestTriangle(const ClosedTriangles& surface);
  ~ClosestTriangle();
  ClosestTriangle(const ClosestTriangle&) = delete;
  ClosestTriangle& operator=(const ClosestTriangle&) = delete;

  // Exact but for rounding. `atMost`: a distance that it does not exceed.
  double distance(const glm::dvec3& from, double atMost) const;

 private:
  const ClosedTriangles& surface_;
  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* scene_ = nullptr;
};

}  // namespace restlab
