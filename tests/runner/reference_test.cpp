// References in the library: extended bit for bit, for cameras that the scene does not have, under
// keys that distinguish cameras.
#include "experiments/runner/reference/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/reference/light_draws.h"
#include "experiments/runner/reference/reference_halves.h"
#include "tests/runner/small_reference.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

// Moves the scene's camera sideways.
SceneCamera aside(const PreparedScene& scene, double metres = 0.25) {
  SceneCamera camera = scene.scene->source().cameras.at(scene.camera);
  camera.cameraToWorld[3].x += metres;
  return camera;
}

using ReferenceRendering = TemporaryFolder;

TEST_F(ReferenceRendering, ExtendedIsBitForBitThatOfOneGo) {
  const PreparedScene scene = prepared();
  ReferenceStore store;
  store.folder = folder();
  // Odd numbers in between: the second half has the next sample.
  for (const uint64_t spp : {2, 9, 10, 27}) {
    const Reference inParts = renderReference(scene, smallConfig(), {.spp = spp}, store);
    expectSame(inParts, renderReference(scene, smallConfig(), {.spp = spp}));
  }
}

TEST_F(ReferenceRendering, TargetOfErrorIsMetAtTheSameSample) {
  const PreparedScene scene = prepared();
  const ReferenceTarget target = {.relmse = 0.005};
  const Reference inOneGo = renderReference(scene, smallConfig(), target);
  ASSERT_GE(inOneGo.spp, 40u) << "checks of several calls are needed";
  EXPECT_LE(inOneGo.relmse, target.relmse);
  EXPECT_LE(inOneGo.relmseSinceHalf, target.relmse);
  // Interrupt between two checks and at one.
  for (const uint64_t spp : {uint64_t(2), inOneGo.spp / 2, inOneGo.spp / 2 + 1, inOneGo.spp - 1}) {
    ReferenceStore store;
    store.folder = folder() / std::to_string(spp);
    renderReference(scene, smallConfig(), {.spp = spp}, store);
    expectSame(renderReference(scene, smallConfig(), target, store), inOneGo);
  }
  // Samples beyond the target are known already, and count.
  ReferenceStore store;
  store.folder = folder();
  const Reference more = renderReference(scene, smallConfig(), {.spp = 4 * inOneGo.spp}, store);
  EXPECT_EQ(more.relmseSinceHalf <= target.relmse,
            renderReference(scene, smallConfig(), target, store).spp == more.spp);
}

TEST_F(ReferenceRendering, OneEstimateBelowTheTargetIsNotEnough) {
  const PreparedScene scene = prepared();
  // The estimate from 64 samples, which fewer samples did not reach.
  const double relmse = renderReference(scene, smallConfig(), {.spp = 64}).relmse;
  const Reference reference = renderReference(scene, smallConfig(), {.relmse = relmse});
  EXPECT_GT(reference.spp, 64u);
  Reference before = reference;
  before.relmseSinceHalf = 2.0 * relmse;
  EXPECT_TRUE(meetsTarget(reference, {.relmse = relmse}));
  EXPECT_FALSE(meetsTarget(before, {.relmse = relmse}));
  before.relmseSinceHalf = NAN;
  EXPECT_FALSE(meetsTarget(before, {.relmse = relmse})) << "of an earlier version";
}

// Adds to the room a point light "weak" that is drawn with about this probability.
PreparedScene withWeakLight(double probability) {
  Scene scene = prepared().scene->source();
  PunctualLight light;
  light.name = "weak";
  light.kind = rl::RL_LIGHT_POINT;
  light.posW = glm::dvec3(0.0, 0.5, 0.0);
  light.intensity = glm::vec3(1.0f);
  scene.lights.push_back(light);
  // Lights are drawn by power: measure the probability at some intensities to find the wanted one.
  double unit = 1.0;
  for (int i = 0; i < 2; ++i) {
    scene.lights.back().intensity = glm::vec3(float(unit));
    const auto lights = drawnLights(*CompiledScene::build(scene));
    const double p = lights.back().probability;
    unit *= probability * (1.0 - p) / (p * (1.0 - probability));
  }
  PreparedScene own = prepared();
  scene.lights.back().intensity = glm::vec3(float(unit));
  own.scene = CompiledScene::build(scene);
  return own;
}

