// The hierarchy of lamps: a receiver draws each lamp with the probability that is evaluated for it,
// and misses none that can send it light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/frame/session.h"
#include "core/scene/compiled/light_tree.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

rl::Light randomLamp(Inputs& inputs) {
  rl::Light light{};
  const auto place = [&] {
    const float x = inputs.uniform(-4.0f, 4.0f), y = inputs.uniform(-4.0f, 4.0f);
    return glm::vec3(x, y, inputs.uniform(-4.0f, 4.0f));
  };
  light.kind = std::array{rl::RL_LIGHT_AREA, rl::RL_LIGHT_AREA, rl::RL_LIGHT_POINT,
                          rl::RL_LIGHT_SPOT}[inputs.below(4)];
  light.p0 = place();
  light.pmf = inputs.scale(1e-4f, 1.0f);
  if (light.kind == rl::RL_LIGHT_AREA) {
    const float size = inputs.scale(0.01f, 2.0f);
    light.e1 = size * inputs.direction();
    light.e2 = size * inputs.direction();
    if (inputs.below(3) == 0) light.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    if (inputs.below(3) == 0) light.flags |= rl::RL_LIGHT_FLIPPED;
  }
  if (light.kind == rl::RL_LIGHT_SPOT) {
    light.e1 = inputs.direction();
    const float outer = std::cos(inputs.uniform(0.1f, 1.5f));
    const float scale = 1.0f / std::max(0.001f, 1.0f - outer);
    light.e2 = {scale, -outer * scale, 0.0f};
  }
  return light;
}

// Lamps with their hierarchy, as a kernel sees them.
struct Lamps {
  std::vector<rl::Light> lights;
  LightTree tree;
  Dialect<> d;

  explicit Lamps(std::vector<rl::Light> all, size_t clusters = kClustersOfLamps)
      : lights(std::move(all)) {
    double sum = 0.0;
    for (const rl::Light& light : lights) sum += light.pmf > 0.0f ? double(light.pmf) : 0.0;
    for (rl::Light& light : lights) light.pmf = static_cast<float>(light.pmf / sum);
    tree = buildLightTree(lights, clusters);
    d.scene.lights.data = lights.data();
    d.scene.lightTree.data = tree.nodes.data();
    d.scene.lightTrails.data = tree.trails.data();
    d.scene.lampShare = 1.0f;
    d.frame.lightTree = 1;
  }
  // Whether a lamp's parts lead to it, or to a cluster that holds it.
  bool isLedTo(uint32_t lamp) {
    uint32_t trail = tree.trails[2 * size_t(lamp)], link = 0;
    do {
      link = d->lightNodeLink(link, trail & 3u);
      trail >>= 2;
    } while ((link & rl::RL_LIGHT_NODE_LEAF) == 0);
    const uint32_t where = link & rl::RL_LIGHT_NODE_WHERE;
    if ((link & rl::RL_LIGHT_NODE_CLUSTER) != rl::RL_LIGHT_NODE_CLUSTER) return where == lamp;
    const glm::uvec4* cluster = &tree.nodes.at(where);
    for (uint32_t i = 1; i <= cluster->x; ++i)
      if (cluster[i].y == lamp) return true;
    return false;
  }
};

std::vector<rl::Light> randomLamps(uint32_t count, uint64_t seed) {
  Inputs inputs(seed);
  std::vector<rl::Light> all;
  for (uint32_t i = 0; i < count; ++i) all.push_back(randomLamp(inputs));
  return all;
}

rl::LightReceiver randomReceiver(Inputs& inputs) {
  rl::LightReceiver receiver;
  const float x = inputs.uniform(-5.0f, 5.0f), y = inputs.uniform(-5.0f, 5.0f);
  receiver.posW = {x, y, inputs.uniform(-5.0f, 5.0f)};
  receiver.normalW = inputs.direction();
  receiver.isTwoSided = inputs.below(3) == 0 ? 1u : 0u;
  return receiver;
}

