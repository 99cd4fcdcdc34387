#include "core/frame/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/backend/backend.h"
#include "core/base/error.h"
#include "core/dialect/features.h"
#include "core/frame/frame_stats.h"
#include "core/frame/host_filter.h"
#include "core/frame/method.h"
#include "core/frame/pipeline.h"
#include "core/frame/stops.h"
#include "core/gbuffer/view_parts.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

namespace {

// Buffers of the AOV kernel, in the order of its Buffers struct.
constexpr const char* kAovKernel = "aov";
const std::vector<std::string> kAovNames = {"radiance", "positionW", "normalW", "albedo", "depth",
                                            "object",   "emission",  "motion",  "ambient"};

}  // namespace

struct Session::Impl {
  std::shared_ptr<const CompiledScene> scene;
  SessionConfig config;
  Method method;
  std::unique_ptr<Backend> backend;
  std::optional<Pipeline> pipeline;
  HostFilter onHost;  // set by a denoiser that filters on the host
  rl::FrameData frame{};
  rl::FeatureMask needed = 0;
  std::shared_ptr<Image> radiance = std::make_shared<Image>();
  bool isRadianceRead = true;  // `radiance` holds the last frame
  StartupReport startup;
  rl::Camera nextCamera{};
  bool isFirstFrame = true;  // next frame begins a history
  bool hasNewParameters = false;
  size_t hostBytesPerPixel = 0;
  std::vector<BufferId> aovBuffers;
  bool isAovTraced = false;  // for the last frame
  BufferId drawnLights = kNoBuffer;
  rl::FrameData lastFrame{};
  std::shared_ptr<const CompiledScene> lastScene;  // scene of the last frame

  // State that a frame changes, other than buffers.
  struct BeforeFrame {
    rl::FrameData frame{}, lastFrame{};
    bool isFirstFrame = true, hasNewParameters = false, isRadianceRead = true;
    Image filtered;  // by the filter on the host
  };
  std::optional<BeforeFrame> beforeFrame;  // set while the last frame can be taken back

  // Creates backend, buffers and the first frame of a history, for the configuration.
  void open();
  // Creates the pipeline, with the kernels that the backend has or can compile.
  void openPipeline();
  // Makes a scene build the tables that the kernels read.
  void bindTables(const CompiledScene& of) const;
  rl::FeatureMask wantedFeatures() const;
  // Opens with another configuration. If that throws, restarts the old configuration with a new
  // history.
  void reopen(const SessionConfig& changed);
  // Derives frame data from the parameters, and the filter on the host.
  void useParameters();
  void submitFrame();
  FrameStats collectFrame();
  // Saves the state before a frame; false if memory does not suffice.
  bool keep();
  void restore();
  // Image to write to: a new one if others hold that of an earlier frame.
  Image& ownRadiance() {
    if (radiance.use_count() > 1) radiance = std::make_shared<Image>(config.width, config.height);
    return *radiance;
  }
  ShownFrame shown() const { return {config.parameters, lastFrame, *lastScene}; }
  size_t pixelAt(uint32_t x, uint32_t y) const;
};

Session::Session(std::shared_ptr<const CompiledScene> scene, const SessionConfig& config,
                 size_t hostBytesPerPixel)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.scene = std::move(scene);
  m.config = config;
  m.hostBytesPerPixel = hostBytesPerPixel;
  m.method = findMethod(config);
  m.config.mode = findMode(*m.method.integrator, config.mode);
  if (m.method.cache != nullptr) m.config.cache = m.method.cache->name;
  const std::vector<SceneCamera>& cameras = m.scene->source().cameras;
  if (config.camera >= cameras.size()) {
    failUsage(fmt::format("camera {} of scene {}: it has {} (0 to {})", config.camera,
                          m.scene->source().name, cameras.size(), cameras.size() - 1));
  }
  m.config.parameters = resolveParameters(m.method, config.parameters);
  m.open();
}

