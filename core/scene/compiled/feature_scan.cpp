// Features of the kernels (features.h) that a scene needs. A feature that can change a pixel is
// never missed (for a scene whose black textures are folded: black_textures.h); a feature that
// cannot is left out, as far as factors, texels and vertices tell. Only content used by an instance
// with triangles counts. The conditions mirror surfaceLoad() in core/geometry/surface.glsl.
// RL_FEATURE_MULTISCATTER is a session's option, not a scene's need, and is never set here;
// hasRoughReflection() says whether the option changes anything.
#include <algorithm>
#include <cmath>

#include "core/scene/shapes/shape_info.h"
#include "core/scene/compiled/bodies.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/textures/texture_range.h"
#include "core/shading/bsdf.h"
#include "core/scene/closure_info.h"

namespace restlab {
namespace {

// Vertex normals within this distance of the unit face normal shade like the face.
constexpr float kFlatNormalTolerance = 1.0e-4f;

bool isPositive(const glm::vec3& v) { return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f; }

glm::vec3 times(const glm::vec3& v, const std::array<float, 4>& texel) {
  return v * glm::vec3(texel[0], texel[1], texel[2]);
}

bool hasTexture(const rl::Material& m, uint32_t slot) { return m.textures[slot] != rl::RL_INVALID; }

rl::FeatureMask scanClosure(const SceneMaterial& material) {
  const ClosureInfo& info = closureRegistry().at(material.data.closure - 1);
  rl::FeatureMask features = rl::RL_FEATURE_GLOSSY | info.feature;
  for (const ClosureValue& value : material.closure) {
    if (value.texture != rl::RL_INVALID) features |= rl::RL_FEATURE_TEXTURES;
  }
  return features;
}

// Features of the layers of glTF's extensions. They look at all that the lobes below have.
rl::FeatureMask scanLayers(const SceneMaterial& material) {
  const rl::Material& m = material.data;
  if ((m.flags & rl::RL_MATERIAL_LAYERS) == 0) return 0;
  rl::FeatureMask features = rl::RL_FEATURE_GLOSSY;
  const auto add = [&](uint32_t flag, rl::FeatureMask needed) {
    if ((m.flags & flag) != 0) features |= needed;
  };
  add(rl::RL_MATERIAL_CLEARCOAT, rl::RL_FEATURE_CLEARCOAT);
  add(rl::RL_MATERIAL_SHEEN, rl::RL_FEATURE_SHEEN);
  add(rl::RL_MATERIAL_ANISOTROPY, rl::RL_FEATURE_ANISOTROPY);
  add(rl::RL_MATERIAL_IRIDESCENCE, rl::RL_FEATURE_IRIDESCENCE);
  // Light samples behind a surface are a matter of the second.
  add(rl::RL_MATERIAL_DIFFUSE_TRANSMISSION,
      rl::RL_FEATURE_DIFFUSE_TRANSMISSION | rl::RL_FEATURE_TRANSMISSION);
  add(rl::RL_MATERIAL_DISPERSION, rl::RL_FEATURE_DISPERSION);
  if (material.closure.at(rl::RL_LAYER_CLEARCOAT_NORMAL).texture != rl::RL_INVALID)
    features |= rl::RL_FEATURE_NORMAL_MAPS;
  for (const ClosureValue& value : material.closure) {
    if (value.texture != rl::RL_INVALID) features |= rl::RL_FEATURE_TEXTURES;
  }
  for (uint32_t slot = 0; slot < rl::RL_TEX_COUNT; ++slot) {
    if (slot != rl::RL_TEX_NORMAL && slot != rl::RL_TEX_EMISSIVE && hasTexture(m, slot))
      features |= rl::RL_FEATURE_TEXTURES;
  }
  return features;
}

// Materials that a material mixes.
std::vector<uint32_t> mixedMaterials(const SceneMaterial& material) {
  std::vector<uint32_t> mixed;
  if (material.data.closure == rl::RL_CLOSURE_GLTF) return mixed;
  const ClosureInfo& info = closureRegistry().at(material.data.closure - 1);
  for (size_t i = 0; i < material.closure.size(); ++i) {
    const uint32_t index = material.closure[i].words.x;
    if (info.parameters.at(i).kind == ClosureParameter::Kind::material && index != rl::RL_INVALID)
      mixed.push_back(index);
  }
  return mixed;
}

// Features that the material needs on any mesh; emission and alpha also depend on the mesh.
rl::FeatureMask scanSurface(const SceneMaterial& material, TextureRanges& ranges) {
  const rl::Material& m = material.data;
  const bool scatters = (m.flags & (rl::RL_MATERIAL_UNLIT | rl::RL_MATERIAL_BLACK)) == 0;
  rl::FeatureMask features = hasTexture(m, rl::RL_TEX_BASE_COLOR) ? rl::RL_FEATURE_TEXTURES : 0u;
  if (!scatters) return features;
  if (hasTexture(m, rl::RL_TEX_NORMAL) && m.normalScale != 0.0f)
    features |= rl::RL_FEATURE_NORMAL_MAPS;
  if (m.closure != rl::RL_CLOSURE_GLTF) return features | scanClosure(material);

  features |= scanLayers(material);
  const TexelRange& metalRange = ranges.ofSlot(m, rl::RL_TEX_METALLIC_ROUGHNESS);
  const glm::vec3 base = times(m.baseColor, ranges.ofSlot(m, rl::RL_TEX_BASE_COLOR).high);
  const glm::vec3 tint = times(m.specularColor, ranges.ofSlot(m, rl::RL_TEX_SPECULAR_COLOR).high);
  const bool isSometimesMetal = m.metallic * metalRange.high[2] > 0.0f;
  const bool isSometimesDielectric = m.metallic * metalRange.low[2] < 1.0f;
  const float specular = m.specular * ranges.ofSlot(m, rl::RL_TEX_SPECULAR).high[3];
  const float transmission = m.transmission * ranges.ofSlot(m, rl::RL_TEX_TRANSMISSION).high[0];

  const bool isMetal = isSometimesMetal && isPositive(base);
  const bool isCoated =
      isSometimesDielectric && specular > 0.0f && isPositive(tint) && m.ior != 1.0f;
  const bool transmits = isSometimesDielectric && transmission > 0.0f;
  if (isMetal || isCoated || transmits) {
    features |= rl::RL_FEATURE_GLOSSY;
    for (const uint32_t slot : {rl::RL_TEX_METALLIC_ROUGHNESS, rl::RL_TEX_TRANSMISSION,
                                rl::RL_TEX_SPECULAR, rl::RL_TEX_SPECULAR_COLOR}) {
      if (hasTexture(m, slot)) features |= rl::RL_FEATURE_TEXTURES;
    }
  }
  if (transmits) {
    features |= rl::RL_FEATURE_TRANSMISSION;
    const bool isThin = (m.flags & rl::RL_MATERIAL_THIN) != 0;
    if (!isThin && isPositive(m.sigmaAbsorption)) features |= rl::RL_FEATURE_VOLUME;
    if (!isThin && isPositive(material.sigmaScattering))
      features |= rl::RL_FEATURE_VOLUME | rl::RL_FEATURE_SCATTERING;
  }
  return features;
}

// Returns whether the surface has a rough reflection and somewhere does not transmit.
bool reflectsRoughly(const rl::Material& m, TextureRanges& ranges) {
  if ((m.flags & (rl::RL_MATERIAL_UNLIT | rl::RL_MATERIAL_BLACK)) != 0) return false;
  if (m.closure != rl::RL_CLOSURE_GLTF) return false;
  const TexelRange& range = ranges.ofSlot(m, rl::RL_TEX_METALLIC_ROUGHNESS);
  const glm::vec3 base = times(m.baseColor, ranges.ofSlot(m, rl::RL_TEX_BASE_COLOR).high);
  const glm::vec3 tint = times(m.specularColor, ranges.ofSlot(m, rl::RL_TEX_SPECULAR_COLOR).high);
  const bool isMetal = m.metallic * range.high[2] > 0.0f && isPositive(base);
  const bool isCoated = m.metallic * range.low[2] < 1.0f && isPositive(tint) && m.ior != 1.0f &&
                        m.specular * ranges.ofSlot(m, rl::RL_TEX_SPECULAR).high[3] > 0.0f;
  const float roughness = m.roughness * range.high[1];
  const bool alwaysTransmits =
      m.transmission * ranges.ofSlot(m, rl::RL_TEX_TRANSMISSION).low[0] > 0.0f &&
      m.metallic * range.high[2] < 1.0f;
  // Facets stretched along the tangent are rough along one axis.
  const bool isRough =
      roughness * roughness >= rl::RL_ALPHA_FLOOR || (m.flags & rl::RL_MATERIAL_ANISOTROPY) != 0;
  return (isMetal || isCoated) && isRough && !alwaysTransmits;
}

bool emits(const rl::Material& m, TextureRanges& ranges) {
  if ((m.flags & rl::RL_MATERIAL_UNLIT) != 0) return false;  // not in the light table
  return isPositive(times(m.emission, ranges.ofSlot(m, rl::RL_TEX_EMISSIVE).high));
}

bool hasArea(const MeshGeometry& mesh, const glm::dmat4& toWorld) {
  const glm::dmat3 linear(toWorld);
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    const glm::dvec3 p(mesh.positions[t.x]);
    const glm::dvec3 e1 = linear * (glm::dvec3(mesh.positions[t.y]) - p);
    const glm::dvec3 e2 = linear * (glm::dvec3(mesh.positions[t.z]) - p);
    return glm::length(glm::cross(e1, e2)) > 0.0;
  });
}

