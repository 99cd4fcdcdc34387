// Histories that trace paths of the last frame again: a still light changes nothing, one that
// changes is forgotten.
#include <gtest/gtest.h>

#include "core/scene/compiled_scene.h"
#include "core/scene/light_factor.h"
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

// The camera stands, then walks.
TEST_P(ChangingLight, AStillLightChangesNoBit) {
  for (const char* name : {"door-ajar", "glossy-gallery", "glass"}) {
    const auto scene = bias::builtinScene(name);
    EXPECT_EQ(countDifferent(render(scene, config(0), 16), render(scene, config(4), 16)), 0u)
        << name;
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

INSTANTIATE_TEST_SUITE_P(Every, ChangingLight, ::testing::ValuesIn(variantsThatValidate()),
                         VariantName());

}  // namespace
}  // namespace restlab::conformance