// Whether a point of the lamp sends light to the receiver, by a margin beyond rounding.
bool reaches(const rl::Light& light, const rl::LightReceiver& receiver, Inputs& inputs) {
  glm::dvec3 point(light.p0);
  if (light.kind == rl::RL_LIGHT_AREA) {
    glm::dvec2 u(inputs.uniform(), inputs.uniform());
    if (u.x + u.y > 1.0) u = glm::dvec2(1.0) - u;
    point += u.x * glm::dvec3(light.e1) + u.y * glm::dvec3(light.e2);
  }
  const glm::dvec3 d = glm::normalize(point - glm::dvec3(receiver.posW));
  const double arriving = glm::dot(d, glm::dvec3(receiver.normalW));
  if (receiver.isTwoSided == 0u && arriving < 1e-5) return false;
  if (light.kind == rl::RL_LIGHT_POINT) return true;
  if (light.kind == rl::RL_LIGHT_SPOT)
    return -glm::dot(d, glm::dvec3(light.e1)) * light.e2.x + light.e2.y > 1e-5;
  double leaving =
      -glm::dot(d, glm::normalize(glm::cross(glm::dvec3(light.e1), glm::dvec3(light.e2))));
  if ((light.flags & rl::RL_LIGHT_FLIPPED) != 0) leaving = -leaving;
  if ((light.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0) leaving = std::abs(leaving);
  return leaving > 1e-5;
}

TEST(LightTree, TurnsLeadToEachLamp) {
  for (const uint32_t count : {1u, 2u, 3u, 17u, 1000u, 5000u}) {
    Lamps lamps(randomLamps(count, count));
    for (uint32_t i = 0; i < count; ++i) ASSERT_TRUE(lamps.isLedTo(i)) << i;
  }
}

// Ten receivers draw lamps with the probabilities that lightTreeProbability() gives; what
// is missing to 1 is drawn as no lamp at all.
void expectDrawsHaveTheirProbabilities(size_t clusters) {
  Lamps lamps(randomLamps(60, 7), clusters);
  Inputs inputs(11);
  for (uint32_t r = 0; r < 10; ++r) {
    const rl::LightReceiver receiver = randomReceiver(inputs);
    std::vector<double> probabilities;
    for (uint32_t i = 0; i < lamps.lights.size(); ++i)
      probabilities.push_back(lamps.d->lightTreeProbability(i, receiver));
    const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    EXPECT_LE(sum, 1.0 + 1e-5);
    if (sum == 0.0) {  // it looks away from all of them
      --r;
      continue;
    }
    EXPECT_GT(sum, 0.5) << "most draws lead nowhere";
    probabilities.push_back(std::max(1.0 - sum, 0.0));
    std::vector<uint64_t> counts(probabilities.size());
    constexpr uint32_t samples = 200'000;
    for (uint32_t i = 0; i < samples; ++i) {
      float probability = 0.0f;
      const uint32_t lamp =
          lamps.d->lightTreeDraw(lamps.d->rngInit(r, i, 3), receiver, probability);
      ++counts[lamp == rl::RL_INVALID ? counts.size() - 1 : lamp];
      if (lamp == rl::RL_INVALID) {
        ASSERT_EQ(probability, 0.0f);
      } else {
        ASSERT_FLOAT_EQ(probability, float(probabilities[lamp]));
      }
    }
    if (probabilities.back() < 1e-5) probabilities.back() = 0.0;
    expectFits(counts, probabilities, samples, "receiver " + std::to_string(r));
  }
}

TEST(LightTree, DrawsHaveTheirProbabilities) { expectDrawsHaveTheirProbabilities(60); }
TEST(LightTree, DrawsFromClustersHaveTheirProbabilities) { expectDrawsHaveTheirProbabilities(9); }

TEST(LightTree, NoLampInReachIsMissedAndOthersAreLeftOut) {
  Lamps lamps(randomLamps(300, 5));
  Inputs inputs(21);
  uint32_t left = 0, reached = 0;
  for (uint32_t r = 0; r < 100; ++r) {
    const rl::LightReceiver receiver = randomReceiver(inputs);
    for (uint32_t lamp = 0; lamp < lamps.lights.size(); ++lamp) {
      const rl::Light& light = lamps.lights[lamp];
      const float probability = lamps.d->lightTreeProbability(lamp, receiver);
      bool isReached = false;
      for (int i = 0; i < 8; ++i) isReached |= reaches(light, receiver, inputs);
      if (isReached) {
        ++reached;
        ASSERT_GT(probability, 0.0f) << light.kind;
      }
      left += probability == 0.0f;
    }
  }
  EXPECT_GT(reached, 5000u);
  EXPECT_GT(left, 3000u) << "hardly any lamp is left out";
}

// A lamp nearby is asked more often than one as bright that is far away.
TEST(LightTree, NearLampsAreAskedMoreOften) {
  std::vector<rl::Light> two(2);
  for (size_t i = 0; i < 2; ++i) {
    two[i].kind = rl::RL_LIGHT_POINT;
    two[i].pmf = 0.5f;
    two[i].p0 = {i == 0 ? 1.0f : 10.0f, 0.0f, 1.0f};
  }
  Lamps lamps(two);
  const rl::LightReceiver floor{glm::vec3(0.0f), 0u, glm::vec3(0.0f, 0.0f, 1.0f)};
  const float near = lamps.d->lightTreeProbability(0, floor);
  const float far = lamps.d->lightTreeProbability(1, floor);
  EXPECT_NEAR(near + far, 1.0f, 1e-6f);
  // 1/2 cos / d^2 of each: 0.707 / 2 against 0.0995 / 101.
  EXPECT_NEAR(near / far, (std::sqrt(0.5) / 2.0) / (std::sqrt(1.0 / 101.0) / 101.0), 1.0);
}

// Lamps that look one way, but for rounding, light nothing behind them.
TEST(LightTree, ParallelLampsKeepTheirDirection) {
  Inputs inputs(3);
  std::vector<rl::Light> spots;
  const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, -0.8f, 0.51f));
  for (uint32_t i = 0; i < 64; ++i) {
    rl::Light light = randomLamp(inputs);
    light.kind = rl::RL_LIGHT_SPOT;
    light.e1 = glm::normalize(axis * (1.0f + 1e-3f * float(i)));
    light.e2 = {10.0f, -9.0f, 0.0f};  // 26 degrees
    spots.push_back(light);
  }
  Lamps lamps(spots);
  const rl::LightReceiver behind{-100.0f * axis, 1u, axis};
  const rl::LightReceiver before{100.0f * axis, 1u, axis};
  float probability = 0.0f;
  const rl::Lanes none = lamps.d->lightNodeImportance(0, behind);
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(rl::lanesAt(none, i), 0.0f);
  EXPECT_NE(lamps.d->lightTreeDraw(lamps.d->rngInit(1, 1, 1), before, probability), rl::RL_INVALID);
}

