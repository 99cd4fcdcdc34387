// Layers of a method: per-pixel numbers that match its buffers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/caches/entries/settings.h"
#include "core/frame/denoiser.h"
#include "core/image/io/layer_colors.h"
#include "tests/bias/few_entries.h"
#include "tests/conformance/cache_run.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

SessionConfig layersConfig(const std::string& cache, const ParameterMap& parameters = {}) {
  SessionConfig config;
  config.integrator = "restir_gi";
  config.cache = cache;
  config.width = 48;
  config.height = 27;
  config.threads = 1;
  config.pixelFilter = rl::RL_FILTER_CENTER;
  config.parameters = parameters;
  return config;
}

// A value that is kept twice would stand in the viewer's table under one name.
TEST(Layers, APixelsValuesHaveNamesOfTheirOwn) {
  for (const char* integrator : {"restir_di", "restir_gi", "restir_pt"})
    for (const std::string& cache : bias::cachesWithEntries()) {
      SessionConfig config = layersConfig(cache);
      config.integrator = integrator;
      Session session(bias::builtinScene("cornell-box"), config);
      session.frame();
      std::set<std::string> names;
      for (const ProbeValue& v : session.probe(20, 18))
        EXPECT_TRUE(names.insert(v.name).second) << integrator << ' ' << cache << ' ' << v.name;
      EXPECT_GT(names.size(), 5u);
    }
}

class EntryLayers : public testing::TestWithParam<std::string> {};

// Uses synthetic surfaces, whose buffers can be inspected: so many that places are scarce.
TEST_P(EntryLayers, AreWhatTheBuffersHold) {
  const ParameterMap given = {{kEntryCount, int64_t{1024}}};
  const Method method = findMethod("restir_gi", GetParam(), "none");
  const ParameterMap resolved = resolveParameters(method, given);
  CacheRun run(GetParam(), {256, 192}, given);
  run.look([](glm::uvec2) { return Shown{}; });
  for (int i = 0; i < 3; ++i) run.frame();
  const FrameSnapshot kept{
      [&](const std::string& name) -> std::span<const uint32_t> { return run.words(name); },
      resolved};
  std::map<std::string, std::function<float(size_t)>> layers;
  for (const LayerInfo& info : method.cache->layers) layers[info.name] = info.values(kept);

  const std::vector<uint32_t>&own = run.words(kEntryOfPixel), &keys = run.words("entry_keys");
  const auto most = uint32_t(std::get<int64_t>(resolved.at("entry_probes")));
  const auto isTaken = [&](uint32_t place) { return keys[size_t{2} * (place % 1024)] != 0; };
  size_t without = 0, atOnce = 0, later = 0;
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    const float entry = layers.at("entry")(slot), load = layers.at("load")(slot);
    const auto probes = uint32_t(layers.at("probes")(slot));
    if (own[slot] == rl::RL_INVALID) {
      EXPECT_EQ(entry + load + float(probes), 0.0f);
      ++without;
      continue;
    }
    ASSERT_EQ(entry, float(own[slot]) + 1.0f);
    ASSERT_GE(probes, 1u);
    ASSERT_LE(probes, most) << "it does not lie where its key says";
    const uint32_t home = own[slot] + 1024 + 1 - probes;
    uint32_t taken = 0;
    for (uint32_t i = 0; i < most; ++i) {
      taken += isTaken(home + i);
      EXPECT_TRUE(i >= probes || isTaken(home + i)) << "places are filled in order";
    }
    EXPECT_EQ(load, float(taken) / float(most));
    ++(probes == 1 ? atOnce : later);
  }
  EXPECT_GT(without, 10u);
  EXPECT_GT(atOnce, 100u);
  EXPECT_GT(later, 100u);
}

TEST_P(EntryLayers, PixelsOfOneEntryHaveOneColour) {
  const auto scene = bias::builtinScene("door-ajar");
  Session session(scene, layersConfig(GetParam()));
  for (int i = 0; i < 6; ++i) session.frame();
  const Image entries = session.aov("entry"), confidences = session.aov("entry_confidence"),
              depth = session.aov("depth"), colours = falseColors(entries);
  const auto cap = float(std::get<double>(session.config().parameters.at("entry_cap")));
  std::map<float, glm::vec3> colourOf;
  std::map<float, float> confidenceOf;
  std::set<std::array<float, 3>> different;
  size_t remembered = 0;
  for (size_t i = 0; i < entries.pixels.size(); ++i) {
    const glm::vec3 entry = entries.pixels[i], colour = colours.pixels[i];
    EXPECT_EQ(entry, glm::vec3(entry.x));
    if (entry.x == 0.0f || depth.pixels[i].x == 0.0f) {
      EXPECT_EQ(colour == glm::vec3(0.0f), entry.x == 0.0f);
      EXPECT_EQ(confidences.pixels[i].x, 0.0f);
      continue;
    }
    const float confidence = confidences.pixels[i].x;
    EXPECT_EQ(colourOf.try_emplace(entry.x, colour).first->second, colour);
    EXPECT_EQ(confidenceOf.try_emplace(entry.x, confidence).first->second, confidence);
    // Each offered sample has confidence 1.
    EXPECT_LE(confidence, cap + float(rl::RL_ENTRY_INSERTIONS));
    remembered += confidence >= 1.0f;
    different.insert({colour.x, colour.y, colour.z});
  }
  EXPECT_EQ(different.size(), colourOf.size()) << "two entries have one colour";
  EXPECT_GT(colourOf.size(), 50u);
  EXPECT_LT(colourOf.size(), entries.pixels.size() / 2);
  EXPECT_GT(remembered, entries.pixels.size() / 2);
}

