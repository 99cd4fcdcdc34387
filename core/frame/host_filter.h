// A denoiser without kernels: a filter that runs on the host, after the passes of a frame.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/image/image.h"

namespace restlab {

class Pipeline;     // core/frame/pipeline.h
struct FrameStats;  // core/frame/session.h

// A frame and its features (denoiser inputs, core/gbuffer/guide_data.h); all of one size.
struct HostFrame {
  Image radiance;  // 0 where not finite
  Image normalW;   // unit; 0 on the background
  Image albedo;    // reflectance as chosen by the parameter "demodulate"
};

// Returns the shown image of a frame, of the same size. The result depends on that frame alone.
using HostFilter = std::function<Image(const HostFrame&)>;

// Host memory that filterOnHost() takes: copies of both buffers, the frame and the result. The
// filter's own memory is not included.
constexpr size_t kHostFilterBytesPerPixel = 5 * sizeof(glm::vec3) + 32;

// Runs the filter on the radiance and the features of the frame that was collected last.
// Lights and the background are shown unfiltered. Adds a pass of that name to `stats`, with the
// time including copies, and counts non-finite pixels.
Image filterOnHost(const HostFilter& filter, const std::string& name, Pipeline& pipeline,
                   uint32_t width, uint32_t height, FrameStats& stats);

}  // namespace restlab
