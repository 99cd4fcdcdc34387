// Sessions on the Vulkan backend against sessions on the CPU backend: every integrator, mode and
// cache on every built-in scene, with the same seeds. The camera moves from the third frame on.
//
// A pixel of the first frame differs if rounding changed a decision: which triangle a ray through
// an edge hits, which candidate a reservoir keeps. Every such pixel is classified, and their
// fraction is bounded. Later frames reuse the first, so differences spread to neighbours and
// persist; their growth is bounded, and at frame 16 (nightly: 32) the images of independent runs
// must have the same mean.
#include <gtest/gtest.h>

#include <boost/math/distributions/poisson.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "tests/bias/few_entries.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/reads.h"
#include "experiments/statistics/bias_test.h"

namespace restlab::parity {
namespace {

constexpr double kMaxShare = 1e-3;  // fraction of the pixels of a first frame that may differ
// Fraction that may differ between two intersectors on the CPU alone. Largest in many-lights,
// 1.4e-3 after eight bounces between round columns.
constexpr double kMaxShareOfIntersectors = 3e-3;
// Probability that a small image exceeds its bound by chance.
constexpr double kChance = 1e-4;

struct Size {
  uint32_t width, height;
  uint32_t frames;
  int threads;
};

// Largest allowed count: the quantile that a fraction of kMaxShare exceeds with probability
// kChance; the fraction itself for large images.
double mostDifferent(size_t pixels, double share = kMaxShare) {
  const double expected = share * double(pixels);
  if (expected >= 250.0) return expected;
  return quantile(complement(boost::math::poisson(expected), kChance));
}

// Bound on the pixels that differ in a frame, per differing pixel of the first frame. Without
// reuse: one. With reuse, every frame adds its own, and a pixel that differs makes its spatial
// partner differ in the next frame. A filter makes adjacent pixels differ, and its history keeps
// them.
double spreadAt(const Combination& what, uint32_t frame) {
  if (what.hasFilter()) return 9.0 * (double(frame) + 1.0);
  return what.cache.empty() ? 1.0 : double((2u << frame) - 1u);
}

// Bound in the first frame: a filter shows a different decision of a reservoir in adjacent pixels,
// too.
double spreadAtFirst(const Combination& what) {
  return what.hasFilter() && !what.cache.empty() ? spreadAt(what, 0) : 1.0;
}

// Compares one scene on two machines, frame by frame; returns the difference of the first frames.
FrameDifference compareFrames(const Combination& what, const std::string& sceneName,
                              const Machine& left, const Machine& right, const Size& size,
                              std::vector<FrameDifference>& later) {
  const auto scene = sceneNamed(sceneName);
  const auto open = [&](const Machine& where) {
    SessionConfig config = configOf(what, where, size.width, size.height, 7);
    config.threads = size.threads;
    return std::make_unique<Session>(scene, config);
  };
  const auto a = open(left), b = open(right);
  // Session on b's machine with the intersector of a.
  const bool isEmbree = std::string(right.rayTracing) == "embree";
  const auto other = isEmbree ? open(kCpuBvh) : nullptr;
  FrameDifference first;
  later.resize(size.frames - 1);
  for (uint32_t f = 0; f < size.frames; ++f) {
    const SceneCamera camera = cameraOf(*scene, f);
    for (Session* session : {a.get(), b.get(), other.get()}) {
      if (session) session->setCamera(camera);
    }
    a->frame();
    b->frame();
    FrameDifference here =
        f == 0 ? classify(scene, *a, *b) : countDifferent(a->radiance(), b->radiance());
    if (isEmbree) {
      other->frame();
      excuse(here, a->radiance(), b->radiance(), other->radiance());
    }
    if (f == 0) {
      first = here;
    } else {
      later[f - 1].add(here);
    }
  }
  return first;
}

void expectParity(const Combination& what, const std::vector<std::string>& scenes,
                  const Machine& left, const Machine& right, const Size& size) {
  FrameDifference all;
  std::vector<FrameDifference> later;
  for (const std::string& scene : scenes) {
    std::vector<FrameDifference> laterHere;
    const FrameDifference first = compareFrames(what, scene, left, right, size, laterHere);
    std::printf("  %s, %s, %s against %s: %s\n", what.name().c_str(), scene.c_str(), left.name,
                right.name, first.text().c_str());
    later.resize(laterHere.size());
    for (size_t f = 0; f < laterHere.size(); ++f) {
      std::printf("    frame %zu: %.2g differ\n", f + 1, laterHere[f].share());
      const double spread = spreadAt(what, uint32_t(f + 1));
      EXPECT_LE(double(laterHere[f].counted()), mostDifferent(first.pixels) * spread)
          << scene << ", frame " << f + 1;
      EXPECT_LE(double(laterHere[f].excused),
                mostDifferent(first.pixels, kMaxShareOfIntersectors) * spread)
          << scene << ", frame " << f + 1;
      later[f].add(laterHere[f]);
    }
    std::fflush(stdout);
    EXPECT_LE(double(first.counted()), mostDifferent(first.pixels) * spreadAtFirst(what))
        << scene << ": " << first.text();
    EXPECT_LE(double(first.excused), mostDifferent(first.pixels, kMaxShareOfIntersectors))
        << scene << ": " << first.text();
    EXPECT_EQ(first.unexplained, 0u) << scene << ": " << first.firstUnexplained;
    all.add(first);
  }
  if (scenes.size() == 1) return;
  std::printf("  %s, all scenes, %s against %s: %s\n", what.name().c_str(), left.name, right.name,
              all.text().c_str());
  EXPECT_LE(double(all.counted()), mostDifferent(all.pixels) * spreadAtFirst(what)) << all.text();
}

// Drivers compile kernels anew in each process, which takes most of the time of these tests. By day
// one test makes all checks of a combination; by night each check is a test.
class Frames : public testing::TestWithParam<Combination> {
 protected:
  void SetUp() override {
    if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  }
};

class FramesNightly : public Frames {};

// Denoisers trace nothing: one of them is enough for these. Modes differ in weights alone: the
// unbiased one is enough.
class TracedFramesNightly : public Frames {};

// One scene of one combination, so that nightly work can be divided.
class LargeFramesNightly : public testing::TestWithParam<std::tuple<Combination, std::string>> {
 protected:
  void SetUp() override {
    if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
    const std::string& scene = std::get<1>(GetParam());
    if (!isAtHand(scene)) GTEST_SKIP() << scene << " is absent (set RESTLAB_SCENES)";
  }
  const Combination& combination() const { return std::get<0>(GetParam()); }
  std::vector<std::string> scenes() const { return {std::get<1>(GetParam())}; }
};

const auto kTraced = testing::ValuesIn(combinationsThatTrace());

std::vector<Combination> unbiasedThatTrace() {
  std::vector<Combination> all = combinationsThatTrace();
  std::erase_if(all, [](const Combination& what) { return what.mode != "unbiased"; });
  return all;
}

std::string identifier(std::string name) {
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

std::vector<std::string> nightlyScenes() {
  std::vector<std::string> names = sceneNames();
  for (const std::string& gate : gateNames()) names.push_back(gate);
  return names;
}

constexpr const char* kNoHistory = "has no history: every frame is like frame 0";

constexpr Size kSmall{64, 36, 4, 1};
constexpr Size kLarge{704, 396, 4, 0};  // more than one dispatch per pass

void expectAsWithoutSpecialisation(const Combination& what,
                                   const std::vector<std::string>& scenes) {
  expectParity(what, scenes, kVulkanSpecialised, kVulkan, kSmall);
}

TEST_P(LargeFramesNightly, AsOnTheCpuWithTheSameHierarchy) {
  expectParity(combination(), scenes(), kVulkan, kCpuBvh, kLarge);
}
TEST_P(LargeFramesNightly, AsOnTheCpuWithEmbree) {
  expectParity(combination(), scenes(), kVulkan, kCpuEmbree, kLarge);
}
TEST_P(LargeFramesNightly, AsWithoutSpecialisation) {
  expectParity(combination(), scenes(), kVulkanSpecialised, kVulkan, kLarge);
}

// Last frames of independent histories; seeds of two sets must not overlap.
stats::RunSet historyEnds(const Combination& what, const std::string& scene, const Machine& where,
                          const Size& size, uint32_t firstSeed, size_t runs) {
  SessionConfig config = configOf(what, where, size.width, size.height, firstSeed);
  config.threads = size.threads;
  Session session(sceneNamed(scene), config);
  stats::RunSet set(stats::BlockGrid(size.width, size.height));
  for (size_t run = 0; run < runs; ++run) {
    session.reset(firstSeed + uint32_t(run));
    session.frames(size.frames);
    set.add(session.radiance());
  }
  return set;
}

// By frame 16 the machines have diverged: only their noise may differ.
void expectSameMean(const Combination& what, const std::string& scene, const Machine& where,
                    const Size& size, size_t runs) {
  const stats::RunSet host = historyEnds(what, scene, kCpuBvh, size, 1, runs);
  const stats::RunSet device = historyEnds(what, scene, where, size, 10'000'000, runs);
  const stats::BiasReport report = stats::testBias(device, stats::truthOf(host), {}, [&] {
    return historyEnds(what, scene, where, size, 20'000'000, runs);
  });
  std::printf("  %s, %s, frame %u: %s\n", what.name().c_str(), scene.c_str(), size.frames - 1,
              report.text().c_str());
  std::fflush(stdout);
  EXPECT_FALSE(report.failed()) << scene << ": " << report.text();
  EXPECT_EQ(report.nonfinite, 0u) << scene;
}

// The scene's own kernels take less than half the time of general ones.
void expectSameMeanAtFrame16(const Combination& what) {
  expectSameMean(what, "cornell-box", kVulkanSpecialised, {32, 18, 17, 1}, 32);
}
TEST_P(LargeFramesNightly, Frame32HasTheSameMean) {
  if (combination().cache.empty()) GTEST_SKIP() << kNoHistory;
  expectSameMean(combination(), scenes().front(), kVulkan, {64, 36, 33, 0}, 64);
}

// Validation layers must report nothing for a frame; a message throws.
void expectValidFrame(const Combination& what, const std::string& sceneName, const Machine& where) {
  const auto scene = sceneNamed(sceneName);
  SessionConfig config = configOf(what, where, 32, 18, 3);
  config.validate = true;
  for (const char* how : {"texels", "addresses"}) {
    SCOPED_TRACE(how);
    const Reads reads(how);
    std::unique_ptr<Session> session;
    try {
      session = std::make_unique<Session>(scene, config);
    } catch (const Error& error) {
      if (std::string(error.what()).find("layers are not installed") == std::string::npos) throw;
      std::printf("  not validated: %s\n", error.what());
      return;
    }
    session->frames(3);
    double light = 0.0;
    for (const glm::vec3& p : session->radiance().pixels) light += double(p.x);
    EXPECT_GT(light, 0.0);
    for (const std::string& name : Session::aovNames()) session->aov(name);
    session->reset(4);
    session->frame();
  }
}

// General kernels, on scenes that differ most: area lights alone, reflection and glass, every
// feature at once.
void expectGeneralKernels(const Combination& what) {
  const std::vector<std::string> scenes = {"cornell-box", "glossy-gallery", "everything"};
  expectParity(what, scenes, kVulkan, kCpuBvh, kSmall);
  if (isOfEveryPass(what)) expectValidFrame(what, "everything", kVulkan);
  expectParity(what, scenes, kVulkan, kCpuEmbree, kSmall);
  if (what.integrator == "path" &&
      what.denoiser == "none") {  // closures and shapes are the walker's
    expectParity(what, {"materials", "shapes-file", "hair?strands=40"}, kVulkanSpecialised,
                 kCpuEmbree, kSmall);
    expectSameBitsByBothReads(what, "nurbs-file", kVulkanSpecialised);
  }
  if (!isOfEveryPass(what)) return;
  for (const char* scene : {"everything", "cornell-box"})
    expectSameBitsByBothReads(what, scene, kVulkan);
  // The scene that needs the fewest features.
  expectAsWithoutSpecialisation(what, {"cornell-box"});
}

// The scenes' own kernels, which take a third of the time to compile: reservoirs with and without
// lobes. What they evaluate of a scene is that of the plain path tracer.
void expectReuse(const Combination& what) {
  // Modes differ in weights, not in lobes, rays or reads.
  const bool isUnbiased = what.mode == "unbiased";
  std::vector<std::string> scenes = {"cornell-box"};
  if (isUnbiased) scenes.emplace_back("glossy-gallery");
  expectParity(what, scenes, kVulkanSpecialised, kCpuBvh, kSmall);
  // Shapes as lights, at x1 and at x2.
  if (isUnbiased && what.cache == "pixel")
    expectParity(what, {"shapes-file"}, kVulkanSpecialised, kCpuEmbree, kSmall);
  expectValidFrame(what, "cornell-box", kVulkanSpecialised);
  // Intersectors, reads and histories are those of all methods.
  if (!isUnbiased || what.integrator != bias::kRunsWithAll) return;
  expectParity(what, scenes, kVulkanSpecialised, kCpuEmbree, kSmall);
  expectSameBitsByBothReads(what, "cornell-box", kVulkanSpecialised);
  expectSameMeanAtFrame16(what);
}

TEST_P(Frames, AreThoseOfTheCpu) {
  if (GetParam().cache.empty())
    expectGeneralKernels(GetParam());
  else
    expectReuse(GetParam());
}

TEST_P(FramesNightly, AsOnTheCpuWithTheSameHierarchy) {
  expectParity(GetParam(), sceneNames(), kVulkan, kCpuBvh, kSmall);
}
TEST_P(TracedFramesNightly, AsOnTheCpuWithEmbree) {
  expectParity(GetParam(), sceneNames(), kVulkan, kCpuEmbree, kSmall);
}
TEST_P(TracedFramesNightly, AsWithoutSpecialisation) {
  expectAsWithoutSpecialisation(GetParam(), {"cornell-box", "glass"});
}
TEST_P(TracedFramesNightly, Frame16HasTheSameMean) {
  if (GetParam().cache.empty()) GTEST_SKIP() << kNoHistory;
  expectSameMeanAtFrame16(GetParam());
}
// A scene with all features, and one without most of them.
TEST_P(TracedFramesNightly, ByTexelsAndByAddressesHaveTheSameBits) {
  for (const char* scene : {"everything", "cornell-box"})
    expectSameBitsByBothReads(GetParam(), scene, kVulkanSpecialised);
}
TEST_P(FramesNightly, AreValid) { expectValidFrame(GetParam(), "everything", kVulkan); }

// Several dispatches: errors give a validation message or miss rows of the image.
TEST(LargeFrame, IsValidInSeveralDispatches) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const auto scene = sceneNamed("furnace");
  const auto imageOn = [&](const Machine& where, const char* reads = "addresses") {
    const Reads how(reads);
    SessionConfig config = configOf({"path", "", ""}, where, kLarge.width, kLarge.height, 3);
    config.maxBounces = 1;
    config.validate = std::string(where.backend) == "vulkan";
    Session session(scene, config);
    session.frames(2);
    return session.radiance();
  };
  try {
    const Image cpu = imageOn(kCpuBvh);
    for (const char* reads : {"texels", "addresses"}) {
      SCOPED_TRACE(reads);
      const FrameDifference difference = countDifferent(imageOn(kVulkanSpecialised, reads), cpu);
      EXPECT_LT(difference.share(), kMaxShare) << difference.text();
    }
  } catch (const Error& error) {
    if (std::string(error.what()).find("layers are not installed") == std::string::npos) throw;
    GTEST_SKIP() << error.what();
  }
}

// Index of the instance, which each way of tracing rays reads from another place.
TEST(FirstHitLayers, ObjectsHaveTheSameNumbers) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const auto scene = sceneNamed("courtyard");
  const auto objectsOn = [&](const Machine& where) {
    Session session(scene, configOf({"path", "", ""}, where, 40, 30, 3));
    session.frame();
    return session.aov("object");
  };
  const Image cpu = objectsOn(kCpuEmbree);
  for (const Machine& where : {kCpuBvh, kVulkanSpecialised}) {
    const Image other = objectsOn(where);
    size_t different = 0;
    std::set<float> seen;
    for (size_t i = 0; i < cpu.pixels.size(); ++i) {
      different += other.pixels[i] == cpu.pixels[i] ? 0 : 1;
      seen.insert(other.pixels[i].x);
    }
    EXPECT_LE(different, 2u) << where.name << ": rays past an edge";
    EXPECT_GT(seen.size(), 20u) << where.name;
  }
}

// Returns the classes of differences on one machine.
FrameDifference classesOf(const SessionConfig& left, const SessionConfig& right) {
  const auto scene = sceneNamed("cornell-box");
  Session a(scene, left), b(scene, right);
  a.frame();
  b.frame();
  const FrameDifference result = classify(scene, a, b);
  EXPECT_EQ(result.edges + result.ties + result.later + result.unexplained, result.different);
  return result;
}

TEST(FrameDifference, AnotherDecisionLaterHasTheSameFirstHit) {
  const SessionConfig left = configOf({"path", "", ""}, kCpuBvh, 64, 64, 1);
  SessionConfig right = left;
  EXPECT_EQ(classesOf(left, right).different, 0u);
  right.maxBounces = 2;
  const FrameDifference found = classesOf(left, right);
  EXPECT_GT(found.different, found.pixels / 4);
  EXPECT_EQ(found.later, found.different) << found.text();
}

TEST(FrameDifference, AnotherFirstHitIsNotExplainedWithoutAnEdge) {
  const SessionConfig left = configOf({"path", "", ""}, kCpuBvh, 64, 64, 1);
  SessionConfig right = left;
  right.seed = 2;  // other film samples
  const FrameDifference found = classesOf(left, right);
  EXPECT_GT(found.unexplained, found.pixels / 4) << found.text();
}

const auto kNameOf = [](const auto& test) { return identifier(test.param.name()); };
INSTANTIATE_TEST_SUITE_P(, Frames, testing::ValuesIn(byDay(combinations())), kNameOf);
INSTANTIATE_TEST_SUITE_P(, FramesNightly, testing::ValuesIn(combinations()), kNameOf);
INSTANTIATE_TEST_SUITE_P(, TracedFramesNightly, testing::ValuesIn(unbiasedThatTrace()), kNameOf);
INSTANTIATE_TEST_SUITE_P(, LargeFramesNightly,
                         testing::Combine(kTraced, testing::ValuesIn(nightlyScenes())),
                         [](const auto& test) {
                           return identifier(std::get<0>(test.param).name() + "_" +
                                             std::get<1>(test.param));
                         });

}  // namespace
}  // namespace restlab::parity
