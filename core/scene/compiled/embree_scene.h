// The scene as Embree traces it: one geometry an instance, with the instance's number.
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "core/backend/embree.h"
#include "core/dialect/types.h"

namespace restlab {

struct EmbreeInput {
  std::string name;  // of the scene, for errors
  std::span<const glm::vec3> positions;
  std::span<const glm::uvec3> triangles;
  std::span<const rl::Geometry> geometries;
  std::span<const rl::Instance> instances;
  std::span<const RTCBounds> shapeBoxes;  // must live as long as the scene
  bool hasAlpha = false;                  // kernels check hits on partly transparent instances
  bool bodiesMeet = false;                // and hits on bodies, if bodies meet
};

class EmbreeScene {
 public:
  EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene();

  // Called once. Throws Error (deviceUnavailable, badInput).
  void build(const EmbreeInput& input);

  RTCDevice device() const { return device_; }
  RTCScene top() const { return top_; }
  size_t bytes() const;  // memory held by Embree

 private:
  RTCScene newScene(bool hasAlpha) const;
  RTCGeometry newTriangles(const EmbreeInput& input, uint32_t geometry, bool isAsked) const;
  RTCGeometry newInstance(const EmbreeInput& input, const rl::Instance& inst);

  std::atomic<ptrdiff_t> bytes_{0};  // Embree allocates from several threads
  RTCDevice device_ = nullptr;
  RTCScene top_ = nullptr;
  std::vector<RTCScene> meshScenes_;  // by geometry, of those that instances share
};

}  // namespace restlab
