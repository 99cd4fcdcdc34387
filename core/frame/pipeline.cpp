#include "core/frame/pipeline.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

namespace {

// Caches buffers: each is read once, on its first use.
class Copies {
 public:
  explicit Copies(std::function<std::vector<uint32_t>(const std::string&)> read)
      : read_(std::move(read)) {}
  FrameSnapshot snapshot(const ShownFrame& shown, std::span<const std::byte> params) {
    return {[this](const std::string& name) -> std::span<const uint32_t> {
              const auto [at, isNew] = words_.try_emplace(name);
              if (isNew) at->second = read_(name);
              return at->second;
            },
            shown.parameters, &shown.frame, &shown.scene, params};
  }

 private:
  std::function<std::vector<uint32_t>(const std::string&)> read_;
  std::map<std::string, std::vector<uint32_t>> words_;
};

}  // namespace

Pipeline::Pipeline(Backend& backend, std::vector<const PartInfo*> parts, const std::string& mode,
                   const ParameterMap& parameters, rl::FeatureMask wanted, size_t pixels,
                   std::shared_ptr<const CompiledScene> scene)
    : backend_(backend),
      parts_(std::move(parts)),
      mode_(mode),
      parameters_(parameters),
      wanted_(wanted),
      pixels_(pixels),
      scene_(std::move(scene)),
      sceneBox_(sceneBoxOf(*scene_)),
      graph_(recorded(parameters, pixels)) {
  if (!graph_.shared.radiance)
    failUsage(fmt::format("{}: its frame leaves no radiance (FrameBuffers)", parts_.back()->name));
  for (const GraphPass& pass : graph_.passes()) columns_.push_back(columnOf(pass));
  for (const KernelUse& use : kernelsOf(graph_))
    if (hasFeatures(use.kernel)) used_ |= use.mask;
}

FrameInfo Pipeline::frameInfo(const ParameterMap& parameters, size_t pixels, bool isNewView,
                              uint32_t age) const {
  FrameInfo frame = {mode_, parameters, pixels, isNewView, false, scene_.get(), age, age};
  frame.sceneBox = sceneBox_;
  return frame;
}

// Records the first frame of a new view, which has every buffer and pass of the method.
FrameGraph Pipeline::recorded(const ParameterMap& parameters, size_t pixels) const {
  FrameGraph graph;
  graph.record(parts_, frameInfo(parameters, pixels, true, 0));
  FrameGraph still = graph;
  still.record(parts_, frameInfo(parameters, pixels, false, 1));
  graph.shareMemory(still);
  return graph;
}

// Allocates every buffer that the kernels in use can touch, so that a kernel compiled for more
// features than the scene has meets no null.
bool Pipeline::isUsed(const GraphBuffer& buffer) const {
  return buffer.features == 0 || (buffer.features & used_) != 0;
}

size_t Pipeline::ownBytes(const FrameGraph& graph, size_t index) const {
  const GraphBuffer& buffer = graph.buffers()[index];
  const bool isOwn = isUsed(buffer) && !graph.lenderOf({static_cast<uint32_t>(index)});
  return isOwn ? buffer.bytes() : 0;
}

size_t Pipeline::copyBytes(size_t index) const {
  const GraphBuffer& buffer = graph_.buffers()[index];
  return buffer.contents || buffer.isOnce ? 0 : ownBytes(graph_, index);
}

BufferId Pipeline::idOf(Buffer buffer) const {
  if (!buffer) return kNoBuffer;
  const Buffer lender = graph_.lenderOf(buffer);
  return ids_[lender ? lender.index : buffer.index];
}

size_t Pipeline::bytesOf(Buffer buffer) const {
  if (!buffer) return 0;
  const GraphBuffer& info = graph_.buffers()[buffer.index];
  return isUsed(info) ? info.bytes() : 0;
}

bool Pipeline::setParameters(const ParameterMap& parameters, StartupReport& report) {
  const FrameGraph changed = recorded(parameters, pixels_);
  const auto isSame = [](const GraphBuffer& a, const GraphBuffer& b) {
    return a.name == b.name && a.bytes() == b.bytes() &&
           (a.contents == b.contents || (a.contents && b.contents && *a.contents == *b.contents));
  };
  if (!changed.sharesAlike(graph_) ||
      !std::equal(changed.buffers().begin(), changed.buffers().end(), graph_.buffers().begin(),
                  graph_.buffers().end(), isSame))
    return false;
  const std::vector<KernelUse> uses = kernelsOf(changed);
  for (const KernelUse& use : uses)
    if (hasFeatures(use.kernel) && (use.mask & ~used_) != 0) return false;
  if (!backend_.compile(uses, report)) return false;
  parameters_ = parameters;
  ages_ = {};
  columns_.clear();
  for (const GraphPass& pass : changed.passes()) {
    columns_.push_back(columnOf(pass));
    backend_.prepare(runOf(pass), report);
  }
  return true;
}