// Only sessions that choose by the hierarchy build it.
TEST(LightTree, IsBuiltWhereItIsAskedFor) {
  const auto scene = CompiledScene::build(makeBuiltinScene("quad-light?triangles=2e5"));
  SessionConfig config;
  config.width = config.height = 8;
  config.lightChoice = kLightChoicePower;
  Session byPower(scene, config);
  EXPECT_EQ(scene->data().lightTree.data, nullptr);
  config.lightChoice = kLightChoiceTree;
  Session byTree(scene, config);
  EXPECT_NE(scene->data().lightTree.data, nullptr);
  EXPECT_EQ(scene->data().lampShare, 1.0f);
}

TEST(LightTree, LampsWithoutPowerAndLampsInOnePlaceDoNoHarm) {
  std::vector<rl::Light> none(3);
  EXPECT_TRUE(buildLightTree(none).nodes.empty());
  none[1].pmf = std::nanf("");
  EXPECT_TRUE(buildLightTree(none).nodes.empty());
  std::vector<rl::Light> same(100'000);
  for (rl::Light& light : same) {
    light.kind = rl::RL_LIGHT_POINT;
    light.pmf = 1e-5f;
    light.p0 = glm::vec3(1.0f);
  }
  same[7].pmf = 0.0f;
  Lamps lamps(std::move(same));
  const rl::LightReceiver inside{glm::vec3(1.0f), 0u, glm::vec3(0.0f, 0.0f, 1.0f)};
  for (const uint32_t i : {0u, 50'000u, 99'999u}) {
    EXPECT_TRUE(lamps.isLedTo(i));
    EXPECT_NEAR(lamps.d->lightTreeProbability(i, inside) * 1e5, 1.0, 0.5);
  }
}

}  // namespace
}  // namespace restlab::unit
