#include "core/frame/image_denoiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/backend/backend.h"
#include "core/base/error.h"
#include "core/dialect/order.h"
#include "core/frame/frame_stats.h"
#include "core/frame/host_filter.h"
#include "core/frame/method.h"
#include "core/frame/pipeline.h"
#include "core/gbuffer/layers.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

namespace {

// Layers in the order of the kernel's Buffers struct.
constexpr std::array<const char*, 5> kLayers = {"radiance", "layer_normal", "layer_albedo",
                                                "layer_depth", "layer_motion"};

void recordLayers(FrameGraph& g, const FrameInfo& f) {
  std::array<Buffer, kLayers.size()> layer;
  for (size_t i = 0; i < kLayers.size(); ++i)
    layer[i] = g.buffer(kLayers[i], f.pixels, sizeof(glm::vec3));
  const History features = g.advance(g.history("guide", f.pixels, 16 * rl::RL_GUIDE_UVEC4S));
  const Buffer motion = g.buffer("motion", f.pixels, 16);
  const bool demodulates =
      f.parameters.contains("demodulate") && textOf(f.parameters, "demodulate") != "none";
  g.kernels<rl::LayersBuffers>(
       rl::LayersParams{demodulates ? 1u : 0u},
       {layer[0], layer[1], layer[2], layer[3], layer[4], features.now, motion})
      .pass("layers", "layers")
      .reads({layer[1], layer[2], layer[3], layer[4]})
      .writes({features.now, motion});
  g.shared.radiance = layer[0];
  g.shared.features = features;
  g.shared.motion = motion;
}

const PartInfo& layersPart() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "layers";
    i.summary = "guides from layers of an image";
    i.record = recordLayers;
    return i;
  }();
  return info;
}

// Makes an empty scene: kernels of denoisers read no scene.
std::shared_ptr<const CompiledScene> noScene() {
  Scene scene;
  scene.name = "layers of an image";
  scene.cameras.emplace_back();
  return CompiledScene::build(std::move(scene));
}

}  // namespace

struct ImageDenoiser::Impl {
  SessionConfig config;
  Method method;
  std::unique_ptr<Backend> backend;
  std::optional<Pipeline> pipeline;
  HostFilter onHost;  // empty: the denoiser has kernels, or does nothing
  rl::FrameData frame{};
  FrameStats stats;
};

ImageDenoiser::ImageDenoiser(const SessionConfig& config) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.config = config;
  m.method = findMethod(config);
  m.config.parameters = resolveParameters(m.method, config.parameters);
  // Switch validation off: an image has no paths to trace again.
  if (const auto every = m.config.parameters.find(kValidateEvery);
      every != m.config.parameters.end())
    every->second = int64_t{0};
  for (const ParameterInfo& parameter : m.method.denoiser->parameters) {
    if (!parameter.needs.empty()) m.config.parameters[parameter.name] = 0.0;
  }
  if (config.width == 0 || config.height == 0)
    failUsage(fmt::format("image of {}x{} pixels: width and height must be at least 1",
                          config.width, config.height));
  m.backend = makeBackend(config.backend, noScene(),
                          {config.threads, config.device, config.rayTracing, config.validate});
  m.pipeline.emplace(*m.backend, std::vector<const PartInfo*>{&layersPart(), m.method.denoiser}, "",
                     m.config.parameters, 0u, size_t(config.width) * config.height, noScene());
  const auto& onHost = m.method.denoiser->onHost;
  m.backend->requireMemory(
      m.method.denoiser->name, config.width, config.height, m.pipeline->bytesPerPixel(),
      sizeof(glm::vec3) * (kLayers.size() + 1) + (onHost ? kHostFilterBytesPerPixel : 0));
  m.pipeline->allocate();
  StartupReport startup;
  m.pipeline->prepare(startup);
  if (onHost) m.onHost = onHost(config.threads, m.config.parameters);
  m.frame.width = config.width;
  m.frame.height = config.height;
  m.frame.seed = config.seed;
}

ImageDenoiser::~ImageDenoiser() = default;

Image ImageDenoiser::frame(const LayeredFrame& layers, float radianceFrames) {
  Impl& m = *impl_;
  const size_t pixels = size_t(m.config.width) * m.config.height;
  const auto checked = [&](const char* name, const Image& image) {
    if (image.pixels.empty() || (image.width == m.config.width && image.height == m.config.height))
      return;
    failUsage(fmt::format("layer {}: {}x{} pixels, but the image has {}x{}", name, image.width,
                          image.height, m.config.width, m.config.height));
  };
  checked("radiance", layers.radiance);
  checked("normalW", layers.normalW);
  checked("albedo", layers.albedo);
  checked("depth", layers.depthMetres);
  checked("lights", layers.lights);
  checked("motion", layers.motion);
  if (layers.radiance.pixels.empty()) failUsage("layer radiance: it is missing");
  // In the order of kLayers; defaults describe a plane that faces the viewer.
  const auto orAll = [&](const Image& image, const glm::vec3& value) {
    return image.pixels.empty() ? std::vector<glm::vec3>(pixels, value) : image.pixels;
  };
  std::vector<glm::vec3> depth = orAll(layers.depthMetres, glm::vec3(1.0f, 0.0f, 0.0f));
  for (size_t p = 0; p < pixels; ++p) {
    const glm::vec3 light =
        layers.lights.pixels.empty() ? glm::vec3(0.0f) : layers.lights.pixels[p];
    depth[p].y = std::max(light.x, std::max(light.y, light.z));
  }
  const std::array<std::vector<glm::vec3>, kLayers.size()> words = {
      layers.radiance.pixels, orAll(layers.normalW, glm::vec3(0.0f, 0.0f, 1.0f)),
      orAll(layers.albedo, glm::vec3(1.0f)), std::move(depth),
      orAll(layers.motion, glm::vec3(0.0f))};
  for (size_t layer = 0; layer < kLayers.size(); ++layer) {
    m.backend->write(m.pipeline->buffer(kLayers[layer]), words[layer].data(),
                     pixels * sizeof(glm::vec3));
  }
  m.frame.radianceFrames = radianceFrames;
  m.backend->submit(m.pipeline->beginFrame(true), m.frame);
  m.stats = statsOf(m.pipeline->collect(m.backend->collect()));
  ++m.frame.frame;
  if (m.onHost) {
    return filterOnHost(m.onHost, m.method.denoiser->name, *m.pipeline, m.config.width,
                        m.config.height, m.stats);
  }
  Image shown(m.config.width, m.config.height);
  m.backend->read(m.pipeline->shown(), shown.pixels.data(), pixels * sizeof(glm::vec3));
  return shown;
}

const ParameterMap& ImageDenoiser::parameters() const { return impl_->config.parameters; }

const FrameStats& ImageDenoiser::stats() const { return impl_->stats; }

void ImageDenoiser::reset() {
  impl_->pipeline->clear();
  impl_->frame.frame = 0;
}

}  // namespace restlab