bool hasColors(const MeshGeometry& mesh) {
  return std::any_of(mesh.colors.begin(), mesh.colors.end(),
                     [](const glm::vec4& c) { return c != glm::vec4(1.0f); });
}

// Returns whether a ray can pass through some part of the surface.
bool hasHoles(const rl::Material& m, const MeshGeometry& mesh, TextureRanges& ranges) {
  float alpha = m.alpha * ranges.ofSlot(m, rl::RL_TEX_BASE_COLOR).low[3];
  float lowest = mesh.colors.empty() ? 1.0f : mesh.colors[0].w;
  for (const glm::vec4& c : mesh.colors) lowest = std::min(lowest, c.w);
  alpha *= lowest;
  if ((m.flags & rl::RL_MATERIAL_ALPHA_MASK) != 0) return alpha < m.alphaCutoff;
  return (m.flags & rl::RL_MATERIAL_ALPHA_BLEND) != 0 && alpha < 1.0f;
}

bool hasSmoothNormals(const MeshGeometry& mesh) {
  if (mesh.normals.empty()) return false;
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    const glm::dvec3 p(mesh.positions[t.x]);
    const glm::dvec3 face =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - p, glm::dvec3(mesh.positions[t.z]) - p);
    const double length = glm::length(face);
    if (!(length > 0.0)) return false;  // no ray hits it
    for (const uint32_t corner : {t.x, t.y, t.z}) {
      const glm::dvec3 normal(mesh.normals[corner]);
      const double size = glm::length(normal);
      if (size > 0.0 && glm::distance(normal / size, face / length) > kFlatNormalTolerance)
        return true;
    }
    return false;
  });
}