void Session::Impl::open() {
  if (config.width == 0 || config.height == 0) {
    failUsage(fmt::format("resolution {}x{}: width and height must be at least 1", config.width,
                          config.height));
  }
  needed = scene->features(config.multiscatter);
  if (config.lightChoice == kLightChoiceTree && scene->lampCount() > 1)
    needed |= rl::RL_FEATURE_LIGHT_TREE;
  bindTables(*scene);
  beforeFrame.reset();
  pipeline.reset();
  backend.reset();
  aovBuffers.clear();
  isAovTraced = false;
  drawnLights = kNoBuffer;
  backend = makeBackend(config.backend, scene,
                        {config.threads, config.device, config.rayTracing, config.validate,
                         config.kernels == KernelChoice::exact});
  openPipeline();
  if (!config.renders) return;
  if (!backend->compile(pipeline->kernels(), startup)) openPipeline();
  pipeline->allocate();
  drawnLights = backend->allocate(sizeof(uint32_t) * std::max(scene->lightRecords(), size_t{1}));
  backend->tellDrawnLights(drawnLights);
  pipeline->prepare(startup);
  ownRadiance() = Image(config.width, config.height);
  isRadianceRead = true;
  isFirstFrame = true;
  const std::vector<SceneCamera>& cameras = scene->source().cameras;
  rl::FrameData& f = frame;
  f.camera = scene->camera(cameras[config.camera], config.width, config.height);
  f.previousCamera = f.camera;
  nextCamera = f.camera;
  f.width = config.width;
  f.height = config.height;
  f.frame = 0;
  f.seed = config.seed;
  f.pixelFilter = config.pixelFilter;
  // Direct light alone: do not trace paths with two or more scattering events.
  const bool directOnly = (config.components & rl::RL_COMPONENT_INDIRECT) == 0;
  f.maxBounces = directOnly ? std::min(config.maxBounces, 1u) : config.maxBounces;
  f.components = config.components;
  f.rouletteStart = config.russianRoulette ? rl::RL_ROULETTE_EARLIEST : rl::RL_INVALID;
  f.multiscatter = (needed & rl::RL_FEATURE_MULTISCATTER) != 0 ? 1u : 0u;
  f.lightTree = (needed & rl::RL_FEATURE_LIGHT_TREE) != 0 ? 1u : 0u;
  useParameters();
  f.sharesFilm = pipeline->graph().shared.filmHits ? 1u : 0u;
  lastFrame = f;
  lastScene = scene;
}

void Session::Impl::bindTables(const CompiledScene& of) const {
  if (!config.renders) return;
  if ((needed & rl::RL_FEATURE_MULTISCATTER) != 0) of.bindGgxAlbedo();
  if ((needed & rl::RL_FEATURE_LIGHT_TREE) != 0) of.bindLightTree();
}

rl::FeatureMask Session::Impl::wantedFeatures() const {
  return config.kernels == KernelChoice::general ? generalFeatures(needed) : needed;
}

void Session::Impl::openPipeline() {
  pipeline.emplace(*backend, withViewParts(method.parts()), config.mode, config.parameters,
                   wantedFeatures(), size_t(config.width) * config.height, scene);
  const size_t filterBytes = method.denoiser->onHost ? kHostFilterBytesPerPixel : 0;
  backend->requireMemory(method.integrator->name, config.width, config.height,
                         pipeline->bytesPerPixel(),
                         sizeof(glm::vec3) + hostBytesPerPixel + filterBytes);
}

void Session::Impl::useParameters() {
  const auto& radianceFrames = method.integrator->radianceFrames;
  frame.radianceFrames = radianceFrames ? float(radianceFrames(config.parameters)) : 1.0f;
  if (method.denoiser->onHost) onHost = method.denoiser->onHost(config.threads, config.parameters);
}

void Session::Impl::reopen(const SessionConfig& changed) {
  const SessionConfig before = config;
  const rl::Camera camera = nextCamera;
  config = changed;
  try {
    open();
  } catch (const Error&) {
    config = before;
    open();
    nextCamera = camera;
    throw;
  }
}

Session::~Session() = default;

