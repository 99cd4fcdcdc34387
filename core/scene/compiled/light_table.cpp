#include "core/scene/compiled/light_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "core/scene/compiled/alias_table.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

// Reservoirs name a light in 28 bits, all ones for none (core/path_sample/direct_sample.glsl).
constexpr size_t kMostLights = (size_t{1} << 28) - 1;

constexpr double kPi = std::numbers::pi;

double luminance(const glm::dvec3& c) { return 0.212639 * c.x + 0.715169 * c.y + 0.072192 * c.z; }

int wrapIndex(int i, int n, uint32_t mode) {
  if (mode == rl::RL_WRAP_CLAMP) return std::clamp(i, 0, n - 1);
  const int period = mode == rl::RL_WRAP_MIRROR ? 2 * n : n;
  int r = i % period;
  if (r < 0) r += period;
  return r >= n ? period - 1 - r : r;
}

// Luminance of the emissive texture at a UV (nearest texel, not decoded): an estimate that only
// steers selection probabilities.
double texelLuminance(const Scene& scene, const TextureUse& use, const glm::vec2& uv) {
  const TextureImage& image = scene.images[use.image];
  const glm::vec3 h(uv, 1.0f);
  const double u = glm::dot(use.uvRow0, h), v = glm::dot(use.uvRow1, h);
  if (!std::isfinite(u) || !std::isfinite(v) || std::abs(u) > 1e6 || std::abs(v) > 1e6) return 0.0;
  const int x = wrapIndex(int(std::floor(u * image.width)), int(image.width), use.wrapU);
  const int y = wrapIndex(int(std::floor(v * image.height)), int(image.height), use.wrapV);
  const uint32_t t = image.texels[size_t(y) * image.width + x];
  auto decode = [&](uint32_t c) { return use.srgb ? std::pow(c / 255.0, 2.2) : c / 255.0; };
  return luminance({decode(t & 255u), decode((t >> 8) & 255u), decode((t >> 16) & 255u)});
}

// Mean luminance of the texture over a triangle from 16 stratified points. Never zero: texels
// between the points may still shine, so a twentieth of full brightness is always assumed.
double textureFactor(const LightTableInput& in, const rl::Geometry& g, const TextureUse& use,
                     const glm::uvec3& corners) {
  const uint32_t offset = g.uvOffset[use.uvSet];
  double sum = 0.0;
  constexpr int n = 4;
  for (int i = 0; i < n * n; ++i) {
    const double s = std::sqrt((i % n + 0.5) / n), t = (i / n + 0.5) / n;
    const auto b1 = static_cast<float>(1.0 - s), b2 = static_cast<float>(t * s);
    glm::vec2 uv(0.0f);
    if (offset != rl::RL_INVALID) {
      const glm::vec2 a = in.uvs[offset + corners.x], b = in.uvs[offset + corners.y],
                      c = in.uvs[offset + corners.z];
      uv = a + b1 * (b - a) + b2 * (c - a);
    }
    sum += texelLuminance(in.scene, use, uv);
  }
  return 0.05 + 0.95 * sum / (n * n);
}

glm::vec3 toWorld(const rl::Instance& inst, const glm::vec3& p) {
  if ((inst.flags & rl::RL_INSTANCE_IDENTITY) != 0) return p;
  const glm::vec4 h(p, 1.0f);
  return {glm::dot(inst.objectToWorldRow0, h), glm::dot(inst.objectToWorldRow1, h),
          glm::dot(inst.objectToWorldRow2, h)};
}

glm::vec3 vectorToWorld(const rl::Instance& inst, const glm::vec3& v) {
  if ((inst.flags & rl::RL_INSTANCE_IDENTITY) != 0) return v;
  const glm::vec4 h(v, 0.0f);
  return {glm::dot(inst.objectToWorldRow0, h), glm::dot(inst.objectToWorldRow1, h),
          glm::dot(inst.objectToWorldRow2, h)};
}

// Bounds the rounding error of a triangle's points, as in surfaceTriangle(): |M| |p| + |T|.
float magnitudeOf(const rl::Instance& inst, const glm::vec3& corner) {
  if ((inst.flags & rl::RL_INSTANCE_IDENTITY) != 0) return std::max({corner.x, corner.y, corner.z});
  const glm::vec4 h(corner, 1.0f);
  return std::max({glm::dot(glm::abs(inst.objectToWorldRow0), h),
                   glm::dot(glm::abs(inst.objectToWorldRow1), h),
                   glm::dot(glm::abs(inst.objectToWorldRow2), h)});
}

