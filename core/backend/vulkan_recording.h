// A frame's commands, recorded once and submitted for every frame of its kind.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/backend/glsl_preamble.h"

namespace restlab {

// The rows of workgroups that one dispatch of a pass covers.
struct Band {
  uint32_t pass = 0, firstRow = 0, rows = 0;
};

// A frame's commands, with timestamps around every band.
struct Recording {
  std::vector<VkCommandBuffer> commands;  // one per band
  std::vector<Band> bands;
  VkQueryPool queries = VK_NULL_HANDLE;
};

// Key of the recording that serves a frame.
struct RecordingKey {
  std::vector<VkPipeline> pipelines;
  std::vector<std::array<uint32_t, 2>> sizes;  // size of each pass
  // Buffers that a raster pass draws into, by pass; none: it is no raster pass.
  std::vector<std::vector<uint32_t>> targets;
  std::vector<uint32_t> divisions;  // by pass: RasterParams::divisions, or 0
  auto operator<=>(const RecordingKey&) const = default;

  uint32_t groups(size_t pass, int axis) const {
    return (sizes[pass][size_t(axis)] + kGlslTile - 1) / kGlslTile;
  }
};

}  // namespace restlab
