#include "core/scene/compiled/shape_records.h"

#include <algorithm>
#include <limits>

#include "core/backend/trace_callbacks.h"
#include "core/dialect/math.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

// Bounds a box under the transform of an instance, moved out by the rounding of a ray's transform:
// |M| |p| + |T| bounds every intermediate.
RTCBounds boxOf(const std::array<glm::vec3, 2>& local, const rl::Instance& inst) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  const glm::vec4 rows[3] = {inst.objectToWorldRow0, inst.objectToWorldRow1,
                             inst.objectToWorldRow2};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 p(local[size_t(corner & 1)].x, local[size_t(corner >> 1 & 1)].y,
                      local[size_t(corner >> 2)].z, 1.0f);
    glm::vec3 at, magnitude;
    for (int c = 0; c < 3; ++c) {
      at[c] = glm::dot(rows[c], p);
      magnitude[c] = glm::dot(glm::abs(rows[c]), glm::abs(p));
    }
    const float error = rl::RL_HIT_ERROR * std::max({magnitude.x, magnitude.y, magnitude.z});
    low = glm::min(low, at - error);
    high = glm::max(high, at + error);
  }
  RTCBounds box{};
  box.lower_x = low.x;
  box.lower_y = low.y;
  box.lower_z = low.z;
  box.upper_x = high.x;
  box.upper_y = high.y;
  box.upper_z = high.z;
  return box;
}

void giveBounds(const RTCBoundsFunctionArguments* args) {
  *args->bounds_o = *static_cast<const RTCBounds*>(args->geometryUserPtr);
}

}  // namespace

rl::Geometry shapeRecord(const ShapeGeometry& shape, std::vector<glm::uvec4>& words) {
  rl::Geometry g{};
  g.normalOffset = g.tangentOffset = g.colorOffset = rl::RL_INVALID;
  for (uint32_t& offset : g.uvOffset) offset = rl::RL_INVALID;
  g.shape = shape.info->kind;
  g.firstShapeWord = static_cast<uint32_t>(words.size());
  const std::vector<glm::uvec4> own = shapeWords(shape);
  words.insert(words.end(), own.begin(), own.end());
  return g;
}

std::vector<RTCBounds> boxesOfShapes(const Scene& scene,
                                     const std::vector<rl::Geometry>& geometries,
                                     const std::vector<rl::Instance>& instances) {
  std::vector<RTCBounds> boxes(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    if (geometries[instances[i].geometry].shape == rl::RL_SHAPE_TRIANGLES) continue;
    const ShapeGeometry& shape = *scene.geometries[scene.instances[i].geometry].shape;
    boxes[i] = boxOf(shape.info->box(shape), instances[i]);
  }
  return boxes;
}

RTCGeometry newShape(RTCDevice device, const RTCBounds& box) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<RTCBounds*>(&box));
  rtcSetGeometryBoundsFunction(geometry, giveBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, rl::shapeIntersectTrampoline);
  rtcSetGeometryOccludedFunction(geometry, rl::shapeOccludedTrampoline);
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace restlab
