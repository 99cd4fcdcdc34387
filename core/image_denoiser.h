// A denoiser over images that were made elsewhere, with layers that came with them.
#pragma once

#include <memory>
#include <string>

#include "core/denoiser.h"
#include "core/image/image.h"
#include "core/session.h"

namespace restlab {

// A frame and what is known of it; all of one size. An empty layer is not known: then every pixel
// shows the same plane (normalW, depthMetres), reflects everything (albedo) and stands (motion).
struct LayeredFrame {
  Image radiance;
  Image normalW;      // unit, towards the viewer; 0 where the background is seen
  Image albedo;       // 0 to 1
  Image depthMetres;  // along the view, in the first channel; 0: background
  Image lights;       // radiance of lights that are seen, or anything above 0
  // Pixels to the right and down to where the last frame showed the surface; third channel: its
  // depth there in metres, 0 where it is not known.
  Image motion;
};

class ImageDenoiser {
 public:
  // Of the configuration: backend, device, threads, denoiser, its parameters, width and height.
  // Throws Error as Session does, and where the denoiser asks for what layers cannot give it.
  explicit ImageDenoiser(const SessionConfig& config);
  ~ImageDenoiser();
  ImageDenoiser(const ImageDenoiser&) = delete;
  ImageDenoiser& operator=(const ImageDenoiser&) = delete;

  // The next frame of a sequence. `radianceFrames`: that its radiance averages itself. Throws Error
  // (badUsage) where a layer has another size.
  Image frame(const LayeredFrame& layers, float radianceFrames = 1.0f);
  // Of the last frame.
  const FrameStats& stats() const;
  // All of the denoiser's, with the defaults of those that were not given.
  const ParameterMap& parameters() const;
  // Begins a new sequence.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
