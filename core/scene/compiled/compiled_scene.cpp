#include "core/scene/compiled/compiled_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>

#include "core/base/error.h"
#include "core/scene/compiled/black_textures.h"
#include "core/scene/compiled/bodies.h"
#include "core/scene/compiled/body_warnings.h"
#include "core/scene/compiled/clear_surfaces.h"
#include "core/scene/compiled/coarse_vertices.h"
#include "core/scene/compiled/embree_scene.h"
#include "core/scene/compiled/ggx_albedo.h"
#include "core/scene/compiled/light_table.h"
#include "core/scene/compiled/light_tree.h"
#include "core/scene/compiled/material_records.h"
#include "core/scene/compiled/shape_records.h"
#include "core/scene/compiled/split_triangles.h"
#include "core/scene/plate.h"

namespace restlab {

namespace {

glm::vec3 transformPoint(const glm::dmat4& m, const glm::vec3& p) {
  return glm::vec3(m * glm::dvec4(glm::dvec3(p), 1.0));
}

glm::vec4 row(const glm::dmat4& m, int r) {
  return glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]));
}

template <typename T>
uint32_t append(std::vector<T>& pool, const std::vector<T>& values) {
  if (values.empty()) return rl::RL_INVALID;
  const auto offset = static_cast<uint32_t>(pool.size());
  pool.insert(pool.end(), values.begin(), values.end());
  return offset;
}

}  // namespace

struct CompiledScene::Impl {
  Scene scene;
  rl::FeatureMask features = 0;
  std::once_flag ggxAlbedoBound, bvhBound, lightTreeBound;
  std::mutex derivedLock;
  std::map<std::string, Derived> derived;
  Bvh bvh;
  LightTree lightTree;
  glm::dvec3 origin{0.0};
  std::vector<std::string> warnings;
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents, colors;
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;
  std::vector<rl::Geometry> geometries;
  std::vector<glm::uvec4> shapeWords;
  std::vector<RTCBounds> shapeBoxes;  // of each instance of a shape, world space
  std::vector<rl::Instance> instances;
  MaterialRecords records;
  LightTable lights;
  Bodies bodies;
  rl::SceneData data{};
  size_t instancedTriangles = 0;
  EmbreeScene embree;

  void flatten();
  void addGeometry(const MeshGeometry& mesh, const glm::dmat4* bake,
                   const std::vector<glm::dvec3>* positionsW);
  void buildEmbree();
  void bindAddresses();
};

// Copies a mesh to the pools. With `bake`, vertices go to world space with the winding kept
// outward, at `positionsW` if given.
void CompiledScene::Impl::addGeometry(const MeshGeometry& mesh, const glm::dmat4* bake,
                                      const std::vector<glm::dvec3>* positionsW) {
  rl::Geometry g{};
  g.firstTriangle = static_cast<uint32_t>(triangles.size());
  g.triangleCount = static_cast<uint32_t>(mesh.triangles.size());
  g.firstVertex = static_cast<uint32_t>(positions.size());
  g.normalOffset = append(normals, mesh.normals);
  g.tangentOffset = append(tangents, mesh.tangents);
  g.colorOffset = append(colors, mesh.colors);
  for (uint32_t i = 0; i < rl::RL_MAX_UV_SETS; ++i) g.uvOffset[i] = append(uvs, mesh.uvs[i]);
  append(positions, mesh.positions);
  append(triangles, mesh.triangles);
  if (bake != nullptr) {
    for (size_t i = g.firstVertex; i < positions.size(); ++i) {
      positions[i] = positionsW != nullptr ? glm::vec3((*positionsW)[i - g.firstVertex] - origin)
                                           : transformPoint(*bake, positions[i]);
    }
    const glm::dmat3 linear(*bake);
    // Normals stay unnormalised: kernels normalise after interpolation, so that a baked mesh shades
    // like an instance of it. The common factor only keeps them in range.
    glm::dmat3 normalMatrix = glm::transpose(glm::inverse(linear));
    normalMatrix /= std::max(
        {glm::length(normalMatrix[0]), glm::length(normalMatrix[1]), glm::length(normalMatrix[2])});
    if (g.normalOffset != rl::RL_INVALID) {
      for (size_t i = g.normalOffset; i < normals.size(); ++i) {
        const glm::dvec3 n = normalMatrix * glm::dvec3(normals[i]);
        normals[i] = std::isfinite(n.x + n.y + n.z) ? glm::vec3(n) : glm::vec3(0.0f);
      }
    }
    if (g.tangentOffset != rl::RL_INVALID) {
      for (size_t i = g.tangentOffset; i < tangents.size(); ++i) {
        const glm::dvec3 t = linear * glm::dvec3(glm::vec3(tangents[i]));
        tangents[i] = glm::vec4(glm::vec3(t), tangents[i].w);
      }
    }
    if (glm::determinant(linear) < 0.0) {
      // Flip the winding: a mirrored mesh would face inwards. Normals and UVs follow their
      // vertices; the bitangent of a mirrored tangent frame changes sign with the cross product.
      for (size_t i = g.firstTriangle; i < triangles.size(); ++i)
        std::swap(triangles[i].y, triangles[i].z);
      if (g.tangentOffset != rl::RL_INVALID) {
        for (size_t i = g.tangentOffset; i < tangents.size(); ++i) tangents[i].w = -tangents[i].w;
      }
    }
  }
  geometries.push_back(g);
}