void Session::Impl::submitFrame() {
  frame.previousCamera = isFirstFrame ? nextCamera : frame.camera;
  frame.camera = nextCamera;
  const bool isStill = !isFirstFrame && !hasNewParameters &&
                       std::memcmp(&frame.camera, &frame.previousCamera, sizeof(rl::Camera)) == 0;
  frame.stillFrames = isStill ? frame.stillFrames + 1 : 0;
  if (!isStill) frame.cameraMedia = scene->bodiesAt(frame.camera.posW);
  const bool absorbsBefore = (frame.cameraAbsorbs & rl::RL_CAMERA_ABSORBS_NOW) != 0;
  const bool absorbs = scene->absorbs(frame.cameraMedia.x);
  frame.cameraAbsorbs =
      (absorbs ? rl::RL_CAMERA_ABSORBS_NOW : 0u) |
      ((isFirstFrame ? absorbs : absorbsBefore) ? rl::RL_CAMERA_ABSORBS_BEFORE : 0u);
  isFirstFrame = false;
  hasNewParameters = false;
  backend->submit(pipeline->beginFrame(!isStill), frame);
  lastFrame = frame;
  lastScene = scene;
  isRadianceRead = false;
  isAovTraced = false;
  ++frame.frame;
}

FrameStats Session::Impl::collectFrame() {
  FrameStats stats = statsOf(pipeline->collect(backend->collect()));
  if (onHost) {
    ownRadiance() =
        filterOnHost(onHost, method.denoiser->name, *pipeline, config.width, config.height, stats);
    isRadianceRead = true;
  }
  return stats;
}

FrameStats Session::frame() {
  impl_->beforeFrame.reset();
  impl_->submitFrame();
  return impl_->collectFrame();
}

bool Session::Impl::keep() {
  beforeFrame.reset();
  try {
    if (!pipeline->hasCopies()) {
      backend->requireMemory(method.integrator->name, config.width, config.height,
                             pipeline->bytesPerPixel(), onHost ? sizeof(glm::vec3) : 0);
    }
    pipeline->keep();
  } catch (const Error& error) {
    if (error.code() != ExitCode::deviceUnavailable) throw;
    return false;
  }
  beforeFrame = {frame, lastFrame, isFirstFrame, hasNewParameters, isRadianceRead, {}};
  if (onHost) beforeFrame->filtered = *radiance;
  return true;
}

void Session::Impl::restore() {
  pipeline->restore();
  frame = beforeFrame->frame;
  lastFrame = beforeFrame->lastFrame;
  isFirstFrame = beforeFrame->isFirstFrame;
  hasNewParameters = beforeFrame->hasNewParameters;
  isAovTraced = false;
  if (onHost) ownRadiance() = std::move(beforeFrame->filtered);
  // An image read since is that of the discarded frame: it must be read again.
  isRadianceRead = beforeFrame->isRadianceRead && (onHost || !isRadianceRead);
  beforeFrame.reset();
}

std::optional<FrameStats> Session::frameUnless(const std::function<bool()>& isStopped) {
  Impl& m = *impl_;
  if (!m.keep()) return frame();
  try {
    const Stops stops(*m.backend, isStopped);
    m.submitFrame();
    return m.collectFrame();
  } catch (const FrameStopped&) {
    if (framesStopped()) throw;
  }
  m.restore();
  return std::nullopt;
}

double Session::frameFraction() const { return impl_->backend->frameFraction(); }

void Session::takeBack() { impl_->restore(); }
bool Session::canTakeBack() const { return impl_->beforeFrame.has_value(); }

std::vector<FrameStats> Session::frames(uint32_t count) {
  impl_->beforeFrame.reset();
  std::vector<FrameStats> all;
  // A filter on the host must read the buffers before the next frame writes to them.
  const uint32_t inFlight = impl_->onHost ? 1 : impl_->backend->framesInFlight();
  for (uint32_t i = 0; i < count; ++i) {
    if (i >= inFlight) all.push_back(impl_->collectFrame());
    impl_->submitFrame();
  }
  while (all.size() < count) all.push_back(impl_->collectFrame());
  return all;
}

void Session::reset(uint32_t seed, uint32_t firstFrame) {
  Impl& m = *impl_;
  if (firstFrame > 0 && m.method.hasHistory(m.config.parameters)) {
    failUsage(fmt::format("integrator {} with denoiser {}: a history starts at frame 0, not at {}",
                          m.method.integrator->name, m.method.denoiser->name, firstFrame));
  }
  m.beforeFrame.reset();
  m.config.seed = seed;
  m.frame.seed = seed;
  m.frame.frame = firstFrame;
  m.isFirstFrame = true;
  m.pipeline->clear();
}