// Halves that both miss a light agree. A light with too few expected draws is named, and the
// reference is not called converged.
TEST_F(ReferenceRendering, ALightThatIsHardlyDrawnIsNotConverged) {
  const PreparedScene scene = withWeakLight(1e-6);
  const std::vector<DrawnLight> lights = drawnLights(*scene.scene);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[1].name, "weak");
  EXPECT_NEAR(lights[0].probability + lights[1].probability, 1.0, 1e-6);
  const Reference reference = renderReference(scene, smallConfig(), {.relmse = 0.02});
  EXPECT_LE(reference.relmseSinceHalf, 0.02) << "it stops: a million samples are out of reach";
  const std::string why = whyNotConverged(reference);
  EXPECT_EQ(why.rfind("1 of 2 lights drawn too seldom to know its share", 0), 0u) << why;
  EXPECT_NE(why.find("'weak' 0.0"), std::string::npos) << why;
  const auto file = folder() / "weak.exr";
  writeReference(file, reference);
  EXPECT_EQ(whyNotConverged(readReference(file)), why);
  EXPECT_TRUE(meetsTarget(readReference(file), {.relmse = 0.02}));
  // The room alone gives no warning.
  EXPECT_EQ(whyNotConverged(renderReference(prepared(), smallConfig(), {.relmse = 0.02})), "");
}

// Renders more samples if that is enough for the weak light.
TEST_F(ReferenceRendering, ATargetWaitsForLightsThatAreSoonDrawnOften) {
  const double relmse = 0.02;
  const Reference before = renderReference(prepared(), smallConfig(), {.relmse = relmse});
  const double rays = 1000.0 / std::stod(before.metadata.at("light_draws_need_spp"));
  // Needs a little more than twice the samples: more than one check has, less than the next one.
  const double probability = 1000.0 / (rays * 2.2 * double(before.spp));
  const Reference reference =
      renderReference(withWeakLight(probability), smallConfig(), {.relmse = relmse});
  EXPECT_EQ(whyNotConverged(reference), "");
  EXPECT_GE(std::stod(reference.metadata.at("fewest_light_draws")), kFewestLightDraws);
  EXPECT_GT(double(reference.spp), 1.5 * double(before.spp));
  // Lights are judged where errors are: the same after an interruption that had enough draws.
  EXPECT_TRUE(RelmseChecks::isDue(reference.spp));
  ReferenceStore store;
  store.folder = folder();
  const PreparedScene scene = withWeakLight(probability);
  renderReference(scene, smallConfig(), {.spp = reference.spp - 1}, store);
  expectSame(renderReference(scene, smallConfig(), {.relmse = relmse}, store), reference);
}

// A given limit is used up for rare lights, even after the error is small enough.
TEST_F(ReferenceRendering, ATargetGoesOnForRareLightsUntilTheLimit) {
  const PreparedScene scene = withWeakLight(1e-6);
  const Reference reference = renderReference(scene, smallConfig(), {.spp = 600, .relmse = 0.02});
  EXPECT_EQ(reference.spp, 600u);
  EXPECT_NE(whyNotConverged(reference), "");
  EXPECT_FALSE(meetsTarget(reference, {.spp = 700, .relmse = 0.02}));
  // Enough draws end the rendering before the limit.
  EXPECT_LT(renderReference(withWeakLight(0.01), smallConfig(), {.spp = 600, .relmse = 0.02}).spp,
            600u);
}

// Gives the room's lamp an image of 64x64 texels, of which `bright` emit.
PreparedScene withTexturedLamp(uint32_t bright) {
  Scene scene = prepared().scene->source();
  TextureImage image;
  image.name = "lamp";
  image.width = image.height = 64;
  image.texels.assign(64 * 64, 0xff000000u);
  std::fill_n(image.texels.begin(), bright, 0xffffffffu);
  scene.images.push_back(image);
  TextureUse use;
  use.image = uint32_t(scene.images.size()) - 1;
  scene.textureUses.push_back(use);
  for (SceneMaterial& material : scene.materials) {
    if (material.data.emission != glm::vec3(0.0f))
      material.data.textures[rl::RL_TEX_EMISSIVE] = uint32_t(scene.textureUses.size()) - 1;
  }
  PreparedScene own = prepared();
  own.scene = CompiledScene::build(scene);
  return own;
}

// A draw of a textured lamp counts only if it hits a bright texel.
TEST_F(ReferenceRendering, DrawsOfATexturedLampCountByWhatTheyFind) {
  for (const uint32_t bright : {1u, 64u, 4096u}) {
    const auto lights = drawnLights(*withTexturedLamp(bright).scene);
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_NEAR(lights[0].probability, double(bright) / 4096.0, 1e-7) << bright;
  }
  const Reference reference = renderReference(withTexturedLamp(1), smallConfig(), {.spp = 32});
  EXPECT_NE(whyNotConverged(reference), "");
  EXPECT_EQ(whyNotConverged(renderReference(withTexturedLamp(4096), smallConfig(), {.spp = 32})),
            "");
}