void CompiledScene::Impl::flatten() {
  std::vector<uint32_t> uses(scene.geometries.size(), 0);
  for (const MeshInstance& m : scene.instances) ++uses[m.geometry];
  const SceneOrigin sceneOrigin = originOf(scene, scene.mainCamera);
  origin = sceneOrigin.originW;
  if (std::string warning = coarseVertices(scene, sceneOrigin); !warning.empty())
    warnings.push_back(std::move(warning));
  for (std::string& warning : farFromOrigin(scene, sceneOrigin))
    warnings.push_back(std::move(warning));

  std::vector<uint32_t> sharedGeometry(scene.geometries.size(), rl::RL_INVALID);
  for (const MeshInstance& m : scene.instances) {
    const ShapeGeometry* shape = scene.geometries[m.geometry].shape.get();
    std::optional<SplitMesh> split;
    if (shape == nullptr)
      split = splitHugeTriangles(scene.geometries[m.geometry], m.objectToWorld, sceneOrigin);
    const MeshGeometry& mesh = split ? split->mesh : scene.geometries[m.geometry];
    glm::dmat4 toWorld = m.objectToWorld;
    toWorld[3] -= glm::dvec4(origin, 0.0);
    toWorld = withThickness(toWorld, mesh);
    rl::Instance inst{};
    inst.material = m.material;
    inst.firstLight = rl::RL_INVALID;
    const bool shared = uses[m.geometry] > 1 && !split;
    if (shape != nullptr) {
      if (sharedGeometry[m.geometry] == rl::RL_INVALID) {
        sharedGeometry[m.geometry] = static_cast<uint32_t>(geometries.size());
        geometries.push_back(shapeRecord(*shape, shapeWords));
        geometries.back().firstVertex = static_cast<uint32_t>(positions.size());
      }
      inst.geometry = sharedGeometry[m.geometry];
    } else if (shared) {
      if (sharedGeometry[m.geometry] == rl::RL_INVALID) {
        sharedGeometry[m.geometry] = static_cast<uint32_t>(geometries.size());
        addGeometry(mesh, nullptr, nullptr);
      }
      inst.geometry = sharedGeometry[m.geometry];
      if (glm::determinant(glm::dmat3(toWorld)) < 0.0) inst.flags |= rl::RL_INSTANCE_FLIPPED;
    } else {
      inst.geometry = static_cast<uint32_t>(geometries.size());
      addGeometry(mesh, &toWorld, split ? &split->positionsW : nullptr);
      toWorld = glm::dmat4(1.0);
      inst.flags |= rl::RL_INSTANCE_IDENTITY;
    }
    const glm::dmat4 toObject = glm::inverse(toWorld);
    inst.objectToWorldRow0 = row(toWorld, 0);
    inst.objectToWorldRow1 = row(toWorld, 1);
    inst.objectToWorldRow2 = row(toWorld, 2);
    inst.worldToObjectRow0 = row(toObject, 0);
    inst.worldToObjectRow1 = row(toObject, 1);
    inst.worldToObjectRow2 = row(toObject, 2);
    const uint32_t alphaFlags = rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_ALPHA_BLEND;
    if ((scene.materials[m.material].data.flags & alphaFlags) != 0)
      inst.flags |= rl::RL_INSTANCE_ALPHA;
    inst.flags |= bodies.rank[instances.size()] << rl::RL_INSTANCE_RANK_SHIFT;
    if (shape == nullptr) instancedTriangles += mesh.triangles.size();
    instances.push_back(inst);
  }
}