// Kinds of lights whose weights have no common unit: a lamp has power (W), sun and sky have power
// per area that faces them. Weights of different kinds are not comparable.
enum Kind : size_t { kLamps, kSuns, kSky, kKinds };

struct Weights {
  std::vector<double> values;  // one per light: W, W/m^2, W/m^2
  std::vector<Kind> kinds;

  void add(Kind kind, double value) {
    values.push_back(value);
    kinds.push_back(kind);
  }
};

// Scales weights so that each kind with any weight gets the same share, whatever its unit:
// docs/decisions/light-selection.md. Empty if all weights are 0.
std::vector<double> withFairShares(const Weights& weights) {
  std::array<double, kKinds> total{};
  for (size_t i = 0; i < weights.values.size(); ++i) total[weights.kinds[i]] += weights.values[i];
  if (std::accumulate(total.begin(), total.end(), 0.0) <= 0.0) return {};
  std::vector<double> fair(weights.values.size(), 0.0);
  for (size_t i = 0; i < fair.size(); ++i) {
    const double ofKind = total[weights.kinds[i]];
    if (ofKind > 0.0) fair[i] = weights.values[i] / ofKind;
  }
  return fair;
}

void countLamps(const Weights& weights, LightTable& table) {
  double lamps = 0.0;
  bool isAll = true;
  for (size_t i = 0; i < weights.values.size(); ++i) {
    if (weights.kinds[i] == kLamps) {
      ++table.lamps;
      lamps += double(table.alias[i].pmf);
    } else if (weights.values[i] > 0.0) {
      isAll = false;
    }
  }
  table.lampShare = isAll ? 1.0f : static_cast<float>(lamps);
}

// Appends the triangles of an emitting instance with their power (W, up to a common factor).
size_t addTriangles(const LightTableInput& in, const rl::Instance& inst, uint32_t instanceIndex,
                    LightTable& table, Weights& weights) {
  const rl::Material& material = in.scene.materials[inst.material].data;
  const float factor = in.scene.materials[inst.material].lightFactor;
  const rl::Geometry& g = in.geometries[inst.geometry];
  const bool twoSided = (material.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0;
  const bool flipped = (inst.flags & rl::RL_INSTANCE_FLIPPED) != 0;
  size_t zeroArea = 0;
  for (uint32_t t = 0; t < g.triangleCount; ++t) {
    const glm::uvec3 corners = in.triangles[g.firstTriangle + t];
    rl::Light light{};
    light.kind = rl::RL_LIGHT_AREA;
    const glm::vec3 p0 = in.positions[g.firstVertex + corners.x],
                    p1 = in.positions[g.firstVertex + corners.y],
                    p2 = in.positions[g.firstVertex + corners.z];
    light.p0 = toWorld(inst, p0);
    // Transform edges as vectors: differences of far corners would leave small triangles no area.
    light.e1 = vectorToWorld(inst, p1 - p0);
    light.e2 = vectorToWorld(inst, p2 - p0);
    light.magnitude =
        magnitudeOf(inst, glm::max(glm::abs(p0), glm::max(glm::abs(p1), glm::abs(p2))));
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(light.e1), glm::dvec3(light.e2)));
    double radiance = double(factor) * luminance(glm::dvec3(material.emission));
    const uint32_t texture = material.textures[rl::RL_TEX_EMISSIVE];
    if (texture != rl::RL_INVALID)
      radiance *= textureFactor(in, g, in.scene.textureUses[texture], corners);
    light.radiance = material.emission * factor;
    light.instance = instanceIndex;
    light.primitive = t;
    light.flags = twoSided ? rl::RL_MATERIAL_DOUBLE_SIDED : 0u;
    const bool usable = area > 0.0 && std::isfinite(1.0f / static_cast<float>(area));
    if (!usable) ++zeroArea;
    light.areaInverse = usable ? static_cast<float>(1.0 / area) : 0.0f;
    if (flipped) light.flags |= rl::RL_LIGHT_FLIPPED;
    table.lights.push_back(light);
    weights.add(kLamps, usable ? kPi * area * radiance * (twoSided ? 2.0 : 1.0) : 0.0);
    if (usable) ++table.emissiveTriangles;
  }
  return zeroArea;
}