TEST_P(EntryLayers, AProbeSaysTheSameNumbers) {
  Session session(bias::builtinScene("door-ajar"), layersConfig(GetParam()));
  for (int i = 0; i < 5; ++i) session.frame();
  std::map<std::string, double> values;
  for (const ProbeValue& v : session.probe(30, 20)) values[v.name] = std::atof(v.value.c_str());
  for (const char* name : {"entry", "load", "probes", "confidence", "entry_confidence"}) {
    ASSERT_TRUE(values.contains(name)) << name;
    EXPECT_NEAR(values[name], double(session.aov(name).at(30, 20).x), 1e-5 * values[name]) << name;
  }
  EXPECT_GT(values["entry"], 0.0);
}

INSTANTIATE_TEST_SUITE_P(Cache, EntryLayers, testing::ValuesIn(bias::cachesWithEntries()),
                         [](const auto& test) { return test.param; });

// In a still view without spatial donors a history gains one sample per frame, up to the cap plus
// the frame's own sample.
TEST(Layers, ConfidenceGrowsToTheCap) {
  const ParameterMap alone = {{"spatial_neighbours", int64_t{0}}, {"confidence_cap", 5.0}};
  Session session(bias::builtinScene("cornell-box"), layersConfig("pixel", alone));
  for (int frame = 1; frame <= 9; ++frame) {
    session.frame();
    for (const glm::vec3& c : session.aov("confidence").pixels)
      ASSERT_EQ(c, glm::vec3(float(std::min(frame, 6)))) << frame;
  }
}

TEST(Layers, AgeCountsFramesOfAView) {
  const auto scene = bias::builtinScene("cornell-box");
  Session session(scene, layersConfig("pixel"));
  SceneCamera camera = scene->source().cameras.front();
  for (const int moved : {0, 4}) {
    camera.cameraToWorld[3] += 0.01 * moved * camera.cameraToWorld[0];
    session.setCamera(camera);
    for (int frame = 1; frame <= 3; ++frame) {
      session.frame();
      for (const glm::vec3& age : session.aov("age").pixels) ASSERT_EQ(age.x, float(frame));
    }
  }
}

TEST(Layers, OnlyCachesOfEntriesHaveEntries) {
  Session session(bias::builtinScene("cornell-box"), layersConfig("pixel"));
  session.frame();
  try {
    session.aov("entry");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    EXPECT_STREQ(error.what(),
                 "unknown AOV 'entry'; AOVs: radiance, positionW, normalW, albedo, depth, object, "
                 "emission, motion, ambient, confidence, age, rejected_shifts, partner, kind, "
                 "shift_outcome");
  }
  EXPECT_EQ(findMethod("path", "", "none").aovNames(), Session::aovNames());
}

TEST(Layers, NeedAFrame) {
  Session session(bias::builtinScene("cornell-box"), layersConfig("voxel"));
  EXPECT_THROW(session.aov("entry"), Error);
  session.frame();
  EXPECT_EQ(session.aov("entry").width, 48u);
  session.resize(16, 8);
  EXPECT_THROW(session.aov("entry"), Error);
}

TEST(Layers, OfAMethodHaveNamesOfTheirOwn) {
  for (const IntegratorInfo* integrator : integratorRegistry()) {
    for (const CacheInfo* cache : cacheRegistry()) {
      for (const DenoiserInfo* denoiser : denoiserRegistry()) {
        const Method method =
            findMethod(integrator->name, integrator->usesCache ? cache->name : "", denoiser->name);
        const std::vector<std::string> names = method.aovNames();
        EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
        for (const LayerInfo* layer : method.layers()) EXPECT_NE(layer->summary, "");
      }
    }
  }
}

}  // namespace
}  // namespace restlab::conformance