void CompiledScene::Impl::buildEmbree() {
  shapeBoxes = boxesOfShapes(scene, geometries, instances);
  EmbreeInput input;
  input.name = scene.name;
  input.positions = positions;
  input.triangles = triangles;
  input.geometries = geometries;
  input.instances = instances;
  input.shapeBoxes = shapeBoxes;
  input.hasAlpha = (features & rl::RL_FEATURE_ALPHA) != 0;
  input.bodiesMeet = bodies.meet;
  embree.build(input);
}

void CompiledScene::Impl::bindAddresses() {
  data.positions.data = positions.data();
  data.normals.data = normals.data();
  data.tangents.data = tangents.data();
  data.colors.data = colors.data();
  data.uvs.data = uvs.data();
  data.triangles.data = triangles.data();
  data.geometries.data = geometries.data();
  data.instances.data = instances.data();
  data.materials.data = records.materials.data();
  data.textures.data = records.textures.data();
  data.texels.data = records.texels.data();
  data.srgbToLinear.data = records.srgb.data();
  data.lights.data = lights.lights.data();
  data.lightAlias.data = lights.alias.data();
  data.lampShare = lights.lampShare;
  data.lightCount = static_cast<uint32_t>(lights.alias.size());  // 0: all lights are off
  data.environment.data = lights.environment.data();
  data.environmentAlias.data = lights.environmentAlias.data();
  data.environmentWidth = scene.environment ? scene.environment->width : 0;
  data.environmentHeight = scene.environment ? scene.environment->height : 0;
  data.environmentLight = lights.environmentLight;
  data.environmentRotation = scene.environment ? scene.environment->rotation : 0.0f;
  data.closureParameters.data = records.closureParameters.data();
  data.shapeWords.data = shapeWords.data();
  data.bodies.data = bodies.media.data();
  data.bodiesMeet = bodies.meet ? 1u : 0u;
  data.ambient = scene.ambient * scene.ambientFactor;
  data.background = scene.background.value_or(glm::vec3(0.0f));
  data.hasBackground = scene.background ? 1u : 0u;
  data.hasMedia = (features & rl::RL_FEATURE_VOLUME) != 0 ? 1u : 0u;
  data.instanceCount = static_cast<uint32_t>(instances.size());
}

CompiledScene::CompiledScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CompiledScene::~CompiledScene() = default;

std::shared_ptr<const CompiledScene> CompiledScene::build(Scene scene) {
  auto impl = std::make_unique<Impl>();
  foldBlackTextures(scene);
  leaveOutClearSurfaces(scene);
  impl->features = scanFeatures(scene);
  impl->scene = std::move(scene);
  impl->warnings = impl->scene.warnings;
  impl->bodies = findBodies(impl->scene);
  for (std::string& line : bodyWarnings(impl->scene, impl->bodies))
    impl->warnings.push_back(std::move(line));
  impl->flatten();
  impl->records = materialRecords(impl->scene);
  impl->lights = buildLightTable(
      {impl->scene, impl->positions, impl->uvs, impl->triangles, impl->geometries, impl->origin},
      impl->instances, impl->warnings);
  if (impl->lights.lights.empty() && impl->lights.foundByScattering == 0 &&
      impl->scene.ambient == glm::vec3(0.0f)) {
    bool unlit = false;
    for (const SceneMaterial& m : impl->scene.materials)
      unlit |= (m.data.flags & rl::RL_MATERIAL_UNLIT) != 0;
    impl->warnings.push_back(impl->scene.name + ": the scene has no light" +
                             (unlit ? " but unlit materials" : "; every pixel will be black") +
                             (unlit || impl->scene.environment ? "" : " (try --environment FILE)"));
  }
  impl->buildEmbree();
  impl->bindAddresses();
  return std::shared_ptr<const CompiledScene>(new CompiledScene(std::move(impl)));
}