// Appends the shape of an emitting instance with its power; returns whether it has an area.
bool addShape(const LightTableInput& in, const rl::Instance& inst, uint32_t instanceIndex,
              LightTable& table, Weights& weights) {
  const SceneMaterial& material = in.scene.materials[inst.material];
  const MeshGeometry& standIn = in.scene.geometries[in.scene.instances[instanceIndex].geometry];
  rl::Light light{};
  light.kind = rl::RL_LIGHT_AREA;
  light.flags = rl::RL_LIGHT_SHAPE | (material.data.flags & rl::RL_MATERIAL_DOUBLE_SIDED);
  const std::array<glm::vec3, 2> box = standIn.shape->info->box(*standIn.shape);
  light.p0 = toWorld(inst, 0.5f * (box[0] + box[1]));
  const glm::vec3 half = 0.5f * (box[1] - box[0]);
  light.e1 = {glm::dot(glm::abs(glm::vec3(inst.objectToWorldRow0)), half),
              glm::dot(glm::abs(glm::vec3(inst.objectToWorldRow1)), half),
              glm::dot(glm::abs(glm::vec3(inst.objectToWorldRow2)), half)};
  if (standIn.shape->info->isFlat) {
    const glm::dvec3 normal(inst.worldToObjectRow2);  // of z, by the inverse transpose
    light.e2 = glm::vec3(normal / glm::length(normal));
  }
  light.radiance = material.data.emission * material.lightFactor;
  light.instance = instanceIndex;
  double area = 0.0;
  for (const glm::uvec3& t : standIn.triangles) {
    const glm::vec3 p = standIn.positions[t.x];
    const glm::dvec3 e1(vectorToWorld(inst, standIn.positions[t.y] - p));
    const glm::dvec3 e2(vectorToWorld(inst, standIn.positions[t.z] - p));
    area += 0.5 * glm::length(glm::cross(e1, e2));
  }
  const bool isTwoSided = (light.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0;
  table.lights.push_back(light);
  weights.add(kLamps,
              kPi * area * luminance(glm::dvec3(light.radiance)) * (isTwoSided ? 2.0 : 1.0));
  return area > 0.0;
}

rl::Light punctual(const PunctualLight& source, const glm::dvec3& origin) {
  rl::Light light{};
  light.kind = source.kind;
  light.p0 = glm::vec3(source.posW - origin);
  light.e1 = glm::vec3(glm::normalize(source.dirW));
  light.radiance = source.intensity * source.lightFactor;
  light.instance = rl::RL_INVALID;
  if (source.kind == rl::RL_LIGHT_POINT) light.e2 = source.attenuation;
  if (source.kind == rl::RL_LIGHT_SPOT) {
    // KHR_lights_punctual: falloff = clamp(cos * scale + offset)^2.
    const float cosOuter = std::cos(source.outerConeAngle);
    const float scale = 1.0f / std::max(0.001f, std::cos(source.innerConeAngle) - cosOuter);
    light.e2 = glm::vec3(scale, -cosOuter * scale, 0.0f);
  }
  return light;
}

// Computes alias weights of the environment: solid angle of the row times the mean of the bilinear
// luminance over the texel, which is 6/8 of its own and 1/8 of each neighbour's value, along both
// axes. The weight is positive wherever the radiance is.
double addEnvironment(const EnvironmentMap& map, LightTable& table) {
  const int w = int(map.width), h = int(map.height);
  table.environment.resize(size_t(w) * h);
  for (size_t i = 0; i < table.environment.size(); ++i)
    table.environment[i] = map.radiance[i] * map.scale;
  std::vector<double> weights(table.environment.size());
  constexpr std::array<double, 3> kShare{0.125, 0.75, 0.125};
  double flux = 0.0;
  for (int y = 0; y < h; ++y) {
    const double solidAngle = 2.0 * kPi / w * (std::cos(kPi * y / h) - std::cos(kPi * (y + 1) / h));
    for (int x = 0; x < w; ++x) {
      double sum = 0.0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int yy = std::clamp(y + dy, 0, h - 1), xx = (x + dx + w) % w;
          sum += kShare[size_t(dy + 1)] * kShare[size_t(dx + 1)] *
                 luminance(glm::dvec3(table.environment[size_t(yy) * w + xx]));
        }
      }
      weights[size_t(y) * w + x] = solidAngle * sum;
      flux += weights[size_t(y) * w + x];
    }
  }
  if (flux > 0.0) table.environmentAlias = buildAliasTable(weights, size_t(w));
  for (glm::vec3& texel : table.environment) texel *= map.lightFactor;
  return flux;
}

}  // namespace

