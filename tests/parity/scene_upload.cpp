#include "tests/parity/scene_upload.h"

#include <algorithm>
#include <cstring>

#include "core/dialect/bsdf.h"

namespace restlab::parity {

namespace {

// Elements of each buffer.
struct Extents {
  size_t vertices = 0, normals = 0, tangents = 0, colors = 0, uvs = 0;
  size_t triangles = 0, geometries = 0, materials = 0, textures = 0, texels = 0;
};

void growTo(size_t& extent, size_t end) { extent = std::max(extent, end); }

void growAttribute(size_t& extent, uint32_t offset, size_t vertexCount) {
  if (offset != rl::RL_INVALID) growTo(extent, offset + vertexCount);
}

Extents extentsOf(const rl::SceneData& scene) {
  Extents e;
  for (uint32_t i = 0; i < scene.instanceCount; ++i) {
    const rl::Instance& inst = scene.instances.data[i];
    growTo(e.geometries, inst.geometry + 1);
    growTo(e.materials, inst.material + 1);
  }
  for (size_t g = 0; g < e.geometries; ++g) {
    const rl::Geometry& geometry = scene.geometries.data[g];
    growTo(e.triangles, geometry.firstTriangle + geometry.triangleCount);
    size_t vertexCount = 0;
    for (uint32_t k = 0; k < geometry.triangleCount; ++k) {
      const rl::uvec3 t = scene.triangles.data[geometry.firstTriangle + k];
      growTo(vertexCount, std::max({t.x, t.y, t.z}) + size_t{1});
    }
    growTo(e.vertices, geometry.firstVertex + vertexCount);
    growAttribute(e.normals, geometry.normalOffset, vertexCount);
    growAttribute(e.tangents, geometry.tangentOffset, vertexCount);
    growAttribute(e.colors, geometry.colorOffset, vertexCount);
    for (uint32_t offset : geometry.uvOffset) growAttribute(e.uvs, offset, vertexCount);
  }
  for (size_t m = 0; m < e.materials; ++m) {
    for (uint32_t id : scene.materials.data[m].textures) growAttribute(e.textures, id, 1);
  }
  for (size_t t = 0; t < e.textures; ++t) {
    const rl::Texture& texture = scene.textures.data[t];
    growTo(e.texels, texture.firstTexel + size_t{texture.width} * texture.height);
  }
  return e;
}

// Copies n elements; `to` gets the device address in place of a pointer.
template <typename T>
void move(VulkanDevice& device, T*& to, size_t n) {
  const uint64_t address = n ? device.upload(to, n * sizeof(T)).address : 0;
  static_assert(sizeof(void*) == sizeof address);
  std::memcpy(&to, &address, sizeof address);
}

}  // namespace

uint64_t uploadScene(VulkanDevice& device, const rl::SceneData& scene) {
  const Extents e = extentsOf(scene);
  const size_t environmentTexels = size_t{scene.environmentWidth} * scene.environmentHeight;
  rl::SceneData copy = scene;
  move(device, copy.positions.data, e.vertices);
  move(device, copy.normals.data, e.normals);
  move(device, copy.tangents.data, e.tangents);
  move(device, copy.colors.data, e.colors);
  move(device, copy.uvs.data, e.uvs);
  move(device, copy.triangles.data, e.triangles);
  move(device, copy.geometries.data, e.geometries);
  move(device, copy.instances.data, scene.instanceCount);
  move(device, copy.materials.data, e.materials);
  move(device, copy.textures.data, e.textures);
  move(device, copy.texels.data, e.texels);
  move(device, copy.srgbToLinear.data, 256);
  move(device, copy.lights.data, scene.lightCount);
  move(device, copy.lightAlias.data, scene.lightCount);
  move(device, copy.environment.data, environmentTexels);
  move(device, copy.environmentAlias.data, environmentTexels);
  const size_t albedos = size_t{rl::RL_GGX_NODES} * (rl::RL_GGX_NODES + 1);
  move(device, copy.ggxAlbedo.data, copy.ggxAlbedo.data != nullptr ? albedos : 0);
  return device.upload(&copy, sizeof copy).address;
}

}  // namespace restlab::parity
