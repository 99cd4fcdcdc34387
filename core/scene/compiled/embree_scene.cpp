#include "core/scene/compiled/embree_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/backend/trace_callbacks.h"
#include "core/base/error.h"
#include "core/dialect/features.h"
#include "core/scene/compiled/shape_records.h"

namespace restlab {

EmbreeScene::~EmbreeScene() {
  if (top_ != nullptr) rtcReleaseScene(top_);
  for (RTCScene s : meshScenes_) {
    if (s != nullptr) rtcReleaseScene(s);
  }
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

size_t EmbreeScene::bytes() const { return size_t(std::max<ptrdiff_t>(0, bytes_)); }

RTCScene EmbreeScene::newScene(bool hasAlpha) const {
  // ROBUST: watertight along shared edges. High quality splits triangles, which would report a hit
  // twice to the alpha filter of shadow rays.
  const RTCBuildQuality quality = hasAlpha ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH;
  RTCScene s = rtcNewScene(device_);
  rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(s, quality);
  return s;
}

RTCGeometry EmbreeScene::newTriangles(const EmbreeInput& in, uint32_t index, bool isAsked) const {
  const rl::Geometry& g = in.geometries[index];
  const size_t end =
      index + 1 < in.geometries.size() ? in.geometries[index + 1].firstVertex : in.positions.size();
  const size_t vertexCount = end - g.firstVertex;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Copy to Embree's own buffers: Embree requires padding after the last vertex.
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertexCount));
  auto* t = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), g.triangleCount));
  if (v == nullptr || t == nullptr)
    failInput(fmt::format("{}: out of memory for the ray-tracing structure", in.name));
  std::copy_n(&in.positions[g.firstVertex].x, 3 * vertexCount, v);
  std::copy_n(&in.triangles[g.firstTriangle].x, 3 * size_t(g.triangleCount), t);
  if (isAsked) {
    rtcSetGeometryIntersectFilterFunction(geometry, rl::alphaFilterTrampoline);
    rtcSetGeometryOccludedFilterFunction(geometry, rl::alphaFilterTrampoline);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry EmbreeScene::newInstance(const EmbreeInput& in, const rl::Instance& inst) {
  RTCScene& mesh = meshScenes_[inst.geometry];
  if (mesh == nullptr) {
    // Instances may have different materials: the filter checks each hit's own.
    RTCGeometry geometry = newTriangles(in, inst.geometry, in.hasAlpha || in.bodiesMeet);
    mesh = newScene(in.hasAlpha);
    rtcAttachGeometryByID(mesh, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(mesh);
  }
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, mesh);
  rtcSetGeometryTimeStepCount(geometry, 1);
  const glm::vec4 r0 = inst.objectToWorldRow0, r1 = inst.objectToWorldRow1,
                  r2 = inst.objectToWorldRow2;
  const float rows[12] = {r0.x, r0.y, r0.z, r0.w, r1.x, r1.y, r1.z, r1.w, r2.x, r2.y, r2.z, r2.w};
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, rows);
  rtcCommitGeometry(geometry);
  return geometry;
}

void EmbreeScene::build(const EmbreeInput& in) {
  device_ = rtcNewDevice("");
  if (device_ == nullptr)
    throw Error(ExitCode::deviceUnavailable, "Embree could not create a device");
  const auto count = [](void* bytes, ptrdiff_t change, bool) {
    static_cast<std::atomic<ptrdiff_t>*>(bytes)->fetch_add(change);
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device_, count, &bytes_);
  const auto asks = [&](const rl::Instance& inst) {
    return (in.hasAlpha && (inst.flags & rl::RL_INSTANCE_ALPHA) != 0) ||
           (in.bodiesMeet && inst.flags >> rl::RL_INSTANCE_RANK_SHIFT != 0);
  };
  top_ = newScene(in.hasAlpha);
  meshScenes_.resize(in.geometries.size(), nullptr);
  for (uint32_t i = 0; i < in.instances.size(); ++i) {
    const rl::Instance& inst = in.instances[i];
    const rl::Geometry& g = in.geometries[inst.geometry];
    RTCGeometry geometry = nullptr;
    if (g.shape != rl::RL_SHAPE_TRIANGLES) {
      geometry = newShape(device_, in.shapeBoxes[i]);
    } else if (g.triangleCount == 0) {
      continue;
    } else if ((inst.flags & rl::RL_INSTANCE_IDENTITY) != 0) {
      geometry = newTriangles(in, inst.geometry, asks(inst));
    } else {
      geometry = newInstance(in, inst);
    }
    rtcAttachGeometryByID(top_, geometry, i);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(top_);
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) {
    failInput(fmt::format("{}: building the ray-tracing structure failed (Embree error {})",
                          in.name, static_cast<int>(error)));
  }
}

}  // namespace restlab