std::span<const std::byte> Pipeline::paramsOf(const PartInfo& part) const {
  for (const GraphPass& pass : graph_.passes())
    if (pass.part == part.name) return pass.params;
  return {};
}

std::vector<uint32_t> Pipeline::words(Buffer buffer) {
  const BufferId id = idOf(buffer);
  if (id == kNoBuffer) return {};
  const GraphBuffer& info = graph_.buffers()[buffer.index];
  MemoryGuard().take(fmt::format("a copy of buffer {}", info.name), info.bytes());
  std::vector<uint32_t> all(info.bytes() / sizeof(uint32_t));
  backend_.read(id, all.data(), info.bytes());
  return all;
}

std::vector<ProbeValue> Pipeline::probe(size_t pixel, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<ProbeValue> values;
  for (const PartInfo* part : parts_) {
    const FrameSnapshot snapshot = copies.snapshot(shown, paramsOf(*part));
    for (const LayerInfo& info : part->layers) {
      if (!isEnabled(info.enabledIf, shown.parameters)) continue;
      const float value = info.values(snapshot)(pixel);
      values.push_back({info.name, info.wordsOf != nullptr
                                       ? info.wordsOf(value)
                                       : fmt::format("{:.6g}{}{}", value,
                                                     info.unit.empty() ? "" : " ", info.unit)});
    }
    if (!part->probe) continue;
    for (ProbeValue& value : part->probe(snapshot, pixel)) values.push_back(std::move(value));
  }
  return values;
}

std::vector<Donor> Pipeline::donors(size_t pixel, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<Donor> all;
  for (const PartInfo* part : parts_) {
    if (!part->donors) continue;
    const FrameSnapshot snapshot = copies.snapshot(shown, paramsOf(*part));
    for (Donor& donor : part->donors(snapshot, pixel)) all.push_back(std::move(donor));
  }
  return all;
}

std::vector<PathVertex> Pipeline::path(size_t pixel, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  for (const PartInfo* part : parts_) {
    if (part->path) return part->path(copies.snapshot(shown, paramsOf(*part)), pixel);
  }
  return {};
}

std::vector<double> Pipeline::residuals(const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  for (const PartInfo* part : parts_) {
    if (part->residuals) return part->residuals(copies.snapshot(shown, paramsOf(*part)));
  }
  return {};
}

std::vector<float> Pipeline::layer(const LayerInfo& info, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<float> all(pixels_);
  for (const PartInfo* part : parts_) {
    const std::vector<LayerInfo>& own = part->layers;
    if (std::none_of(own.begin(), own.end(), [&](const LayerInfo& one) { return &one == &info; }))
      continue;
    const FrameSnapshot snapshot = copies.snapshot(shown, paramsOf(*part));
    const auto value = info.values(snapshot);
    for (size_t pixel = 0; pixel < pixels_; ++pixel) all[pixel] = value(pixel);
  }
  return all;
}

std::vector<std::pair<std::string, size_t>> Pipeline::bufferBytesPerPixel() const {
  std::vector<std::pair<std::string, size_t>> sizes;
  for (size_t i = 0; i < graph_.buffers().size(); ++i) {
    if (isUsed(graph_.buffers()[i])) {
      sizes.emplace_back(graph_.buffers()[i].name, (ownBytes(graph_, i) + pixels_ - 1) / pixels_);
    }
  }
  return sizes;
}

size_t Pipeline::codeBytes() {
  std::map<std::string, size_t> bytes;  // several passes may share a kernel
  for (const KernelUse& use : kernels()) bytes[use.kernel] = backend_.codeBytes(use);
  size_t sum = 0;
  for (const auto& [kernel, own] : bytes) sum += own;
  return sum;
}

size_t Pipeline::bytesPerPixelOf(size_t pixels) const {
  const FrameGraph graph = recorded(parameters_, pixels);
  size_t sum = 0;
  for (size_t i = 0; i < graph.buffers().size(); ++i) sum += ownBytes(graph, i);
  return (sum + pixels - 1) / pixels;
}

void Pipeline::allocate() {
  for (size_t i = 0; i < graph_.buffers().size(); ++i) {
    const size_t bytes = ownBytes(graph_, i);
    ids_.push_back(bytes > 0 ? backend_.allocate(bytes) : kNoBuffer);
  }
  // A backend places buffers at the first use of one of them: those that come later would lie
  // apart.
  for (size_t i = 0; i < ids_.size(); ++i) {
    const auto& contents = graph_.buffers()[i].contents;
    if (contents && ids_[i] != kNoBuffer)
      backend_.write(ids_[i], contents->data(), ownBytes(graph_, i));
  }
}

void Pipeline::setScene(std::shared_ptr<const CompiledScene> scene) {
  scene_ = std::move(scene);
  ages_.light = keptAges_.light = 0;
}

void Pipeline::prepare(StartupReport& report) {
  for (const GraphPass& pass : graph_.passes()) backend_.prepare(runOf(pass), report);
}

