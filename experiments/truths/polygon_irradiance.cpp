#include "experiments/truths/polygon_irradiance.h"

#include <cmath>

namespace restlab::analytic {

std::vector<glm::dvec3> clipToHorizon(const std::vector<glm::dvec3>& vertices,
                                      const glm::dvec3& pos, const glm::dvec3& normal) {
  std::vector<glm::dvec3> kept;
  for (size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3& a = vertices[i];
    const glm::dvec3& b = vertices[(i + 1) % vertices.size()];
    const double heightA = glm::dot(a - pos, normal), heightB = glm::dot(b - pos, normal);
    if (heightA >= 0.0) kept.push_back(a);
    if ((heightA > 0.0 && heightB < 0.0) || (heightA < 0.0 && heightB > 0.0)) {
      kept.push_back(glm::mix(a, b, heightA / (heightA - heightB)));
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

double projectedSolidAngle(const std::vector<glm::dvec3>& vertices, const glm::dvec3& pos,
                           const glm::dvec3& normal) {
  const std::vector<glm::dvec3> polygon = clipToHorizon(vertices, pos, normal);
  double sum = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - pos;
    const glm::dvec3 b = polygon[(i + 1) % polygon.size()] - pos;
    const glm::dvec3 axis = glm::cross(a, b);
    const double sine = glm::length(axis);
    if (!(sine > 0.0)) continue;  // an edge that points at pos spans no angle
    // atan2 is precise at both ends, unlike acos of the cosine.
    const double angle = std::atan2(sine, glm::dot(a, b));
    sum += angle * glm::dot(axis, normal) / sine;
  }
  // Negate: for vertices counter-clockwise as seen from pos, the normal points against a and b.
  return -0.5 * sum;
}

}  // namespace restlab::analytic
