// Panes that render quickly, for tests.
#pragma once

#include <string>

#include "experiments/runner/suite/prepare.h"

namespace restlab::view_test {

inline SessionConfig smallPane(const std::string& integrator,
                               const std::string& denoiser = "none") {
  SessionConfig config;
  config.integrator = integrator;
  config.denoiser = denoiser;
  config.width = 24;
  config.height = 16;
  config.maxBounces = 3;
  config.threads = 1;
  return config;
}

inline PreparedScene cornellBox() {
  SceneRequest request;
  request.scene = "cornell-box";
  return prepareScene(request);
}

}  // namespace restlab::view_test
