// Glossy surfaces whose shading normals differ from the normals of their faces, in white furnaces:
// the albedo of a lobe does not depend on the bend of its normal
// (core/shading/bsdf/inconsistent_normal.glsl).
#include "tests/analytic/inconsistent_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::analytic {
namespace {

// Statistics of the mean of all frames, in red: mean, least pixel, number of nearly black pixels.
struct Seen {
  double mean = 0.0, least = 1e9;
  int dark = 0;
};

Seen seen(Solid solid, const rl::Material& material, const char* integrator, uint32_t frames,
          uint32_t maxBounces = 1) {
  SessionConfig config;
  config.width = config.height = 64;
  config.threads = 1;
  config.integrator = integrator;
  config.maxBounces = maxBounces;
  Session session(CompiledScene::build(solidInFurnace(solid, material)), config);
  std::vector<double> sums(size_t(config.width) * config.height);
  for (uint32_t f = 0; f < frames; ++f) {
    session.frame();
    for (size_t p = 0; p < sums.size(); ++p) sums[p] += session.radiance().pixels[p].x;
  }
  Seen result;
  for (const double sum : sums) {
    result.mean += sum / frames / double(sums.size());
    result.least = std::min(result.least, sum / frames);
    result.dark += sum / frames < 0.05;
  }
  return result;
}

// Regression: black rings appeared on 524 of the 4096 pixels, about 2000 of which show the solid.
TEST(BentNormals, AMirrorReturnsAllLight) {
  const rl::Material mirror = builtin::metal(glm::vec3(1.0f), 0.0f);
  for (const Solid solid : {Solid::flat, Solid::smooth, Solid::mapped}) {
    for (const char* integrator : {"path", "restir_gi"}) {
      const Seen s = seen(solid, mirror, integrator, 4);
      EXPECT_NEAR(s.mean, 1.0, 1e-5) << integrator << ", solid " << int(solid);
      EXPECT_NEAR(s.least, 1.0, 1e-4)
          << integrator << ", solid " << int(solid) << ", " << s.dark << " dark pixels";
    }
  }
}

// Rough metal loses light that meets a second microfacet, more at flatter views: bumps only average
// this loss over other angles.
TEST(BentNormals, RoughMetalReturnsWhatItDoesWithoutBumps) {
  for (const float alpha : {0.01f, 0.1f, 0.3f}) {
    const rl::Material rough = builtin::metal(glm::vec3(1.0f), std::sqrt(alpha));
    const Seen flat = seen(Solid::flat, rough, "path", 32);
    for (const Solid solid : {Solid::smooth, Solid::mapped}) {
      const Seen path = seen(solid, rough, "path", 32);
      std::printf("  alpha %.2f, solid %d: mean %.4f, least %.3f, %d dark; flat %.4f, %.3f\n",
                  double(alpha), int(solid), path.mean, path.least, path.dark, flat.mean,
                  flat.least);
      EXPECT_NEAR(path.mean, flat.mean, 0.015) << "alpha " << alpha << ", solid " << int(solid);
      EXPECT_GT(path.least, flat.least - 0.15) << "alpha " << alpha << ", solid " << int(solid);
      const Seen restir = seen(solid, rough, "restir_gi", 32);
      EXPECT_NEAR(restir.mean, path.mean, 0.005) << "alpha " << alpha << ", solid " << int(solid);
    }
  }
}

// Light refracted back, or reflected inside through the face, also stays on its side.
TEST(BentNormals, GlassKeepsItsLight) {
  const rl::Material glass = builtin::glass(0.0f, glm::vec3(0.0f));
  const Seen flat = seen(Solid::flat, glass, "path", 8, 64);
  for (const Solid solid : {Solid::smooth, Solid::mapped}) {
    const Seen s = seen(solid, glass, "path", 8, 64);
    std::printf("  solid %d: mean %.4f, least %.3f; flat %.4f, %.3f\n", int(solid), s.mean, s.least,
                flat.mean, flat.least);
    EXPECT_NEAR(s.mean, 1.0, 0.01) << int(solid);
  }
}

}  // namespace
}  // namespace restlab::analytic