TEST_F(ReferenceRendering, FilesHoldWhatTargetsAsk) {
  const PreparedScene scene = prepared();
  const Reference reference = renderReference(scene, smallConfig(), {.spp = 64});
  writeReference(folder() / "ref.exr", reference);
  EXPECT_EQ(readReference(folder() / "ref.exr").relmseSinceHalf, reference.relmseSinceHalf);
}

TEST_F(ReferenceRendering, TimeOfEarlierCallsCounts) {
  const PreparedScene scene = prepared();
  ReferenceStore store;
  store.folder = folder();
  const Reference first = renderReference(scene, smallConfig(), {.timeLimitS = 0.05}, store);
  EXPECT_GE(first.timeS, 0.05);
  const Reference again = renderReference(scene, smallConfig(), {.timeLimitS = 0.05}, store);
  EXPECT_EQ(again.spp, first.spp);
  EXPECT_EQ(again.timeS, first.timeS);
  const Reference more = renderReference(scene, smallConfig(), {.spp = first.spp + 1}, store);
  EXPECT_GT(more.timeS, first.timeS);
}

TEST_F(ReferenceRendering, SeedsAreSequencesOfTheirOwn) {
  const PreparedScene scene = prepared();
  ReferenceStore store;
  store.folder = folder();
  ReferenceConfig other = smallConfig();
  other.seed = 2;
  renderReference(scene, smallConfig(), {.spp = 4}, store);
  const Reference second = renderReference(scene, other, {.spp = 8}, store);
  expectSame(second, renderReference(scene, other, {.spp = 8}));
  EXPECT_NE(second.mean.pixels, renderReference(scene, smallConfig(), {.spp = 8}).mean.pixels);
}

TEST(ReferenceKey, TellsCamerasApart) {
  const PreparedScene scene = prepared();
  const std::string own = referenceKey(scene, smallConfig());
  ReferenceConfig config = smallConfig();
  const SceneCamera start = aside(scene, 0.0);
  config.camera = start;
  EXPECT_EQ(referenceKey(scene, config), own) << "the scene's camera, given as another one";
  config.camera->cameraToWorld[3].x += 0.0;
  config.camera->name = "of a path";
  EXPECT_EQ(referenceKey(scene, config), own) << "a name makes no image";

  std::vector<std::string> keys = {own};
  const auto add = [&](const char* what, const std::function<void(SceneCamera&)>& change) {
    config.camera = start;
    change(*config.camera);
    const std::string key = referenceKey(scene, config);
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 0) << what;
    keys.push_back(key);
  };
  const auto nudge = [](double& value) { value = std::nextafter(value, 1e9); };
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      add("the matrix", [&](SceneCamera& camera) { nudge(camera.cameraToWorld[column][row]); });
    }
  }
  add("the field of view", [&](SceneCamera& camera) { nudge(camera.yfov); });
  add("the kind", [&](SceneCamera& camera) {
    camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
    camera.ymag = camera.yfov;
  });
  add("the magnification", [&](SceneCamera& camera) {
    camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
    nudge(camera.ymag);
  });
}

TEST(ReferenceKey, TellsIntegratorsApart) {
  const PreparedScene scene = prepared();
  ReferenceConfig other = smallConfig();
  other.integrator = "bdpt";
  EXPECT_NE(referenceKey(scene, other), referenceKey(scene, smallConfig()));
  EXPECT_NE(referenceSources("bdpt"), referenceSources("path"));
  ReferenceConfig lit = other, darker = other;
  lit.integrator = darker.integrator = "local";
  lit.parameters = {{"ambient", 0.5}};
  darker.parameters = {{"ambient", 0.25}};
  EXPECT_NE(referenceKey(scene, lit), referenceKey(scene, darker));
}

TEST(ReferenceByBdpt, IsOneOfTheSameImage) {
  const PreparedScene scene = prepared();
  ReferenceConfig config = smallConfig();
  config.integrator = "bdpt";
  const Reference second = renderReference(scene, config, {.spp = 64});
  EXPECT_EQ(second.metadata.at("integrator"), "bdpt");
  EXPECT_EQ(second.metadata.at("reference_sources"), referenceSources("bdpt"));
  const Reference first = renderReference(scene, smallConfig(), {.spp = 64});
  // Both are references for one method.
  EXPECT_NO_THROW(requireSameConfiguration("second.exr", second.metadata, first.metadata));
  const double mean = channelMeans(first.mean).y;
  EXPECT_NEAR(channelMeans(second.mean).y, mean, 0.15 * mean);
}

TEST(ReferenceKey, ZeroHasOneSign) {
  const PreparedScene scene = prepared();
  ReferenceConfig plus = smallConfig(), minus = smallConfig();
  plus.camera = minus.camera = aside(scene);
  plus.camera->cameraToWorld[0][1] = 0.0;
  minus.camera->cameraToWorld[0][1] = -0.0;
  EXPECT_EQ(referenceKey(scene, plus), referenceKey(scene, minus));
}

