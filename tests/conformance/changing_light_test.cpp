// Histories that retrace paths of the last frame: a constant light must change nothing, a changed
// light must be forgotten.
#include <gtest/gtest.h>

#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/light_factor.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

std::vector<Variant> variantsThatValidate() {
  std::vector<Variant> all = allVariants();
  std::erase_if(all, [](const Variant& v) {
    const ParameterMap known = resolveParameters(findMethod(configOf(v)), {});
    return v.endsPaths || !known.contains("validate_every");
  });
  return all;
}

class ChangingLight : public ::testing::TestWithParam<Variant> {
 protected:
  static SessionConfig config(int64_t every) {
    SessionConfig c = configOf(GetParam());
    c.parameters["validate_every"] = every;
    return c;
  }
  static std::shared_ptr<const CompiledScene> dimmed(const char* name) {
    return CompiledScene::build(withLightFactor(makeBuiltinScene(name), kAllLights, 0.25));
  }
};

double energyOf(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(p.x + p.y + p.z);
  return sum;
}

// Tests a still camera, then a moving one, a changed parameter, and an image size that is no
// multiple of the groups.
TEST_P(ChangingLight, AStillLightChangesNoBit) {
  for (const char* name : {"door-ajar", "glossy-gallery", "glass"}) {
    const auto scene = bias::builtinScene(name);
    const auto run = [&](int64_t every) {
      SessionConfig c = config(every);
      c.width = 47;
      auto session = std::make_unique<Session>(scene, c);
      runFrames(*session, *scene, 16);
      if (session->config().parameters.contains("light_candidates"))
        session->setParameters({{"light_candidates", int64_t{4}}});
      session->frames(3);
      return session;
    };
    const auto plain = run(0), validated = run(4);
    EXPECT_EQ(countDifferent(plain->radiance(), validated->radiance()), 0u) << name;
    EXPECT_EQ(plain->frame().health.counts, validated->frame().health.counts) << name;
  }
}

TEST_P(ChangingLight, LightThatWasIsForgotten) {
  for (const char* name : {"cornell-box", "door-ajar"}) {
    const auto dim = dimmed(name);
    SessionConfig plain = configOf(GetParam());
    Session fresh(dim, plain);
    fresh.frames(40);
    const double right = energyOf(fresh.radiance());
    const auto after = [&](int64_t every) {
      Session session(bias::builtinScene(name), config(every));
      session.frames(40);
      session.setScene(dim);
      session.frames(2);
      return energyOf(session.radiance()) / right;
    };
    EXPECT_NEAR(after(16), 1.0, 0.25) << name;
    EXPECT_GT(after(0), 2.0) << name << ": the check sees what is remembered";
  }
}

// One lamp goes off as another goes on: the energy hardly changes, but its place does.
TEST_P(ChangingLight, ALampThatIsElsewhereIsForgotten) {
  const auto only = [](const char* light) {
    Scene scene = withLightFactor(makeBuiltinScene("glossy-gallery"), kAllLights, 0.0);
    return CompiledScene::build(withLightFactor(std::move(scene), light, 1.0));
  };
  const auto left = only("light-left"), right = only("light-right");
  const SessionConfig validated = config(16), plain = config(0);
  SessionConfig path = bias::pathMethod(1).config;
  path.width = plain.width;
  path.height = plain.height;
  const uint32_t frames = 256;
  Session truth(right, path);
  Image mean(path.width, path.height);
  for (uint32_t i = 0; i < frames; ++i) {
    truth.frame();
    const Image& image = truth.radiance();
    for (size_t p = 0; p < mean.pixels.size(); ++p)
      mean.pixels[p] += image.pixels[p] / float(frames);
  }
  const auto errorOf = [&](const std::shared_ptr<const CompiledScene>& first,
                           const SessionConfig& what) {
    Session session(first, what);
    session.frames(40);
    session.setScene(right);
    session.frames(8);
    double sum = 0.0;
    for (size_t p = 0; p < mean.pixels.size(); ++p) {
      const glm::vec3 d = session.radiance().pixels[p] - mean.pixels[p];
      sum += double(glm::dot(d, d)) / double(mean.pixels.size());
    }
    return sum;
  };
  const double forgets = errorOf(left, validated), remembers = errorOf(left, plain);
  EXPECT_LT(forgets, 0.1 * remembers);
  EXPECT_GT(remembers, 10.0 * errorOf(right, plain)) << "the check sees what is remembered";
}

// Histories that follow surfaces forget old light, and so do entries, even if they are not fed in
// the frame of the change.
TEST_P(ChangingLight, LightThatWasIsForgottenWhileTheCameraWalks) {
  const auto bright = bias::builtinScene("cornell-box"), dim = dimmed("cornell-box");
  const SceneCamera start = bright->source().cameras.front();
  const auto energyOfWalk = [&](const std::shared_ptr<const CompiledScene>& first, int64_t every) {
    Session session(first, config(every));
    for (int i = 0; i < 24; ++i) {
      if (i == 20) session.setScene(dim);
      SceneCamera camera = start;
      camera.cameraToWorld[3] += 0.02 * i * start.cameraToWorld[0];
      session.setCamera(camera);
      session.frame();
    }
    return energyOf(session.radiance());
  };
  const double right = energyOfWalk(dim, 0);
  const double validated = energyOfWalk(bright, 16) / right,
               plain = energyOfWalk(bright, 0) / right;
  EXPECT_NEAR(validated, 1.0, 0.25);
  // Its reservoirs name lamps, whose radiance is read anew at every shift: no light is remembered.
  if (GetParam().integrator == "restir_di") return;
  EXPECT_GT(plain, validated + 0.2) << "the check sees what is remembered";
}

INSTANTIATE_TEST_SUITE_P(Every, ChangingLight, ::testing::ValuesIn(byDay(variantsThatValidate())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, ChangingLight,
                         ::testing::ValuesIn(byNight(variantsThatValidate())), VariantName());

}  // namespace
}  // namespace restlab::conformance