LightTable buildLightTable(const LightTableInput& in, std::vector<rl::Instance>& instances,
                           std::vector<std::string>& warnings) {
  LightTable table;
  Weights weights;
  for (uint32_t i = 0; i < instances.size(); ++i) {
    const SceneMaterial& material = in.scene.materials[instances[i].material];
    const bool unlit = (material.data.flags & rl::RL_MATERIAL_UNLIT) != 0;
    if (unlit || !(luminance(glm::dvec3(material.data.emission)) > 0.0)) continue;
    const auto first = static_cast<uint32_t>(table.lights.size());
    const size_t before = table.emissiveTriangles;
    const bool isShape = in.geometries[instances[i].geometry].shape != rl::RL_SHAPE_TRIANGLES;
    const auto& shape = in.scene.geometries[in.scene.instances[i].geometry].shape;
    if (isShape && !shape->info->hasDraws) {
      ++table.foundByScattering;
      continue;
    }
    size_t zeroArea = 0;
    if (isShape) {
      if (addShape(in, instances[i], i, table, weights)) ++table.emissiveTriangles;
    } else {
      zeroArea = addTriangles(in, instances[i], i, table, weights);
    }
    if (zeroArea > 0) {
      warnings.push_back(fmt::format(
          "{}: {}: {} of {} emissive triangles have no area and give no light", in.scene.name,
          in.scene.instances[i].name, zeroArea, table.lights.size() - first));
    }
    if (table.emissiveTriangles == before) {
      table.lights.resize(first);
      weights.values.resize(first);
      weights.kinds.resize(first);
    } else {
      instances[i].firstLight = first;
    }
  }
  table.firstPunctual = static_cast<uint32_t>(table.lights.size());
  for (uint32_t i = 0; i < in.scene.lights.size(); ++i) {
    const PunctualLight& source = in.scene.lights[i];
    const double intensity = luminance(glm::dvec3(source.intensity));
    double power = 4.0 * kPi * intensity;
    if (source.kind == rl::RL_LIGHT_SPOT)
      // 1 - cos without cancellation
      power = 4.0 * kPi * std::pow(std::sin(0.5 * double(source.outerConeAngle)), 2.0) * intensity;
    const bool isSun = source.kind == rl::RL_LIGHT_DIRECTIONAL;
    if (isSun) power = intensity;  // W/m^2
    if (!(power > 0.0)) {
      warnings.push_back(
          fmt::format("{}: light '{}' has no intensity", in.scene.name, source.name));
      continue;
    }
    if (source.kind != rl::RL_LIGHT_POINT && !(glm::length(source.dirW) > 0.0))
      failInput(fmt::format("{}: light '{}' has no direction: its length is 0", in.scene.name,
                            source.name));
    table.punctual.push_back(i);
    table.lights.push_back(punctual(source, in.origin));
    weights.add(isSun ? kSuns : kLamps, power * double(source.lightFactor));
  }
  if (in.scene.environment) {
    const double flux = addEnvironment(*in.scene.environment, table);
    if (flux > 0.0) {
      table.environmentLight = static_cast<uint32_t>(table.lights.size());
      rl::Light light{};
      light.kind = rl::RL_LIGHT_ENVIRONMENT;
      light.instance = rl::RL_INVALID;
      table.lights.push_back(light);
      weights.add(kSky, flux * double(in.scene.environment->lightFactor));
    } else {
      warnings.push_back(in.scene.name + ": the environment is black");
    }
  }
  if (table.lights.size() > kMostLights)
    failInput(fmt::format("{}: {} lights and emitting triangles; at most {} are supported",
                          in.scene.name, table.lights.size(), kMostLights));
  const std::vector<double> shares = withFairShares(weights);
  if (!shares.empty()) {
    table.alias = buildAliasTable(shares, shares.size());
    for (size_t i = 0; i < table.lights.size(); ++i) table.lights[i].pmf = table.alias[i].pmf;
    countLamps(weights, table);
  }
  return table;
}

}  // namespace restlab
