#include "core/backend/bsdf_probe.h"

#include "core/backend/cpu_kernel.h"
#include "core/backend/embree.h"
#include "core/base/error.h"
#include "core/backend/trace_callbacks.h"
#include "core/dialect/order.h"
#include "core/scene/compiled/compiled_scene.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"

namespace rl {
namespace {

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) (++gCounters.health[kind])
#define RL_COUNT_RAY(mode) (++((mode) == RL_RAY_SHADOW ? gCounters.raysShadow : gCounters.raysPath))

// The functions of a kernel, as in core/backend/cpu_kernel.inl.
struct Ctx {
  static constexpr FeatureMask kFeatures = RL_FEATURE_ALL & ~RL_FEATURE_MULTISCATTER;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;
  RTCScene embreeScene;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"
};

}  // namespace
}  // namespace rl

namespace restlab {
namespace {

const glm::vec3 kUp(0.0f, 0.0f, 1.0f);

// A triangle in z = 0 with the material, and the tangent along x.
Scene triangleOf(const SceneMaterial& material, const Scene& images) {
  Scene scene;
  scene.name = "probe";
  scene.images = images.images;
  scene.textureUses = images.textureUses;
  scene.tables = images.tables;
  scene.materials = images.materials;  // parts of mixtures, by their index
  scene.materials.push_back(material);
  MeshGeometry mesh;
  mesh.name = "triangle";
  mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  mesh.triangles = {{0, 1, 2}};
  for (auto& uvs : mesh.uvs) uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
  scene.geometries = {mesh};
  const auto last = static_cast<uint32_t>(scene.materials.size() - 1);
  scene.instances = {{"triangle", 0, last, glm::dmat4(1.0)}};
  scene.cameras = {SceneCamera{}};
  return scene;
}

}  // namespace

struct BsdfProbe::Impl {
  std::shared_ptr<const CompiledScene> compiled;
  rl::FrameData frame{};
  rl::CpuKernelCounters counters;
  mutable rl::Ctx context;
  rl::Bsdf bsdf{};

  explicit Impl(Scene scene)
      : compiled(CompiledScene::build(std::move(scene))),
        context{compiled->data(), frame, counters, static_cast<RTCScene>(compiled->embreeScene())} {
    if (context.gScene.instanceCount == 0)
      failInput("an index of refraction of 1 and no colour: nothing can be seen of this material");
    const rl::Hit hit{0, 0, {1e-4f, 1e-4f}, 1.0f};
    bsdf = context.surfaceLoad(hit, -kUp).bsdf;
  }
};

BsdfProbe::BsdfProbe(const SceneMaterial& material, const Scene& scene)
    : impl_(std::make_unique<Impl>(triangleOf(material, scene))) {}
BsdfProbe::~BsdfProbe() = default;

glm::dvec3 BsdfProbe::eval(const glm::dvec3& wo, const glm::dvec3& wi, double& pdf) const {
  float density = 0.0f;
  const glm::vec3 f =
      impl_->context.bsdfEvalAndPdf(impl_->bsdf, kUp, kUp, glm::vec3(wo), glm::vec3(wi), density);
  pdf = density;
  return f;
}

BsdfDraw BsdfProbe::draw(const glm::dvec3& wo, double uLobe, const glm::dvec2& u) const {
  if (impl_->bsdf.lobes == 0u) return {};  // a path ends here before anything is drawn
  const rl::BsdfSample s =
      impl_->context.bsdfSample(impl_->bsdf, kUp, kUp, glm::vec3(wo), float(uLobe), glm::vec2(u));
  if (s.lobe == 0u) return {};
  return {s.wi, s.weight, s.pdfSolidAngle, (s.lobe & rl::RL_LOBE_ANY_DELTA) != 0u, false};
}

double BsdfProbe::alpha() const { return impl_->bsdf.alpha; }
bool BsdfProbe::hasDelta() const { return (impl_->bsdf.lobes & rl::RL_LOBE_ANY_DELTA) != 0u; }
bool BsdfProbe::hasSpecular() const {
  return (impl_->bsdf.lobes & (rl::RL_LOBE_SPECULAR | rl::RL_LOBE_COAT)) != 0u;
}
bool BsdfProbe::hasTransmission() const {
  return (impl_->bsdf.lobes & rl::RL_LOBE_ANY_PASSING) != 0u;
}

}  // namespace restlab
