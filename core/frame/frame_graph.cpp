#include "core/frame/frame_graph.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

std::array<glm::vec3, 2> sceneBoxOf(const CompiledScene& scene) {
  const std::array<glm::dvec3, 2> box = boundsWithoutStrays(scene.source());
  return {glm::vec3(box[0] - scene.origin()), glm::vec3(box[1] - scene.origin())};
}

void GraphPass::declare(std::initializer_list<Buffer> buffers, std::vector<Buffer>& as) {
  for (const Buffer buffer : buffers) {
    if (!buffer) continue;
    if (std::find(slots.begin(), slots.end(), buffer) == slots.end())
      failUsage(fmt::format("pass {}: declares a buffer that its kernel has no slot for", name));
    if (std::find(as.begin(), as.end(), buffer) == as.end()) as.push_back(buffer);
  }
}

GraphPass& GraphPass::reads(std::initializer_list<Buffer> buffers) {
  declare(buffers, read);
  return *this;
}

GraphPass& GraphPass::writes(std::initializer_list<Buffer> buffers) {
  declare(buffers, written);
  return *this;
}

GraphPass& GraphPass::updates(std::initializer_list<Buffer> buffers) {
  return reads(buffers).writes(buffers);
}

GraphPass& GraphPass::over(size_t elements) {
  if (elements == 0) failUsage(fmt::format("pass {}: runs over no element", name));
  if (elements > 0xffff0000u)
    failUsage(
        fmt::format("pass {}: runs over {} elements, more than 32 bits count", name, elements));
  entries = static_cast<uint32_t>(elements);
  return *this;
}

GraphPass& GraphPass::replays() {
  isReplay = true;
  return *this;
}

GraphPass& GraphPass::rasters(const std::string& vertexStage) {
  vertexKernel = vertexStage;
  return *this;
}

GraphPass& GraphPass::once(bool isForScene) {
  isOnce = isForScene;
  return *this;
}

Buffer GraphPass::bound(size_t slot) const {
  const auto has = [&](const std::vector<Buffer>& all) {
    return std::find(all.begin(), all.end(), slots[slot]) != all.end();
  };
  return has(read) || has(written) ? slots[slot] : Buffer{};
}

GraphPass& Kernels::pass(const std::string& name, const std::string& kernel) const {
  for (const GraphPass& other : graph_.passes_) {
    if (other.name == name)
      failUsage(fmt::format("pass {}: {} has one of that name, too", name, other.part));
  }
  GraphPass& pass = graph_.passes_.emplace_back();
  pass.name = name;
  pass.part = graph_.part_;
  pass.kernel = kernel;
  pass.params = params_;
  pass.slots = slots_;
  return pass;
}

void FrameGraph::record(const std::vector<const PartInfo*>& parts, FrameInfo frame) {
  passes_.clear();
  shared = {};
  isDeclared_.assign(buffers_.size(), false);
  isAdvanced_.assign(buffers_.size(), false);
  for (const PartInfo* part : parts)
    frame.wantsRadianceFrames = frame.wantsRadianceFrames || part->readsRadianceFrames;
  for (const PartInfo* part : parts) {
    if (!part->record || !isEnabled(part->enabledIf, frame.parameters)) continue;
    part_ = part->name;
    part->record(*this, frame);
  }
}

Buffer FrameGraph::declare(const GraphBuffer& wanted) {
  if (wanted.count == 0) return {};
  const auto [at, isNew] = byName_.try_emplace(wanted.name, static_cast<uint32_t>(buffers_.size()));
  const uint32_t index = at->second;
  if (isNew) {
    buffers_.push_back(wanted);
    buffers_.back().part = part_;
    isSwapped_.push_back(false);
    isDeclared_.push_back(false);
    isAdvanced_.push_back(false);
  }
  const GraphBuffer& known = buffers_[index];
  if (isDeclared_[index])
    failUsage(fmt::format("{}: buffer '{}' is declared twice", part_, wanted.name));
  if (known.part != part_ || known.bytes() != wanted.bytes() || known.features != wanted.features)
    failUsage(fmt::format("{}: buffer '{}' changes between frames", part_, wanted.name));
  isDeclared_[index] = true;
  return {index};
}

Buffer FrameGraph::buffer(const std::string& name, size_t count, uint32_t elementBytes,
                          rl::FeatureMask features) {
  return declare({name, "", count, elementBytes, features, false, false, {}});
}

Buffer FrameGraph::onceBuffer(const std::string& name, size_t count, uint32_t elementBytes) {
  GraphBuffer wanted = {name, "", count, elementBytes, 0, false, false, {}};
  wanted.isOnce = true;
  return declare(wanted);
}

Buffer FrameGraph::transient(const std::string& name, size_t count, uint32_t elementBytes,
                             rl::FeatureMask features) {
  return declare({name, "", count, elementBytes, features, false, true, {}});
}

History FrameGraph::history(const std::string& name, size_t count, uint32_t elementBytes,
                            rl::FeatureMask features) {
  const Buffer first = declare({name, "", count, elementBytes, features, true, false, {}});
  const Buffer second =
      declare({name + "_previous", "", count, elementBytes, features, true, false, {}});
  if (!first) return {};
  return isSwapped_[first.index] ? History{second, first} : History{first, second};
}

