#include "core/scene/compiled/shape_records.h"

#include "core/backend/trace_callbacks.h"
#include "core/scene/compiled/instance_box.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

RTCBounds embreeBox(const std::array<glm::vec3, 2>& of) {
  RTCBounds box{};
  box.lower_x = of[0].x;
  box.lower_y = of[0].y;
  box.lower_z = of[0].z;
  box.upper_x = of[1].x;
  box.upper_y = of[1].y;
  box.upper_z = of[1].z;
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
    boxes[i] = embreeBox(boxOfInstance(instances[i], shape.info->box(shape)));
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