rl::FeatureMask scanLights(const Scene& scene) {
  rl::FeatureMask features = 0;
  for (const PunctualLight& light : scene.lights) {
    if (isPositive(light.intensity)) features |= rl::RL_FEATURE_PUNCTUAL_LIGHTS;
  }
  if (isPositive(scene.ambient)) features |= rl::RL_FEATURE_AMBIENT;
  if (scene.environment && scene.environment->scale > 0.0f) {
    const std::vector<glm::vec3>& map = scene.environment->radiance;
    if (std::any_of(map.begin(), map.end(), isPositive)) features |= rl::RL_FEATURE_ENVIRONMENT;
  }
  return features;
}

}  // namespace

rl::FeatureMask scanFeatures(const Scene& scene) {
  rl::FeatureMask features = scanLights(scene);
  TextureRanges ranges(scene);
  std::vector<uint32_t> uses(scene.geometries.size(), 0);
  std::vector<char> isMaterialSeen(scene.materials.size(), 0);
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& mesh = scene.geometries.at(instance.geometry);
    const rl::Material& m = scene.materials.at(instance.material).data;
    if (mesh.triangles.empty()) continue;
    if (isMaterialSeen[instance.material] == 0) {
      isMaterialSeen[instance.material] = 1;
      features |= scanSurface(scene.materials.at(instance.material), ranges);
      for (const uint32_t mixed : mixedMaterials(scene.materials[instance.material]))
        features |= scanSurface(scene.materials.at(mixed), ranges);
    }
    if (emits(m, ranges) && hasArea(mesh, instance.objectToWorld)) {
      features |= rl::RL_FEATURE_AREA_LIGHTS;
      if (hasTexture(m, rl::RL_TEX_EMISSIVE)) features |= rl::RL_FEATURE_EMISSIVE_TEXTURES;
    }
    if (hasHoles(m, mesh, ranges)) features |= rl::RL_FEATURE_ALPHA;
    if (mesh.shape != nullptr) {
      features |= mesh.shape->info->feature;
      continue;
    }
    const uint32_t useCount = ++uses[instance.geometry];
    if (useCount == 2) features |= rl::RL_FEATURE_INSTANCES;
    if (useCount == 1) {  // only once per mesh
      if (hasColors(mesh)) features |= rl::RL_FEATURE_VERTEX_COLORS;
      if (hasSmoothNormals(mesh)) features |= rl::RL_FEATURE_SMOOTH_NORMALS;
    }
  }
  // Bodies that meet refract light by the ratio of their indices.
  const bool transmits = (features & rl::RL_FEATURE_TRANSMISSION) != 0;
  if (transmits && findBodies(scene).meet) features |= rl::RL_FEATURE_VOLUME;
  return features;
}

bool hasRoughReflection(const Scene& scene) {
  TextureRanges ranges(scene);
  const auto isRough = [&](uint32_t material) {
    return reflectsRoughly(scene.materials.at(material).data, ranges);
  };
  return std::any_of(
      scene.instances.begin(), scene.instances.end(), [&](const MeshInstance& instance) {
        if (scene.geometries.at(instance.geometry).triangles.empty()) return false;
        const std::vector<uint32_t> mixed = mixedMaterials(scene.materials.at(instance.material));
        return isRough(instance.material) || std::any_of(mixed.begin(), mixed.end(), isRough);
      });
}

}  // namespace restlab
