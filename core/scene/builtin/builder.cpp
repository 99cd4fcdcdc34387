#include "core/scene/builtin/builder.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/scene/shapes/shape_info.h"

namespace restlab::builtin {
namespace {

// Hashes field by field: structures with padding or pointers are never hashed as bytes.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) {
    if (!state_) throw std::bad_alloc();
    XXH3_64bits_reset(state_.get());
  }
  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    XXH3_64bits_update(state_.get(), &v, sizeof(T));
  }
  template <typename T>
  void array(const std::vector<T>& v) {
    value(uint64_t(v.size()));
    if (!v.empty()) XXH3_64bits_update(state_.get(), v.data(), v.size() * sizeof(T));
  }
  void text(const std::string& s) {
    value(uint64_t(s.size()));
    XXH3_64bits_update(state_.get(), s.data(), s.size());
  }
  uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void hashGeometry(Hasher& hash, const MeshGeometry& g) {
  hash.text(g.name);
  hash.array(g.positions);
  hash.array(g.normals);
  hash.array(g.tangents);
  hash.array(g.colors);
  for (const auto& uv : g.uvs) hash.array(uv);
  hash.array(g.triangles);
  if (g.shape == nullptr) return;
  hash.text(g.shape->info->name);
  hash.array(g.shape->values);
  hash.array(g.shape->words);
}

void hashTextures(Hasher& hash, const Scene& scene) {
  for (const TextureImage& image : scene.images) {
    hash.value(image.width);
    hash.value(image.height);
    hash.array(image.texels);
  }
  for (const TextureUse& use : scene.textureUses) {
    for (const uint32_t v : {use.image, use.uvSet, use.wrapU, use.wrapV}) hash.value(v);
    for (const bool v : {use.nearest, use.srgb}) hash.value(v);
    for (const glm::vec3& row : {use.uvRow0, use.uvRow1}) hash.value(row);
  }
}

void hashEnvironment(Hasher& hash, const EnvironmentMap& map) {
  hash.value(map.width);
  hash.value(map.height);
  hash.array(map.radiance);
  hash.value(map.rotation);
  hash.value(map.scale);
}

}  // namespace

rl::Material lambert(const glm::vec3& albedo) {
  rl::Material m{};
  m.baseColor = albedo;
  m.alpha = 1.0f;
  m.alphaCutoff = 0.5f;
  m.roughness = 1.0f;
  m.ior = 1.5f;
  m.specularColor = glm::vec3(1.0f);
  m.normalScale = 1.0f;
  m.flags = rl::RL_MATERIAL_DOUBLE_SIDED;
  for (rl::uint& slot : m.textures) slot = rl::RL_INVALID;
  return m;
}

rl::Material lamp(const glm::vec3& radiance) {
  rl::Material m = lambert(glm::vec3(0.0f));
  m.emission = radiance;
  m.flags = rl::RL_MATERIAL_BLACK;
  return m;
}

rl::Material metal(const glm::vec3& f0, float roughness) {
  rl::Material m = lambert(f0);
  m.metallic = 1.0f;
  m.roughness = roughness;
  m.specular = 1.0f;
  return m;
}

rl::Material plastic(const glm::vec3& albedo, float roughness) {
  rl::Material m = lambert(albedo);
  m.roughness = roughness;
  m.specular = 1.0f;
  return m;
}

rl::Material glass(float roughness, const glm::vec3& sigmaAbsorption) {
  rl::Material m = plastic(glm::vec3(1.0f), roughness);
  m.transmission = 1.0f;
  m.sigmaAbsorption = sigmaAbsorption;
  return m;
}

EnvironmentMap uniformEnvironment() {
  EnvironmentMap uniform;
  uniform.source = "uniform radiance 1";
  uniform.width = 16;
  uniform.height = 8;
  uniform.radiance.assign(size_t(uniform.width) * uniform.height, glm::vec3(1.0f));
  return uniform;
}

uint32_t SceneBuilder::addMaterial(const std::string& name, const rl::Material& data) {
  scene_.materials.push_back({name, data});
  return uint32_t(scene_.materials.size() - 1);
}

void SceneBuilder::add(MeshGeometry mesh, uint32_t material) {
  const std::string name = mesh.name;
  place(name, addGeometry(std::move(mesh)), material, glm::dmat4(1.0));
}

uint32_t SceneBuilder::addGeometry(MeshGeometry mesh) {
  if (mesh.triangles.empty())
    throw std::logic_error("SceneBuilder: mesh '" + mesh.name + "' is empty");
  scene_.geometries.push_back(std::move(mesh));
  return uint32_t(scene_.geometries.size() - 1);
}

void SceneBuilder::place(const std::string& name, uint32_t geometry, uint32_t material,
                         const glm::dmat4& objectToWorld) {
  scene_.instances.push_back({name, geometry, material, objectToWorld});
}

void SceneBuilder::addCamera(const std::string& name, const glm::dvec3& eye,
                             const glm::dvec3& target, double yfovDegrees) {
  SceneCamera camera;
  camera.name = name;
  camera.cameraToWorld = glm::inverse(glm::lookAt(eye, target, glm::dvec3(0.0, 1.0, 0.0)));
  camera.yfov = glm::radians(yfovDegrees);
  scene_.cameras.push_back(camera);
}

Scene SceneBuilder::finish() {
  scene_.contentHash = hashOf(scene_);
  return std::move(scene_);
}

uint64_t hashOf(const Scene& scene) {
  Hasher hash;
  hash.text(scene.name);
  for (const MeshGeometry& g : scene.geometries) hashGeometry(hash, g);
  for (const MeshInstance& i : scene.instances) {
    hash.text(i.name);
    hash.value(i.geometry);
    hash.value(i.material);
    hash.value(i.objectToWorld);
  }
  for (const SceneMaterial& m : scene.materials) {
    hash.text(m.name);
    hash.value(m.data);  // 128 bytes, padding set to 0 (types.h)
    for (const ClosureValue& v : m.closure) {
      hash.value(v.words);
      hash.value(v.texture);
      hash.value(v.channel);
    }
    if (m.priority != 0) hash.value(m.priority);
  }
  hashTextures(hash, scene);
  for (const SceneCamera& c : scene.cameras) {
    hash.text(c.name);
    hash.value(c.kind);
    hash.value(c.cameraToWorld);
    for (double v : {c.yfov, c.xmag, c.ymag, c.aspect}) hash.value(v);
  }
  for (const PunctualLight& l : scene.lights) {
    hash.text(l.name);
    hash.value(l.kind);
    hash.value(l.posW);
    hash.value(l.dirW);
    hash.value(l.intensity);
    hash.value(l.innerConeAngle);
    hash.value(l.outerConeAngle);
  }
  if (scene.environment) hashEnvironment(hash, *scene.environment);
  return hash.digest();
}

}  // namespace restlab::builtin
