#include "tests/conformance/cache_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <random>
#include <thread>

#include "core/caches/entries/settings.h"
#include "core/dialect/order.h"
#include "core/frame/method.h"

namespace rl {
namespace {

// Context of the kernel functions for entries, for one frame.
struct EntriesContext {
  FrameData gFrame{};
  struct {
    EntryParams entries;
  } gParams{};

#define RL_HEALTH(kind) (void)(kind)
  vec3 recordVec3(const uvec4& q) const {
    return vec3(uintBitsToFloat(q.x), uintBitsToFloat(q.y), uintBitsToFloat(q.z));
  }
  uvec4 recordUvec4(const vec3& v, uint w) const {
    return uvec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), w);
  }
#include "core/dialect/math.glsl"
#include "core/dialect/rng.glsl"
#include "core/dialect/pack.glsl"
#include "core/caches/entries/entries.glsl"
};

}  // namespace
}  // namespace rl

namespace restlab::conformance {

namespace {

constexpr float kPixel = 0.25f;

}  // namespace

CacheRun::CacheRun(const std::string& cache, glm::uvec2 size, const ParameterMap& parameters)
    : info_(findCache(cache)), size_(size) {
  resolved_ = resolveParameters(findMethod("restir_gi", cache, "none"), parameters);
  entries_ = packEntries(resolved_);
  surfaces_.record = [](FrameGraph& g, const FrameInfo& f) {
    g.shared.surfaces.now = g.buffer("gbuffer", f.pixels, 16);
  };
  record(true);
  frame_.width = size.x;
  frame_.height = size.y;
  frame_.seed = 3;
  frame_.camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  frame_.camera.rightW = {1.0f, 0.0f, 0.0f};
  frame_.camera.upW = {0.0f, 1.0f, 0.0f};
  frame_.camera.forwardW = {0.0f, 0.0f, -1.0f};
  frame_.camera.halfWidth = 0.5f * kPixel * float(size.x);
  frame_.camera.halfHeight = 0.5f * kPixel * float(size.y);
  frame_.previousCamera = frame_.camera;
}

void CacheRun::record(bool isNewView) {
  graph_.record({&surfaces_, &info_}, {"", resolved_, pixels(), isNewView});
  for (const GraphBuffer& buffer : graph_.buffers())
    buffers_[buffer.name].resize(buffer.bytes() / sizeof(uint32_t));
}

void CacheRun::look(const std::function<Shown(glm::uvec2)>& shown, float x) {
  frame_.camera.posW = {x, 0.0f, 0.0f};
  rl::EntriesContext context;
  for (uint32_t slot = 0; slot < pixels(); ++slot) {
    const Shown s = shown({slot % size_.x, slot / size_.x});
    uint32_t* words = buffers_.at("gbuffer").data() + size_t{4} * slot;
    words[0] = std::bit_cast<uint32_t>(s.distance);
    words[1] = words[2] = context.packNormal(glm::normalize(s.normalW));
    words[3] = context.packColor(glm::vec3(0.5f)) | (s.distance != 0.0f ? 1u << 30u : 0u);
  }
}

void CacheRun::pass(const GraphPass& info, uint32_t threads, uint32_t order) {
  const rl::SceneData nothing{};  // kernels of caches use no scene
  rl::CpuKernelArgs args;
  args.scene = &nothing;
  args.frame = &frame_;
  std::vector<void*> addresses;
  for (size_t slot = 0; slot < info.slots.size(); ++slot) {
    const Buffer buffer = info.bound(slot);
    addresses.push_back(buffer ? buffers_.at(graph_.buffers()[buffer.index].name).data() : nullptr);
  }
  args.buffers = addresses.data();
  args.params = info.params.data();
  const auto entry = rl::findCpuKernel(info.kernel.c_str(), rl::RL_FEATURE_ALL)->entry;
  const bool isOfEntries = info.entries != 0;
  const uint32_t width = isOfEntries ? rl::RL_ENTRY_ROW : size_.x;
  std::vector<uint32_t> items(isOfEntries ? entries_.count : pixels());
  std::iota(items.begin(), items.end(), 0u);
  if (order != 0) std::shuffle(items.begin(), items.end(), std::mt19937(order));
  std::vector<rl::CpuKernelCounters> counters(threads);
  {
    std::vector<std::jthread> team;
    for (uint32_t t = 0; t < threads; ++t) {
      team.emplace_back([&, t] {
        for (size_t i = t; i < items.size(); i += threads) {
          const uint32_t x = items[i] % width, y = items[i] / width;
          entry(args, {x, y, x + 1, y + 1}, counters[t]);
        }
      });
    }
  }
  for (const rl::CpuKernelCounters& c : counters)
    for (size_t k = 0; k < rl::RL_HEALTH_COUNT; ++k) counters_.health[k] += c.health[k];
}

void CacheRun::frame(bool isNewView, uint32_t threads, uint32_t order) {
  frame_.stillFrames = isNewView ? 0 : frame_.stillFrames + 1;
  record(isNewView);
  for (const GraphPass& info : graph_.passes()) pass(info, threads, order);
  lastFrame_ = frame_;
  for (uint32_t entry = 0; entry < entries_.count; ++entry) {
    const std::vector<uint32_t> insertions = insertionsOf(entry);
    if (insertions.empty() || hasShadingPoint(entry)) continue;
    const uint32_t* visible = buffers_.at("gbuffer").data() + size_t{4} * insertions.front();
    uint32_t* shadingPoint =
        buffers_.at("shading_points").data() + size_t{4} * rl::RL_SHADING_POINT_UVEC4S * entry;
    const glm::vec3 at = posW(insertions.front());
    for (int i = 0; i < 3; ++i) shadingPoint[i] = std::bit_cast<uint32_t>(at[i]);
    shadingPoint[3] = shadingPoint[4] = visible[1];
    shadingPoint[6] = visible[3];
  }
  ++frame_.frame;
}

std::vector<uint32_t> CacheRun::entry(const std::string& buffer, uint32_t i, size_t words) const {
  const auto first = buffers_.at(buffer).begin() + std::ptrdiff_t(i * words);
  return {first, first + std::ptrdiff_t(words)};
}

glm::vec3 CacheRun::posW(uint32_t slot) const {
  const auto distance = std::bit_cast<float>(buffers_.at("gbuffer")[size_t{4} * slot]);
  const glm::vec2 film(float(slot % size_.x) + 0.5f, float(slot / size_.x) + 0.5f);
  return frame_.camera.posW + glm::vec3((film.x - 0.5f * float(size_.x)) * kPixel,
                                        (0.5f * float(size_.y) - film.y) * kPixel, -distance);
}

glm::vec3 CacheRun::anchorPosW(uint32_t entry) const {
  const std::vector<uint32_t> words =
      this->entry("shading_points", entry, 4 * rl::RL_SHADING_POINT_UVEC4S);
  return {std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]),
          std::bit_cast<float>(words[2])};
}

bool CacheRun::hasShadingPoint(uint32_t entry) const {
  return buffers_.at("shading_points")[size_t{4} * rl::RL_SHADING_POINT_UVEC4S * entry + 6] >>
             30u !=
         0;
}

std::vector<uint32_t> CacheRun::insertionsOf(uint32_t entry) const {
  rl::EntriesContext context;
  context.gFrame = lastFrame_;
  context.gParams.entries = entries_;
  std::vector<uint32_t> slots;
  for (const uint32_t priority : this->entry("insertions", entry, rl::RL_ENTRY_INSERTIONS)) {
    if (priority != 0)
      slots.push_back(context.entryCandidatePixel(context.groupOfPriority(priority)));
  }
  return slots;
}

}  // namespace restlab::conformance