bool Session::setParameters(const ParameterMap& parameters) {
  Impl& m = *impl_;
  SessionConfig changed = m.config;
  for (const auto& [name, value] : parameters) changed.parameters[name] = value;
  changed.parameters = resolveParameters(m.method, changed.parameters);
  if (changed.parameters == m.config.parameters) return false;
  const std::vector<ParameterInfo> infos = m.method.parameters();
  const bool beginsHistory = std::any_of(infos.begin(), infos.end(), [&](const ParameterInfo& p) {
    return p.beginsHistory && changed.parameters.at(p.name) != m.config.parameters.at(p.name);
  });
  if (!beginsHistory && m.pipeline->setParameters(changed.parameters, m.startup)) {
    m.beforeFrame.reset();
    m.config = changed;
    m.useParameters();
    m.hasNewParameters = true;
    return false;
  }
  const rl::Camera camera = m.nextCamera;
  m.reopen(changed);
  m.nextCamera = camera;
  return true;
}

void Session::resize(uint32_t width, uint32_t height) {
  SessionConfig changed = impl_->config;
  changed.width = width;
  changed.height = height;
  impl_->reopen(changed);
}

void Session::setScene(std::shared_ptr<const CompiledScene> scene) {
  Impl& m = *impl_;
  if (scene == m.scene) return;
  if (!scene->differsInLightAlone(*m.scene)) {
    failUsage(
        fmt::format("scene {}: it differs from {} in more than its light: a new session could "
                    "show it",
                    scene->source().name, m.scene->source().name));
  }
  m.bindTables(*scene);
  m.backend->setScene(scene);
  m.pipeline->setScene(scene);
  m.scene = std::move(scene);
}

size_t Session::Impl::pixelAt(uint32_t x, uint32_t y) const {
  if (x >= config.width || y >= config.height)
    failUsage(fmt::format("probe {},{}: the image is {}x{}", x, y, config.width, config.height));
  return size_t(y) * config.width + x;
}

std::vector<ProbeValue> Session::probe(uint32_t x, uint32_t y) const {
  Impl& m = *impl_;
  const size_t pixel = m.pixelAt(x, y);
  return m.isFirstFrame ? std::vector<ProbeValue>{} : m.pipeline->probe(pixel, m.shown());
}

std::vector<Donor> Session::donors(uint32_t x, uint32_t y) const {
  Impl& m = *impl_;
  const size_t pixel = m.pixelAt(x, y);
  return m.isFirstFrame ? std::vector<Donor>{} : m.pipeline->donors(pixel, m.shown());
}

std::vector<PathVertex> Session::path(uint32_t x, uint32_t y) const {
  Impl& m = *impl_;
  const size_t pixel = m.pixelAt(x, y);
  if (m.isFirstFrame) return {};
  std::vector<PathVertex> path = m.pipeline->path(pixel, m.shown());
  for (PathVertex& vertex : path)
    if (!vertex.isDirection) vertex.posW += glm::vec3(m.scene->origin());
  return path;
}

std::vector<double> Session::residuals() const {
  Impl& m = *impl_;
  return m.isFirstFrame ? std::vector<double>{} : m.pipeline->residuals(m.shown());
}

void Session::setCamera(const SceneCamera& camera) {
  impl_->nextCamera = impl_->scene->camera(camera, impl_->config.width, impl_->config.height);
}

const Image& Session::radiance() const { return *sharedRadiance(); }

std::shared_ptr<const Image> Session::sharedRadiance() const {
  Impl& m = *impl_;
  if (!m.isRadianceRead) {
    Image& image = m.ownRadiance();
    m.backend->read(m.pipeline->shown(), image.pixels.data(),
                    image.pixels.size() * sizeof(glm::vec3));
    m.isRadianceRead = true;
  }
  return m.radiance;
}

const std::vector<std::string>& Session::aovNames() { return kAovNames; }

