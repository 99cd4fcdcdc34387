#include "core/frame/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

namespace {

// Caches buffers: each is read once, on its first use.
class Copies {
 public:
  explicit Copies(std::function<std::vector<uint32_t>(const std::string&)> read)
      : read_(std::move(read)) {}
  Kept kept(const ShownFrame& shown, std::span<const std::byte> params) {
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
                   const ParameterMap& parameters, uint32_t wanted, size_t pixels)
    : backend_(backend), pixels_(pixels), parameters_(parameters) {
  for (const PartInfo* part : parts) {
    Stage stage;
    stage.info = part;
    pack(stage, mode, parameters);
    for (const PassInfo& pass : part->passes) {
      stage.isEnabled.push_back(isEnabled(part->enabledIf, parameters) &&
                                isEnabled(pass.enabledIf, parameters));
      stage.masks.push_back(backend.maskFor(pass.kernel, wanted));
      if (stage.isEnabled.back() && pass.hasFeatures) used_ |= stage.masks.back();
    }
    stages_.push_back(std::move(stage));
  }
  for (size_t s = 0; s < stages_.size(); ++s) {
    for (const std::string& input : stages_[s].info->inputs) {
      if (find(input, s)) continue;
      failUsage(
          fmt::format("{}: no part before it has a buffer '{}'", stages_[s].info->name, input));
    }
    for (const BufferInfo& buffer : stages_[s].info->buffers)
      stages_[s].bytes.push_back(bytesOf(*stages_[s].info, buffer, parameters));
  }
}

// Allocates all buffers that the kernels in use can touch, so that a superset kernel never meets a
// null.
size_t Pipeline::bytesOf(const PartInfo& part, const BufferInfo& buffer,
                         const ParameterMap& parameters) const {
  const bool isWanted = buffer.neededFeatures == 0 || (buffer.neededFeatures & used_) != 0;
  return isWanted && isEnabled(part.enabledIf, parameters)
             ? bufferBytes(buffer, parameters, pixels_)
             : 0;
}

void Pipeline::pack(Stage& stage, const std::string& mode, const ParameterMap& parameters) const {
  if (stage.info->packParameters) stage.params = stage.info->packParameters(mode, parameters);
  stage.entries.clear();
  for (const PassInfo& pass : stage.info->passes) {
    const auto number = [&](const char* name) {
      const auto found = parameters.find(name == nullptr ? "" : name);
      return found == parameters.end() ? 0 : static_cast<size_t>(std::get<int64_t>(found->second));
    };
    size_t entries = number(pass.entriesParameter);
    if (const size_t group = number(pass.onePerParameter); group != 0)
      entries = ((entries != 0 ? entries : pixels_) + group - 1) / group;
    stage.entries.push_back(static_cast<uint32_t>(entries));
  }
}

bool Pipeline::setParameters(const std::string& mode, const ParameterMap& parameters) {
  for (const Stage& stage : stages_) {
    for (size_t b = 0; b < stage.bytes.size(); ++b) {
      if (bytesOf(*stage.info, stage.info->buffers[b], parameters) != stage.bytes[b]) return false;
    }
  }
  parameters_ = parameters;
  for (Stage& stage : stages_) pack(stage, mode, parameters);
  return true;
}

std::vector<uint32_t> Pipeline::words(const std::string& buffer) {
  const auto at = find(buffer, stages_.size());
  const size_t bytes = at ? stages_[at->first].bytes[at->second] : 0;
  MemoryGuard().take(fmt::format("a copy of buffer {}", buffer), bytes);
  std::vector<uint32_t> all(bytes / sizeof(uint32_t));
  if (bytes > 0) backend_.read(bound(stages_[at->first], at->second), all.data(), bytes);
  return all;
}

std::vector<ProbeValue> Pipeline::probe(size_t pixel, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<ProbeValue> values;
  for (const Stage& stage : stages_) {
    const Kept kept = copies.kept(shown, stage.shownParams);
    for (const LayerInfo& info : stage.info->layers) {
      if (!isEnabled(info.enabledIf, shown.parameters)) continue;
      const float value = info.values(kept)(pixel);
      values.push_back(
          {info.name, fmt::format("{:.6g}{}{}", value, info.unit.empty() ? "" : " ", info.unit)});
    }
    if (!stage.info->probe) continue;
    for (ProbeValue& value : stage.info->probe(kept, pixel)) values.push_back(std::move(value));
  }
  return values;
}

std::vector<Donor> Pipeline::donors(size_t pixel, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<Donor> all;
  for (const Stage& stage : stages_) {
    if (!stage.info->donors) continue;
    const Kept kept = copies.kept(shown, stage.shownParams);
    for (Donor& donor : stage.info->donors(kept, pixel)) all.push_back(std::move(donor));
  }
  return all;
}

std::vector<float> Pipeline::layer(const LayerInfo& info, const ShownFrame& shown) {
  Copies copies([this](const std::string& name) { return words(name); });
  std::vector<float> all(pixels_);
  for (const Stage& stage : stages_) {
    const std::vector<LayerInfo>& own = stage.info->layers;
    if (std::none_of(own.begin(), own.end(), [&](const LayerInfo& one) { return &one == &info; }))
      continue;
    const auto value = info.values(copies.kept(shown, stage.shownParams));
    for (size_t pixel = 0; pixel < pixels_; ++pixel) all[pixel] = value(pixel);
  }
  return all;
}

std::optional<std::pair<size_t, size_t>> Pipeline::find(const std::string& name,
                                                        size_t before) const {
  for (size_t s = 0; s < before; ++s) {
    const std::vector<BufferInfo>& buffers = stages_[s].info->buffers;
    for (size_t b = 0; b < buffers.size(); ++b) {
      if (buffers[b].name == name) return {{s, b}};
    }
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, size_t>> Pipeline::bufferBytesPerPixel() const {
  std::vector<std::pair<std::string, size_t>> sizes;
  for (const Stage& stage : stages_) {
    for (size_t b = 0; b < stage.bytes.size(); ++b)
      sizes.emplace_back(stage.info->buffers[b].name, (stage.bytes[b] + pixels_ - 1) / pixels_);
  }
  return sizes;
}

size_t Pipeline::bytesPerPixel() const { return bytesPerPixelOf(pixels_); }

size_t Pipeline::bytesPerPixelOf(size_t pixels) const {
  size_t sum = 0;
  for (const Stage& stage : stages_) {
    for (size_t b = 0; b < stage.bytes.size(); ++b) {
      if (stage.bytes[b] > 0) sum += bufferBytes(stage.info->buffers[b], parameters_, pixels);
    }
  }
  return (sum + pixels - 1) / pixels;
}

void Pipeline::allocate() {
  for (Stage& stage : stages_) {
    for (const size_t bytes : stage.bytes)
      stage.buffers.push_back(bytes > 0 ? backend_.allocate(bytes) : kNoBuffer);
  }
}

void Pipeline::prepare(StartupReport& report) {
  for (size_t s = 0; s < stages_.size(); ++s) {
    const Stage& stage = stages_[s];
    for (size_t p = 0; p < stage.masks.size(); ++p) {
      if (stage.isEnabled[p]) backend_.prepare(runOf(s, p), report);
    }
  }
}

void Pipeline::clear() {
  for (const Stage& stage : stages_) {
    for (const BufferId buffer : stage.buffers) {
      if (buffer != kNoBuffer) backend_.clear(buffer);
    }
  }
}

std::vector<std::pair<BufferId, BufferId>> Pipeline::keptBuffers() const {
  std::vector<std::pair<BufferId, BufferId>> pairs;
  for (const Stage& stage : kept_) {
    for (const BufferId buffer : stage.buffers) {
      if (buffer != kNoBuffer) pairs.emplace_back(buffer, copies_[pairs.size()]);
    }
  }
  return pairs;
}

void Pipeline::keep() {
  if (kept_.empty()) {
    std::vector<BufferId> copies;
    for (const Stage& stage : stages_) {
      for (const size_t bytes : stage.bytes)
        if (bytes > 0) copies.push_back(backend_.allocate(bytes));
    }
    copies_ = std::move(copies);
  }
  kept_ = stages_;
  backend_.copy(keptBuffers());
}

void Pipeline::restore() {
  stages_ = kept_;
  ran_.clear();
  std::vector<std::pair<BufferId, BufferId>> pairs = keptBuffers();
  for (auto& [buffer, copy] : pairs) std::swap(buffer, copy);
  backend_.copy(pairs);
}

// If the stage did not run, both buffers of a swapping pair are that of the last run.
BufferId Pipeline::bound(const Stage& stage, size_t buffer) const {
  const int other = stage.info->buffers[buffer].swapWith;
  if (!stage.runs && other >= 0) return stage.buffers[std::min(buffer, static_cast<size_t>(other))];
  return stage.buffers[buffer];
}

std::vector<BufferId> Pipeline::bindings(size_t stage) const {
  std::vector<BufferId> ids;
  const PartInfo& info = *stages_[stage].info;
  for (const std::vector<std::string>* names : {&info.inputs, &info.optionalInputs}) {
    for (const std::string& input : *names) {
      const auto at = find(input, stage);
      ids.push_back(at ? bound(stages_[at->first], at->second) : kNoBuffer);
    }
  }
  for (size_t b = 0; b < stages_[stage].buffers.size(); ++b)
    ids.push_back(bound(stages_[stage], b));
  return ids;
}

PassRun Pipeline::runOf(size_t stage, size_t pass) const {
  const Stage& own = stages_[stage];
  const PassInfo& info = own.info->passes[pass];
  PassRun run = {info.kernel, own.masks[pass], bindings(stage), own.params, own.entries[pass]};
  if (info.step >= 0) {
    const auto step = static_cast<uint32_t>(info.step);
    std::memcpy(run.params.data(), &step, sizeof step);
  }
  return run;
}

std::vector<PassRun> Pipeline::beginFrame(bool isNewView) {
  std::vector<bool> ran;
  for (Stage& stage : stages_) {
    stage.runs = isNewView || !stage.info->onlyOnNewViews;
    stage.shownParams = stage.params;
    for (size_t p = 0; p < stage.masks.size(); ++p) {
      const bool isDue = isNewView || !stage.info->passes[p].onlyOnNewViews;
      ran.push_back(stage.runs && isDue && stage.isEnabled[p]);
    }
    // The output of the last run becomes the history.
    for (size_t b = 0; stage.runs && b < stage.buffers.size(); ++b) {
      const int other = stage.info->buffers[b].swapWith;
      if (other > static_cast<int>(b)) std::swap(stage.buffers[b], stage.buffers[size_t(other)]);
    }
  }
  std::vector<PassRun> runs;
  size_t next = 0;
  for (size_t s = 0; s < stages_.size(); ++s) {
    const Stage& stage = stages_[s];
    for (size_t p = 0; p < stage.masks.size(); ++p) {
      if (ran[next++]) runs.push_back(runOf(s, p));
    }
  }
  ran_.push_back(std::move(ran));
  return runs;
}

std::vector<Pipeline::PassResult> Pipeline::collect(const FrameResult& result) {
  std::vector<PassResult> passes;
  const std::vector<bool> ran = std::move(ran_.front());
  ran_.pop_front();
  size_t pass = 0, next = 0;
  for (const Stage& stage : stages_) {
    for (size_t p = 0; p < stage.masks.size(); ++p) {
      const bool hasRun = ran[pass++];
      if (!stage.isEnabled[p]) continue;
      PassResult& out = passes.emplace_back();
      out.name = stage.info->passes[p].name;
      if (!hasRun) continue;
      out.timeMs = result.timesMs[next];
      out.counters = result.counters[next];
      if (stage.info->passes[p].isReplay)
        std::fill(std::begin(out.counters.health), std::end(out.counters.health), 0u);
      ++next;
    }
  }
  return passes;
}

BufferId Pipeline::buffer(const std::string& name) const {
  const auto at = find(name, stages_.size());
  return at ? bound(stages_[at->first], at->second) : kNoBuffer;
}

BufferId Pipeline::shown() const {
  // A denoiser without passes shows the output of the part before it.
  for (size_t s = stages_.size(); s-- > 0;) {
    if (!stages_[s].buffers.empty()) return stages_[s].buffers.front();
  }
  return kNoBuffer;
}

}  // namespace restlab