void Pipeline::clear() {
  for (size_t i = 0; i < ids_.size(); ++i) {
    if (ids_[i] != kNoBuffer && !graph_.buffers()[i].contents) backend_.clear(ids_[i]);
  }
  ages_ = {};
}

std::vector<std::pair<BufferId, BufferId>> Pipeline::withCopies() const {
  std::vector<std::pair<BufferId, BufferId>> pairs;
  for (size_t i = 0; i < ids_.size(); ++i) {
    if (copies_[i] != kNoBuffer) pairs.emplace_back(ids_[i], copies_[i]);
  }
  return pairs;
}

void Pipeline::keep() {
  if (!kept_) {
    std::vector<BufferId> copies;
    for (size_t i = 0; i < graph_.buffers().size(); ++i) {
      const size_t bytes = copyBytes(i);
      copies.push_back(bytes > 0 ? backend_.allocate(bytes) : kNoBuffer);
    }
    copies_ = std::move(copies);
  }
  kept_ = graph_;
  keptAges_ = ages_;
  backend_.copy(withCopies());
}

void Pipeline::restore() {
  graph_ = *kept_;
  ages_ = keptAges_;
  ran_.clear();
  std::vector<std::pair<BufferId, BufferId>> pairs = withCopies();
  for (auto& [buffer, copy] : pairs) std::swap(buffer, copy);
  backend_.copy(pairs);
}

rl::FeatureMask Pipeline::maskOf(const std::string& kernel) {
  const auto [mask, isNew] = masks_.try_emplace(kernel);
  if (isNew) mask->second = backend_.maskFor(kernel, wanted_);
  return mask->second;
}

std::vector<KernelUse> Pipeline::kernelsOf(const FrameGraph& graph) {
  std::vector<KernelUse> uses;
  for (const GraphPass& pass : graph.passes()) {
    uses.push_back({pass.kernel, maskOf(pass.kernel)});
    if (!pass.vertexKernel.empty()) uses.push_back({pass.vertexKernel, maskOf(pass.vertexKernel)});
  }
  return uses;
}

PassRun Pipeline::runOf(const GraphPass& pass) {
  PassRun run = {pass.kernel, maskOf(pass.kernel), {}, pass.params, pass.entries};
  for (size_t slot = 0; slot < pass.slots.size(); ++slot)
    run.buffers.push_back(idOf(pass.bound(slot)));
  if (!pass.vertexKernel.empty()) run.vertices = {pass.vertexKernel, maskOf(pass.vertexKernel)};
  return run;
}

std::vector<PassRun> Pipeline::beginFrame(bool isNewView) {
  FrameInfo frame = frameInfo(parameters_, pixels_, isNewView, ages_.scene);
  frame.lightAge = ages_.light;
  graph_.record(parts_, frame);
  ++ages_.scene;
  ++ages_.light;
  if (graph_.buffers().size() != ids_.size())
    failUsage(
        fmt::format("buffer {}: a frame of a new view lacks it", graph_.buffers().back().name));
  Ran ran = {columns_, {}};
  std::vector<PassRun> once;
  size_t column = 0;
  for (const GraphPass& pass : graph_.passes()) {
    once.push_back(runOf(pass));
    // A still view leaves passes out; it has no others.
    while (column < columns_.size() && columns_[column].name != pass.name) ++column;
    if (column == columns_.size())
      failUsage(fmt::format("pass {}: a frame of a new view lacks it", pass.name));
    ran.columns[column].isOnce = pass.isOnce;
    ran.runs.push_back(column++);
  }
  const std::vector<size_t> order = graph_.order();
  std::vector<PassRun> runs;
  std::vector<size_t> columns;
  for (const size_t pass : order) {
    runs.push_back(once[pass]);
    columns.push_back(ran.runs[pass]);
  }
  ran.runs = std::move(columns);
  ran_.push_back(std::move(ran));
  return runs;
}

std::vector<Pipeline::PassResult> Pipeline::collect(const FrameResult& result) {
  const Ran ran = std::move(ran_.front());
  ran_.pop_front();
  std::vector<PassResult> passes;
  for (const Column& column : ran.columns) {
    PassResult& out = passes.emplace_back();
    out.name = column.name;
    out.isOnce = column.isOnce;
  }
  for (size_t run = 0; run < ran.runs.size(); ++run) {
    const PassCounters& own = result.counters[run];
    PassResult& out = passes[ran.runs[run]];
    out.timeMs += result.timesMs[run];
    out.counters.raysPath += own.raysPath;
    out.counters.raysShadow += own.raysShadow;
    if (ran.columns[ran.runs[run]].isReplay) continue;
    for (size_t k = 0; k < rl::RL_HEALTH_COUNT; ++k) out.counters.health[k] += own.health[k];
  }
  return passes;
}

BufferId Pipeline::buffer(const std::string& name) const { return idOf(graph_.find(name)); }

BufferId Pipeline::shown() const {
  const FrameBuffers& shared = graph_.shared;
  return idOf(shared.shown ? shared.shown : shared.radiance);
}

}  // namespace restlab
