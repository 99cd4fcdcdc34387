#include "core/bench/first_hits.h"

#include "core/frame/part.h"
#include "core/gbuffer/first_hits.h"

namespace restlab {

HitAgreement agreementOf(const std::vector<glm::uvec4>& a, const std::vector<glm::uvec4>& b) {
  HitAgreement sum;
  sum.pixels = a.size();
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].x != b[i].x) continue;
    ++sum.sameInstance;
    if (a[i].x == rl::RL_INVALID || a[i].y == b[i].y) ++sum.samePrimitive;
  }
  return sum;
}

FirstHits::FirstHits(std::shared_ptr<const CompiledScene> scene, const std::string& backend,
                     const BackendOptions& options, const SceneCamera& camera,
                     const glm::uvec2& size, bool isAtCentre)
    : scene_(std::move(scene)), backend_(makeBackend(backend, scene_, options)) {
  frame_.camera = scene_->camera(camera, size.x, size.y);
  frame_.width = size.x;
  frame_.height = size.y;
  frame_.pixelFilter = rl::RL_FILTER_BOX;
  frame_.sharesFilm = 1;
  const std::shared_ptr<const std::vector<uint32_t>> boxes = rasterBoxWords(*scene_);
  const size_t bytes = boxes->size() * sizeof(uint32_t);
  const BufferId hits = backend_->allocate(size_t{16} * size.x * size.y);
  const BufferId boxBuffer = bytes > 0 ? backend_->allocate(bytes) : kNoBuffer;
  if (bytes > 0) backend_->write(boxBuffer, boxes->data(), bytes);
  raster_.kernel = "raster_fragments";
  raster_.mask = backend_->maskFor(raster_.kernel, scene_->features());
  raster_.vertices = {"first_hits_corners",
                      backend_->maskFor("first_hits_corners", scene_->features())};
  raster_.buffers = {hits, kNoBuffer, kNoBuffer, boxBuffer, kNoBuffer, kNoBuffer, kNoBuffer};
  raster_.params = bytesOf(rasterParams(*scene_, isAtCentre, false));
  rays_ = raster_;
  rays_.kernel = "ray_hits";
  rays_.mask = backend_->maskFor(rays_.kernel, scene_->features());
  rays_.vertices = {};
  StartupReport ignored;
  backend_->prepare(rays_, ignored);
  backend_->prepare(raster_, ignored);
}

double FirstHits::run(const PassRun& pass) {
  backend_->submit({pass}, frame_);
  return backend_->collect().timesMs.front();
}

std::vector<glm::uvec4> FirstHits::hits() const {
  std::vector<glm::uvec4> all(size_t(frame_.width) * frame_.height);
  backend_->read(raster_.buffers[0], all.data(), all.size() * sizeof all[0]);
  return all;
}

}  // namespace restlab
