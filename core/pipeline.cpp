#include "core/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"

namespace restlab {

Pipeline::Pipeline(Backend& backend, std::vector<const PartInfo*> parts, const PartInfo* cache,
                   const std::string& mode, const ParameterMap& parameters, uint32_t wanted,
                   size_t pixels)
    : backend_(backend), pixels_(pixels) {
  for (const PartInfo* part : parts) {
    if (part == cache) cache_ = stages_.size();
    Stage stage;
    stage.info = part;
    pack(stage, mode, parameters);
    for (const PassInfo& pass : part->passes) {
      stage.kernels.push_back(pass.kernel);
      if (pass.seesCache) stage.kernels.back() += "_" + cache->name;
      stage.masks.push_back(backend.maskFor(stage.kernels.back(), wanted));
      if (pass.hasFeatures) used_ |= stage.masks.back();
    }
    stages_.push_back(std::move(stage));
  }
  for (size_t s = 0; s < stages_.size(); ++s) {
    for (const std::string& input : stages_[s].info->inputs) find(input, s);
    for (const BufferInfo& buffer : stages_[s].info->buffers)
      stages_[s].bytes.push_back(bytesOf(buffer, parameters));
  }
}

// What the kernels in use can touch is there, so that a superset kernel never meets a null.
size_t Pipeline::bytesOf(const BufferInfo& buffer, const ParameterMap& parameters) const {
  const bool isWanted = buffer.neededFeatures == 0 || (buffer.neededFeatures & used_) != 0;
  return isWanted ? bufferBytes(buffer, parameters, pixels_) : 0;
}

void Pipeline::pack(Stage& stage, const std::string& mode, const ParameterMap& parameters) const {
  if (stage.info->packParameters) stage.params = stage.info->packParameters(mode, parameters);
  stage.entries.clear();
  for (const PassInfo& pass : stage.info->passes) {
    const char* name = pass.entriesParameter;
    stage.entries.push_back(
        name == nullptr ? 0 : static_cast<uint32_t>(std::get<int64_t>(parameters.at(name))));
  }
}

bool Pipeline::setParameters(const std::string& mode, const ParameterMap& parameters) {
  for (const Stage& stage : stages_) {
    for (size_t b = 0; b < stage.bytes.size(); ++b) {
      if (bytesOf(stage.info->buffers[b], parameters) != stage.bytes[b]) return false;
    }
  }
  for (Stage& stage : stages_) pack(stage, mode, parameters);
  return true;
}

std::vector<ProbeValue> Pipeline::probe(size_t pixel) {
  std::vector<ProbeValue> values;
  for (const Stage& stage : stages_) {
    if (!stage.info->probe) continue;
    const ReadEntry read = [&](const std::string& name) {
      std::vector<uint32_t> words;
      for (size_t b = 0; b < stage.bytes.size(); ++b) {
        const BufferInfo& buffer = stage.info->buffers[b];
        if (buffer.name != name || stage.bytes[b] == 0 || buffer.entriesParameter != nullptr)
          continue;
        const size_t perPixel = stage.bytes[b] / pixels_;
        std::vector<std::byte> all((pixel + 1) * perPixel);
        backend_.read(bound(stage, b), all.data(), all.size());
        words.resize(perPixel / sizeof(uint32_t));
        std::memcpy(words.data(), all.data() + pixel * perPixel, words.size() * sizeof(uint32_t));
      }
      return words;
    };
    for (ProbeValue& value : stage.info->probe(read)) values.push_back(std::move(value));
  }
  return values;
}

std::pair<size_t, size_t> Pipeline::find(const std::string& name, size_t before) const {
  for (size_t s = 0; s < before; ++s) {
    const std::vector<BufferInfo>& buffers = stages_[s].info->buffers;
    for (size_t b = 0; b < buffers.size(); ++b) {
      if (buffers[b].name == name) return {s, b};
    }
  }
  failUsage(
      fmt::format("{}: no part before it has a buffer '{}'", stages_[before].info->name, name));
}

std::vector<std::pair<std::string, size_t>> Pipeline::bufferBytesPerPixel() const {
  std::vector<std::pair<std::string, size_t>> sizes;
  for (const Stage& stage : stages_) {
    for (size_t b = 0; b < stage.bytes.size(); ++b)
      sizes.emplace_back(stage.info->buffers[b].name, (stage.bytes[b] + pixels_ - 1) / pixels_);
  }
  return sizes;
}

size_t Pipeline::bytesPerPixel() const {
  size_t sum = 0;
  for (const auto& [name, bytes] : bufferBytesPerPixel()) sum += bytes;
  return sum;
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
    for (size_t p = 0; p < stage.masks.size(); ++p) backend_.prepare(runOf(s, p), report);
  }
}

void Pipeline::clear() {
  for (const Stage& stage : stages_) {
    for (const BufferId buffer : stage.buffers) {
      if (buffer != kNoBuffer) backend_.clear(buffer);
    }
  }
}

// Where the stage did not run, a buffer and the one that it swaps with are both the last run's.
BufferId Pipeline::bound(const Stage& stage, size_t buffer) const {
  const int other = stage.info->buffers[buffer].swapWith;
  if (!stage.runs && other >= 0) return stage.buffers[std::min(buffer, static_cast<size_t>(other))];
  return stage.buffers[buffer];
}

std::vector<BufferId> Pipeline::bindings(size_t stage) const {
  std::vector<BufferId> ids;
  for (const std::string& input : stages_[stage].info->inputs) {
    const auto [s, b] = find(input, stage);
    ids.push_back(bound(stages_[s], b));
  }
  for (size_t b = 0; b < stages_[stage].buffers.size(); ++b)
    ids.push_back(bound(stages_[stage], b));
  return ids;
}

// What is the cache's comes first, as in a kernel's structs.
PassRun Pipeline::runOf(size_t stage, size_t pass) const {
  const Stage& own = stages_[stage];
  PassRun run{own.kernels[pass], own.masks[pass], {}, {}, own.entries[pass]};
  if (own.info->passes[pass].seesCache) {
    run.buffers = bindings(cache_);
    run.params = stages_[cache_].params;
  }
  const std::vector<BufferId> buffers = bindings(stage);
  run.buffers.insert(run.buffers.end(), buffers.begin(), buffers.end());
  run.params.insert(run.params.end(), own.params.begin(), own.params.end());
  return run;
}

std::vector<PassRun> Pipeline::beginFrame(bool isNewView) {
  std::vector<bool> ran;
  for (Stage& stage : stages_) {
    stage.runs = isNewView || !stage.info->onlyOnNewViews;
    for (const PassInfo& pass : stage.info->passes)
      ran.push_back(stage.runs && (isNewView || !pass.onlyOnNewViews));
    // What the last run left becomes the history.
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
    for (const PassInfo& info : stage.info->passes) {
      PassResult& out = passes.emplace_back();
      out.name = info.name;
      if (!ran[pass++]) continue;
      out.timeMs = result.timesMs[next];
      out.counters = result.counters[next];
      ++next;
    }
  }
  return passes;
}

BufferId Pipeline::shown() const {
  // A denoiser without passes shows what came before it.
  for (size_t s = stages_.size(); s-- > 0;) {
    if (!stages_[s].buffers.empty()) return stages_[s].buffers.front();
  }
  return kNoBuffer;
}

}  // namespace restlab