const Scene& CompiledScene::source() const { return impl_->scene; }
const rl::SceneData& CompiledScene::data() const { return impl_->data; }
rl::FeatureMask CompiledScene::features(bool multiscatter) const {
  const bool changes = multiscatter && hasRoughReflection(impl_->scene);
  return impl_->features | (changes ? rl::RL_FEATURE_MULTISCATTER : 0u);
}

void CompiledScene::bindGgxAlbedo() const {
  std::call_once(impl_->ggxAlbedoBound, [this] {
    // Kernels only read; all buffer addresses share one non-const type.
    impl_->data.ggxAlbedo.data = const_cast<glm::vec2*>(ggxAlbedoTable().data());
  });
}
const Bvh& CompiledScene::bindBvh() const {
  Impl& m = *impl_;
  std::call_once(m.bvhBound, [&] {
    m.bvh = buildBvh(m.embree.device(), bvhInput());
    m.data.bvh.data = reinterpret_cast<glm::uvec4*>(m.bvh.records.data());
    m.data.bvhRoots.data = m.bvh.roots.data();
  });
  return m.bvh;
}

void CompiledScene::bindLightTree() const {
  Impl& m = *impl_;
  std::call_once(m.lightTreeBound, [&] {
    m.lightTree = buildLightTree(m.lights.lights);
    m.data.lightTree.data = m.lightTree.nodes.data();
    m.data.lightTrails.data = m.lightTree.trails.data();
  });
}

CompiledScene::Derived CompiledScene::derived(const std::string& name,
                                              const std::function<Derived()>& make) const {
  const std::lock_guard lock(impl_->derivedLock);
  std::map<std::string, Derived>& all = impl_->derived;
  if (const auto known = all.find(name); known != all.end()) return known->second;
  std::erase_if(all, [](const auto& unused) { return unused.second.use_count() == 1; });
  return all[name] = make();
}

BvhInput CompiledScene::bvhInput() const {
  const Impl& m = *impl_;
  return {m.positions, m.triangles, m.geometries, m.instances, m.shapeBoxes};
}

rl::SceneData CompiledScene::placedAt(const Place& place, bool withBvh) const {
  const Impl& m = *impl_;
  rl::SceneData placed = m.data;
  const auto move = [&](auto& ref, size_t count) {
    static_assert(sizeof ref.data == sizeof(uint64_t));
    const bool isEmpty = count == 0 || ref.data == nullptr;
    const uint64_t address = isEmpty ? 0 : place(ref.data, count * sizeof ref.data[0]);
    std::memcpy(&ref.data, &address, sizeof address);
  };
  move(placed.positions, m.positions.size());
  move(placed.normals, m.normals.size());
  move(placed.tangents, m.tangents.size());
  move(placed.colors, m.colors.size());
  move(placed.uvs, m.uvs.size());
  move(placed.triangles, m.triangles.size());
  move(placed.geometries, m.geometries.size());
  move(placed.instances, m.instances.size());
  move(placed.materials, m.records.materials.size());
  move(placed.textures, m.records.textures.size());
  move(placed.texels, m.records.texels.size());
  move(placed.srgbToLinear, m.records.srgb.size());
  move(placed.lights, m.lights.lights.size());
  move(placed.lightAlias, m.lights.alias.size());
  move(placed.lightTree, m.lightTree.nodes.size());
  move(placed.lightTrails, m.lightTree.trails.size());
  move(placed.environment, m.lights.environment.size());
  move(placed.environmentAlias, m.lights.environmentAlias.size());
  move(placed.closureParameters, m.records.closureParameters.size());
  move(placed.shapeWords, m.shapeWords.size());
  move(placed.bodies, m.bodies.media.size());
  move(placed.ggxAlbedo, m.data.ggxAlbedo.data != nullptr ? ggxAlbedoTable().size() : 0);
  move(placed.bvh, withBvh ? m.bvh.records.size() * rl::RL_BVH_RECORD_UVEC4S : 0);
  move(placed.bvhRoots, withBvh ? m.bvh.roots.size() : 0);
  return placed;
}

