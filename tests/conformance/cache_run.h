// Runs the passes of a cache over synthetic surfaces, without an integrator.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/caches/entries/entries.h"
#include "core/frame/cache.h"
#include "core/frame/frame_graph.h"

namespace restlab::conformance {

// Surface in a pixel; `distance` from the camera, which looks along -z; 0: no surface.
struct Shown {
  float distance = 10.0f;
  glm::vec3 normalW = {0.0f, 0.0f, 1.0f};
};

class CacheRun {
 public:
  // Places an orthographic camera with pixels 0.25 metres wide at the origin.
  CacheRun(const std::string& cache, glm::uvec2 size, const ParameterMap& parameters);

  // Sets the surfaces that are seen from now on, and the camera's position along x.
  void look(const std::function<Shown(glm::uvec2)>& shown, float x = 0.0f);
  // Runs the passes of a frame over their pixels, in a shuffled order (`order` 0: in order), on
  // `threads` threads. Then gives entries without a shading point that of the first pixel that
  // feeds them, as an integrator does.
  void frame(bool isNewView = true, uint32_t threads = 1, uint32_t order = 0);

  uint32_t pixels() const { return size_.x * size_.y; }
  const std::vector<uint32_t>& words(const std::string& buffer) const {
    return buffers_.at(buffer);
  }
  // Item `i` of a buffer, of a pixel or of an entry, in words.
  std::vector<uint32_t> entry(const std::string& buffer, uint32_t i, size_t words) const;
  rl::EntryParams entries() const { return entries_; }
  glm::vec3 posW(uint32_t slot) const;
  glm::vec3 anchorPosW(uint32_t entry) const;
  bool hasShadingPoint(uint32_t entry) const;
  // Slots of the pixels that fed an entry in the last frame.
  std::vector<uint32_t> insertionsOf(uint32_t entry) const;
  uint64_t full() const { return counters_.health[rl::RL_HEALTH_CACHE_FULL]; }
  const std::map<std::string, std::vector<uint32_t>>& buffers() const { return buffers_; }

 private:
  void record(bool isNewView);
  void pass(const GraphPass& info, uint32_t threads, uint32_t order);

  const CacheInfo& info_;
  PartInfo surfaces_;  // leaves the surfaces that look() has set
  glm::uvec2 size_;
  ParameterMap resolved_;
  FrameGraph graph_;
  rl::EntryParams entries_{};
  rl::FrameData frame_{};
  rl::FrameData lastFrame_{};
  std::map<std::string, std::vector<uint32_t>> buffers_;
  rl::CpuKernelCounters counters_{};
};

}  // namespace restlab::conformance
