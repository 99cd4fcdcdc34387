#include "tests/analytic/local_images.h"

#include <cmath>

namespace restlab::analytic {

Image imageOfLocal(const std::shared_ptr<const CompiledScene>& scene, ParameterMap parameters,
                   uint32_t width, uint32_t height, int frames) {
  SessionConfig config;
  config.integrator = "local";
  config.width = width;
  config.height = height;
  config.threads = 1;
  config.pixelFilter = rl::RL_FILTER_CENTER;
  config.parameters = std::move(parameters);
  Session session(scene, config);
  Image mean(width, height);
  for (int i = 0; i < frames; ++i) {
    session.frame();
    for (size_t p = 0; p < mean.pixels.size(); ++p)
      mean.pixels[p] += session.radiance().pixels[p] * (1.0f / float(frames));
  }
  return mean;
}

std::optional<glm::dvec3> floorPoint(const SceneCamera& camera, uint32_t x, uint32_t y,
                                     uint32_t width, uint32_t height, double halfWidth) {
  const double high = std::tan(0.5 * camera.yfov), wide = high * double(width) / height;
  const glm::dvec4 local((2.0 * (x + 0.5) / width - 1.0) * wide,
                         (1.0 - 2.0 * (y + 0.5) / height) * high, -1.0, 0.0);
  const glm::dvec3 dir(camera.cameraToWorld * local), eye = positionOf(camera);
  if (!(dir.y < 0.0)) return std::nullopt;
  const glm::dvec3 p = eye + dir * (-eye.y / dir.y);
  if (std::abs(p.x) > halfWidth || std::abs(p.z) > halfWidth) return std::nullopt;
  return p;
}

}  // namespace restlab::analytic