TEST(ReferenceCamera, IsTheOneThatIsGiven) {
  const PreparedScene scene = prepared();
  ReferenceConfig config = smallConfig();
  config.camera = aside(scene);
  config.camera->yfov *= 1.1;
  config.camera->name = "step";
  // A scene with this camera as its own renders the same image.
  Scene changed = scene.scene->source();
  changed.cameras[0] = *config.camera;
  PreparedScene own = scene;
  own.scene = CompiledScene::build(std::move(changed));
  const Reference given = renderReference(scene, config, {.spp = 6});
  const Reference wanted = renderReference(own, smallConfig(), {.spp = 6});
  EXPECT_EQ(given.mean.pixels, wanted.mean.pixels);
  EXPECT_EQ(given.half1->pixels, wanted.half1->pixels);
  EXPECT_NE(given.mean.pixels, renderReference(scene, smallConfig(), {.spp = 6}).mean.pixels);
  EXPECT_EQ(given.metadata.at("camera_to_world"), wanted.metadata.at("camera_to_world"));
  EXPECT_EQ(given.metadata.at("camera_yfov"), wanted.metadata.at("camera_yfov"));
  EXPECT_EQ(given.metadata.at("camera"), "step");
  EXPECT_EQ(given.metadata.at("camera_index"), "none");
}

// A stopped sample is rendered again as the next one.
TEST(ReferenceSamples, AreWholeOrNotThere) {
  const PreparedScene scene = prepared();
  ReferenceState whole, stopped;
  ReferenceHalves halves(scene, smallConfig(), whole), other(scene, smallConfig(), stopped);
  for (uint64_t sample = 0; sample < 6; ++sample) {
    EXPECT_FALSE(other.addSample(
        [looks = std::make_shared<uint64_t>(0), sample] { return ++*looks > sample % 2; }));
    EXPECT_EQ(stopped.spp(), sample);
    EXPECT_TRUE(halves.addSample());
    EXPECT_TRUE(other.addSample([] { return false; }));
  }
  EXPECT_EQ(stopped.half0.mean().pixels, whole.half0.mean().pixels);
  EXPECT_EQ(stopped.half1.mean().pixels, whole.half1.mean().pixels);
  EXPECT_EQ(stopped.squares.mean().pixels, whole.squares.mean().pixels);
  EXPECT_EQ(stopped.health.text(), whole.health.text());
}

TEST(ReferenceCamera, AnotherOneIsAnotherConfiguration) {
  const PreparedScene scene = prepared();
  ReferenceConfig first = smallConfig(), second = smallConfig();
  first.camera = aside(scene, 0.25);
  second.camera = aside(scene, 0.5);
  const Reference a = renderReference(scene, first, {.spp = 2});
  const Reference b = renderReference(scene, second, {.spp = 2});
  const Reference own = renderReference(scene, smallConfig(), {.spp = 2});
  EXPECT_NO_THROW(requireSameConfiguration("a.exr", a.metadata, a.metadata));
  EXPECT_THROW(requireSameConfiguration("a.exr", a.metadata, b.metadata), Error);
  EXPECT_THROW(requireSameConfiguration("a.exr", a.metadata, own.metadata), Error);
}

// Metadata name a shift only where there is one.
TEST(ReferenceCamera, WithAnotherShiftIsAnotherConfiguration) {
  const PreparedScene scene = prepared();
  SceneCamera shifted = aside(scene), plain = shifted;
  shifted.shift = {0.5, 0.0};
  std::map<std::string, std::string> a = {{"scene_hash", "one"}}, b = a;
  describeCamera(plain, a);
  describeCamera(shifted, b);
  EXPECT_THROW(requireSameConfiguration("a.exr", a, b), Error);
  EXPECT_THROW(requireSameConfiguration("b.exr", b, a), Error);
  EXPECT_NO_THROW(requireSameConfiguration("a.exr", {{"scene_hash", "one"}}, b)) << "no camera";
  EXPECT_EQ(pictureWord(a, "camera_shift"), "0 0");
  describeCamera(plain, b);
  EXPECT_EQ(b, a) << "nothing of the earlier camera stays";
}

TEST_F(ReferenceRendering, OfAnotherCameraIsExtendedToo) {
  const PreparedScene scene = prepared();
  ReferenceConfig config = smallConfig();
  config.camera = aside(scene);
  ReferenceStore store;
  store.folder = folder();
  renderReference(scene, config, {.spp = 5}, store);
  expectSame(renderReference(scene, config, {.spp = 12}, store),
             renderReference(scene, config, {.spp = 12}));
}

}  // namespace

}  // namespace restlab
