// A denoiser for images that were made elsewhere, with the feature layers that came with them.
#pragma once

#include <memory>
#include <string>

#include "core/frame/denoiser.h"
#include "core/frame/session.h"
#include "core/image/image.h"

namespace restlab {

// A frame and its feature layers; all of one size. Defaults for an empty layer: every pixel shows
// the same plane (normalW, depthMetres), reflects all light (albedo) and does not move (motion).
struct LayeredFrame {
  Image radiance;
  Image normalW;      // unit, towards the viewer; 0 on the background
  Image albedo;       // 0 to 1
  Image depthMetres;  // along the view, in the first channel; 0: background
  Image lights;       // radiance of visible lights, or any value above 0
  // Pixels to the right and down to where the last frame showed the surface; third channel: its
  // depth there in metres, 0 if unknown.
  Image motion;
};

class ImageDenoiser {
 public:
  // Uses these settings: backend, device, threads, denoiser, its parameters, width and height.
  // Throws Error as Session does, and if the denoiser needs inputs that layers cannot provide.
  explicit ImageDenoiser(const SessionConfig& config);
  ~ImageDenoiser();
  ImageDenoiser(const ImageDenoiser&) = delete;
  ImageDenoiser& operator=(const ImageDenoiser&) = delete;

  // Denoises the next frame of a sequence. `radianceFrames`: number of frames that the radiance
  // already averages. Throws Error (badUsage) if a layer has another size.
  Image frame(const LayeredFrame& layers, float radianceFrames = 1.0f);
  // Statistics of the last frame.
  const FrameStats& stats() const;
  // All parameters of the denoiser, with defaults for those not given.
  const ParameterMap& parameters() const;
  // Begins a new sequence.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