Image Session::aov(const std::string& name) const {
  Impl& m = *impl_;
  const auto found = std::find(kAovNames.begin(), kAovNames.end(), name);
  const std::vector<const LayerInfo*> layers = m.method.layers();
  const auto kept = std::find_if(layers.begin(), layers.end(),
                                 [&](const LayerInfo* info) { return info->name == name; });
  if (found == kAovNames.end() && kept == layers.end()) {
    const std::vector<std::string> known = m.method.aovNames();
    failUsage(fmt::format("unknown AOV '{}'{}; AOVs: {}", name, didYouMean(name, known),
                          fmt::join(known, ", ")));
  }
  if (name == "radiance") return radiance();
  if (m.isFirstFrame) failUsage(fmt::format("AOV {}: no frame was rendered yet", name));
  if (kept != layers.end()) {
    Image image(m.config.width, m.config.height);
    const std::vector<float> values = m.pipeline->layer(**kept, m.shown());
    for (size_t i = 0; i < values.size(); ++i) image.pixels[i] = glm::vec3(values[i]);
    return image;
  }
  const size_t pixels = size_t(m.config.width) * m.config.height;
  if (m.aovBuffers.empty()) {
    for (size_t i = 1; i < kAovNames.size(); ++i)
      m.aovBuffers.push_back(m.backend->allocate(pixels * 12));
  }
  if (!m.isAovTraced) {
    const rl::FeatureMask wanted = m.wantedFeatures();
    m.backend->compile({{kAovKernel, m.backend->maskFor(kAovKernel, wanted)}}, m.startup);
    const PassRun pass{kAovKernel, m.backend->maskFor(kAovKernel, wanted), m.aovBuffers,
                       std::vector<std::byte>(4), 0};
    m.backend->prepare(pass, m.startup);
    m.backend->submit({pass}, m.lastFrame);
    m.backend->collect();
    m.isAovTraced = true;
  }
  const auto read = [&](const std::string& layer) {
    const auto at = std::find(kAovNames.begin(), kAovNames.end(), layer) - kAovNames.begin() - 1;
    Image image(m.config.width, m.config.height);
    m.backend->read(m.aovBuffers[size_t(at)], image.pixels.data(), pixels * 12);
    return image;
  };
  Image image = read(name);
  if (name == "positionW") {
    // Kernels count from the scene's origin; pixels that show nothing stay zero.
    const Image depth = read("depth");
    const glm::vec3 origin(m.scene->origin());
    for (size_t i = 0; i < pixels; ++i) {
      if (depth.pixels[i].x > 0.0f) image.pixels[i] += origin;
    }
  }
  return image;
}

DrawnLights Session::drawnLights() const {
  if (impl_->drawnLights == kNoBuffer) return {};
  std::vector<uint32_t> words(impl_->scene->lightRecords());
  if (!words.empty())
    impl_->backend->read(impl_->drawnLights, words.data(), sizeof words[0] * words.size());
  return restlab::drawnLights(*impl_->scene, words);
}

std::string Session::lightLeftOut() const {
  const IntegratorInfo& info = *impl_->method.integrator;
  if (!info.leavesOutOf) return info.leavesOut;
  return info.leavesOutOf(*impl_->scene, impl_->config.parameters);
}

rl::FeatureMask Session::featuresNeeded() const { return impl_->needed; }
rl::FeatureMask Session::featuresUsed() const { return impl_->pipeline->featuresUsed(); }
size_t Session::codeBytes() const { return impl_->pipeline->codeBytes(); }
double Session::averagedFrames() const {
  const auto& shownFrames = impl_->method.denoiser->shownFrames;
  const double radianceFrames = impl_->frame.radianceFrames;
  return shownFrames ? shownFrames(impl_->config.parameters, radianceFrames) : radianceFrames;
}

const SessionConfig& Session::config() const { return impl_->config; }
const StartupReport& Session::startup() const { return impl_->startup; }
std::string Session::rayTracing() const { return impl_->backend->rayTracing(); }
std::string Session::device() const { return impl_->backend->device(); }

std::vector<std::pair<std::string, size_t>> Session::bufferBytesPerPixel() const {
  return impl_->pipeline->bufferBytesPerPixel();
}

const FrameGraph& Session::graph() const { return impl_->pipeline->graph(); }

size_t Session::bytesPerPixel() const { return impl_->pipeline->bytesPerPixel(); }
size_t Session::bytesPerPixelOf(uint32_t width, uint32_t height) const {
  return impl_->pipeline->bytesPerPixelOf(size_t(width) * height);
}

}  // namespace restlab
