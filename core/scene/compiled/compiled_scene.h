// A Scene prepared for kernels: flat buffers, light table, feature mask, Embree scene.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/dialect/features.h"
#include "core/dialect/types.h"
#include "core/scene/compiled/bvh.h"
#include "core/scene/scene.h"

namespace restlab {

class CompiledScene {
 public:
  // Recentres in double precision, bakes meshes used once into world space, builds the light table
  // (selection by power) and the environment's alias table. Adds warnings
  // (zero-area lights, no light, vertices that float32 rounds:
  // core/scene/compiled/coarse_vertices.h).
  static std::shared_ptr<const CompiledScene> build(Scene scene);
  ~CompiledScene();

  const Scene& source() const;
  const rl::SceneData& data() const;  // addresses stay valid as long as this object
  // Features that the scene needs (RL_FEATURE_*). RL_FEATURE_MULTISCATTER is included only if
  // `multiscatter` is set and changes something.
  rl::FeatureMask features(bool multiscatter = false) const;
  // Makes SceneData::ggxAlbedo point to its table, for sessions that read it; computed at the first
  // call.
  void bindGgxAlbedo() const;
  // Makes SceneData::bvh and bvhRoots point to the project's own hierarchy, for sessions
  // that trace it; built at the first call. Returns it.
  const Bvh& bindBvh() const;
  // Makes SceneData::lightTree and lightTrails point to the hierarchy of lamps, for sessions that
  // choose lamps by it; built at the first call.
  void bindLightTree() const;
  // Returns what a method has derived from the scene under this name, made at the first call. It is
  // dropped when nobody holds it and another one is made.
  using Derived = std::shared_ptr<const void>;
  Derived derived(const std::string& name, const std::function<Derived()>& make) const;
  BvhInput bvhInput() const;  // input of hierarchy builders; valid as long as this object
  // Returns data() for a device with its own memory: every address is replaced by what `place`
  // returns for the bytes there (0 for an empty buffer). Includes the project's own hierarchy if it
  // is bound and `withBvh` is set.
  using Place = std::function<uint64_t(const void* bytes, size_t count)>;
  rl::SceneData placedAt(const Place& place, bool withBvh) const;
  const std::vector<std::string>& warnings() const;  // from import and compilation
  rl::Camera camera(const SceneCamera& camera, uint32_t width, uint32_t height) const;
  // Ranks of the bodies that contain a point (relative to origin()), greatest first; 0 ends the
  // list.
  glm::uvec4 bodiesAt(const glm::vec3& posW) const;
  bool absorbs(uint32_t rank) const;      // false for rank 0, air
  size_t triangleCount() const;           // unique
  size_t instancedTriangleCount() const;  // with every instance counted
  size_t emissiveTriangleCount() const;
  size_t lampCount() const;     // emitting triangles, points and spots, also those that are off
  size_t lightRecords() const;  // SceneData::lights, also those that are off
  // Name of a light in the scene: of the mesh that emits, of a punctual light, or "environment".
  std::string lightName(uint32_t record) const;
  size_t bytes() const;        // all buffers that kernels read
  size_t embreeBytes() const;  // Embree's copy of the triangles and its hierarchies
  void* embreeScene() const;   // RTCScene
  glm::dvec3 origin() const;   // subtracted from world positions
  // Returns whether both compile one scene and differ only in light factors
  // (core/scene/compiled/light_factor.h). Histories of one are then valid for the other: same
  // surfaces, lights and kernels.
  bool differsInLightAlone(const CompiledScene& other) const;

 private:
  struct Impl;
  explicit CompiledScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Features that the scene needs, before compilation (core/scene/compiled/feature_scan.cpp).
rl::FeatureMask scanFeatures(const Scene& scene);
// Returns whether a surface has the rough reflection that multiple-scattering compensation changes.
bool hasRoughReflection(const Scene& scene);

}  // namespace restlab