Buffer FrameGraph::table(const std::string& name,
                         std::shared_ptr<const std::vector<uint32_t>> contents,
                         uint32_t elementBytes) {
  const size_t count = contents->size() * sizeof(uint32_t) / elementBytes;
  return declare({name, "", count, elementBytes, 0, false, false, std::move(contents)});
}

void FrameGraph::loop(uint32_t times, const std::function<void()>& body) {
  const size_t first = passes_.size();
  body();
  if (first == passes_.size() || times == 0)
    failUsage(fmt::format("{}: a loop without passes or turns", part_));
  passes_[first].loopPasses = static_cast<uint32_t>(passes_.size() - first);
  passes_[first].loopTimes = times;
}

std::vector<size_t> FrameGraph::order() const {
  std::vector<size_t> all;
  for (size_t pass = 0; pass < passes_.size(); ++pass) {
    const uint32_t length = passes_[pass].loopPasses;
    if (length == 0) {
      all.push_back(pass);
      continue;
    }
    for (uint32_t turn = 0; turn < passes_[pass].loopTimes; ++turn)
      for (uint32_t i = 0; i < length; ++i) all.push_back(pass + i);
    pass += length - 1;
  }
  return all;
}

History FrameGraph::advance(const History& history) {
  if (history.now) {
    const uint32_t first = std::min(history.now.index, history.previous.index);
    isSwapped_[first] = !isSwapped_[first];
    isAdvanced_[first] = true;
  }
  return {history.previous, history.now};
}

namespace {

bool holds(const std::vector<Buffer>& all, Buffer buffer) {
  return std::find(all.begin(), all.end(), buffer) != all.end();
}
bool touches(const GraphPass& pass, Buffer buffer) {
  return holds(pass.read, buffer) || holds(pass.written, buffer);
}

}  // namespace

// Now and before of a history in this frame. `first`: its first buffer.
History FrameGraph::historyOf(uint32_t first) const {
  const History both = {{first}, {first + 1}};
  return isSwapped_[first] ? History{both.previous, both.now} : both;
}

// Returns whether the last frame's buffer of a history may be overwritten from the first pass that
// writes `transient` on: no later pass of this frame touches it, and in the next frame of this kind
// no pass reads that memory, as `now` or `before`, until one has written all of it.
bool FrameGraph::isFreeFrom(uint32_t first, Buffer transient) const {
  const History history = historyOf(first);
  const auto begin = std::find_if(passes_.begin(), passes_.end(),
                                  [&](const GraphPass& pass) { return touches(pass, transient); });
  if (begin != passes_.end() && holds(begin->read, transient)) return false;
  if (std::any_of(begin, passes_.end(),
                  [&](const GraphPass& pass) { return touches(pass, history.previous); }))
    return false;
  const Buffer overwritten = isAdvanced_[first] ? history.now : history.previous;
  const auto next = std::find_if(passes_.begin(), passes_.end(),
                                 [&](const GraphPass& pass) { return touches(pass, overwritten); });
  if (next != passes_.end()) return !holds(next->read, overwritten);
  return !isAdvanced_[first];
}

void FrameGraph::shareMemory(const FrameGraph& still) {
  lenders_.assign(buffers_.size(), Buffer::kNone);
  for (uint32_t wants = 0; wants < buffers_.size(); ++wants) {
    if (!buffers_[wants].isTransient) continue;
    for (uint32_t first = 0; first + 1 < buffers_.size(); ++first) {
      const GraphBuffer& lends = buffers_[first];
      const bool isFirst = lends.isHistory && buffers_[first + 1].name == lends.name + "_previous";
      if (!isFirst || lends.features != 0 || lends.bytes() < buffers_[wants].bytes() ||
          std::find(lenders_.begin(), lenders_.end(), first) != lenders_.end() ||
          !isFreeFrom(first, {wants}) || !still.isFreeFrom(first, {wants}))
        continue;
      lenders_[wants] = first;
      break;
    }
  }
}

Buffer FrameGraph::lenderOf(Buffer buffer) const {
  if (!buffer || buffer.index >= lenders_.size() || lenders_[buffer.index] == Buffer::kNone)
    return {};
  return historyOf(lenders_[buffer.index]).previous;
}

std::vector<Buffer> FrameGraph::checkedSlots(size_t structBytes,
                                             std::initializer_list<Buffer> slots) {
  if (slots.size() * sizeof(uint64_t) != structBytes) {
    failUsage(fmt::format("{} buffers for the {} slots of a kernel's Buffers struct", slots.size(),
                          structBytes / sizeof(uint64_t)));
  }
  return slots;
}

std::vector<const GraphPass*> FrameGraph::passesOf(const std::string& part) const {
  std::vector<const GraphPass*> all;
  for (const GraphPass& pass : passes_)
    if (pass.part == part) all.push_back(&pass);
  return all;
}

Buffer FrameGraph::find(const std::string& name) const {
  const auto found = byName_.find(name);
  if (found == byName_.end()) return {};
  uint32_t index = found->second;
  if (!buffers_[index].isHistory) return {index};
  // Histories are declared in pairs, side by side.
  const bool isSecond = index > 0 && name == buffers_[index - 1].name + "_previous";
  const uint32_t first = isSecond ? index - 1 : index;
  if (isSwapped_[first]) index = isSecond ? first : first + 1;
  return {index};
}

}  // namespace restlab