const std::vector<std::string>& CompiledScene::warnings() const { return impl_->warnings; }
size_t CompiledScene::triangleCount() const { return impl_->triangles.size(); }
size_t CompiledScene::instancedTriangleCount() const { return impl_->instancedTriangles; }
size_t CompiledScene::lightRecords() const { return impl_->lights.lights.size(); }
std::string CompiledScene::lightName(uint32_t record) const {
  const LightTable& table = impl_->lights;
  const rl::Light& light = table.lights.at(record);
  if (light.kind == rl::RL_LIGHT_ENVIRONMENT) return "environment";
  if (light.kind == rl::RL_LIGHT_AREA) return impl_->scene.instances.at(light.instance).name;
  return impl_->scene.lights.at(table.punctual.at(record - table.firstPunctual)).name;
}
size_t CompiledScene::lampCount() const { return impl_->lights.lamps; }
size_t CompiledScene::emissiveTriangleCount() const { return impl_->lights.emissiveTriangles; }
void* CompiledScene::embreeScene() const { return impl_->embree.top(); }
glm::dvec3 CompiledScene::origin() const { return impl_->origin; }

bool CompiledScene::differsInLightAlone(const CompiledScene& other) const {
  const Impl &a = *impl_, &b = *other.impl_;
  // Compare by content: a light factor may have split the material of several meshes in two.
  const auto isSameInstance = [&](const rl::Instance& of, const rl::Instance& with) {
    rl::Instance there = with;
    there.material = of.material;
    rl::Material here = a.records.materials[of.material], its = b.records.materials[with.material];
    its.emission = here.emission;
    return std::memcmp(&of, &there, sizeof of) == 0 && std::memcmp(&here, &its, sizeof here) == 0;
  };
  const auto isSame = [](const auto& of, const auto& with) {
    // memcmp() does not accept null, the data() of an empty vector.
    return of.size() == with.size() &&
           (of.empty() || std::memcmp(of.data(), with.data(), of.size() * sizeof(of[0])) == 0);
  };
  return a.features == b.features && a.origin == b.origin && a.positions == b.positions &&
         isSame(a.normals, b.normals) && isSame(a.tangents, b.tangents) && isSame(a.uvs, b.uvs) &&
         isSame(a.colors, b.colors) && isSame(a.geometries, b.geometries) &&
         isSame(a.triangles, b.triangles) && isSame(a.records.textures, b.records.textures) &&
         isSame(a.records.texels, b.records.texels) &&
         isSame(a.records.closureParameters, b.records.closureParameters) &&
         isSame(a.bodies.media, b.bodies.media) && isSame(a.shapeWords, b.shapeWords) &&
         std::equal(a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(),
                    isSameInstance) &&
         a.lights.lights.size() == b.lights.lights.size() &&
         a.data.environmentWidth == b.data.environmentWidth &&
         a.data.environmentHeight == b.data.environmentHeight;
}

glm::uvec4 CompiledScene::bodiesAt(const glm::vec3& posW) const {
  const Impl& m = *impl_;
  return restlab::bodiesAt(m.scene, m.bodies, glm::dvec3(posW) + m.origin);
}

bool CompiledScene::absorbs(uint32_t rank) const {
  return rank != 0 && glm::vec3(impl_->bodies.media.at(2 * size_t(rank))) != glm::vec3(0.0f);
}

size_t CompiledScene::embreeBytes() const { return impl_->embree.bytes(); }

size_t CompiledScene::bytes() const {
  auto of = [](const auto& v) { return v.size() * sizeof(v[0]); };
  const Impl& i = *impl_;
  return of(i.positions) + of(i.normals) + of(i.tangents) + of(i.colors) + of(i.uvs) +
         of(i.triangles) + of(i.geometries) + of(i.instances) + of(i.records.materials) +
         of(i.records.closureParameters) + of(i.records.textures) + of(i.records.texels) +
         of(i.records.srgb) + of(i.lights.lights) + of(i.lights.alias) + of(i.lights.environment) +
         of(i.lights.environmentAlias) + of(i.lightTree.nodes) + of(i.lightTree.trails) +
         of(i.bodies.media) + of(i.shapeWords);
}

}  // namespace restlab
