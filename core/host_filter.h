// A denoiser without kernels: a filter that runs on the host, after the passes of a frame.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/image/image.h"

namespace restlab {

class Pipeline;     // core/pipeline.h
struct FrameStats;  // core/session.h

// A frame and what its guides say (core/kernels/guide_data.h); all of one size.
struct HostFrame {
  Image radiance;  // 0 where it is not finite
  Image normalW;   // unit; 0 where the background is seen
  Image albedo;    // the guides' reflectance: the parameter "demodulate" says of what
};

// What is shown of a frame, of the same size. It depends on that frame alone.
using HostFilter = std::function<Image(const HostFrame&)>;

// What filterOnHost() takes of the host's memory: copies of both buffers, the frame, and what is
// shown. What the filter needs beside them only it knows.
constexpr size_t kHostFilterBytesPerPixel = 5 * sizeof(glm::vec3) + 32;

// Runs the filter on the frame that was collected last: on its buffers "radiance" and "guide".
// Lights and the background are shown as they are. `stats` get one more pass of that name, with the
// time of the copies, too, and what was not finite.
Image filterOnHost(const HostFilter& filter, const std::string& name, Pipeline& pipeline,
                   uint32_t width, uint32_t height, FrameStats& stats);

}  // namespace restlab
