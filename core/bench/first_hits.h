// First hits of one image by rays and by the rasteriser, to be timed or compared.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/raster/raster.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

// How many pixels show the same by both.
struct HitAgreement {
  size_t pixels = 0;
  size_t samePrimitive = 0;  // or nothing
  size_t sameInstance = 0;   // or nothing
  double share() const { return pixels == 0 ? 1.0 : double(samePrimitive) / double(pixels); }
};
HitAgreement agreementOf(const std::vector<glm::uvec4>& a, const std::vector<glm::uvec4>& b);

class FirstHits {
 public:
  // isAtCentre: at pixel centres, or at the first frame's film sample, which all pixels share.
  FirstHits(std::shared_ptr<const CompiledScene> scene, const std::string& backend,
            const BackendOptions& options, const SceneCamera& camera, const glm::uvec2& size,
            bool isAtCentre = true);
  // Finds the hits and returns the time of the pass in milliseconds.
  double byRays() { return run(rays_); }
  double byRaster() { return run(raster_); }
  // The hits of the last run, as RasterBuffers::hits.
  std::vector<glm::uvec4> hits() const;
  std::string device() const { return backend_->device(); }

 private:
  double run(const PassRun& pass);

  std::shared_ptr<const CompiledScene> scene_;
  std::unique_ptr<Backend> backend_;
  rl::FrameData frame_{};
  PassRun rays_, raster_;
};

}  // namespace restlab
