// Donors of a pixel: Session::donors() recomputes what the frame did.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 24;

SessionConfig donorsConfig(const ParameterMap& parameters = {}, const std::string& cache = "pixel",
                           const std::string& integrator = "restir_gi") {
  SessionConfig config;
  config.integrator = integrator;
  config.cache = cache;
  config.width = kWidth;
  config.height = kHeight;
  config.threads = 1;
  config.parameters = parameters;
  return config;
}

const ParameterMap kAlone = {{"spatial_neighbours", int64_t{0}}};

// Identifies the sample of a pixel by its film sample and its end. "": no sample.
std::string sampleOf(const Session& session, size_t pixel) {
  std::map<std::string, std::string> values;
  for (const ProbeValue& v : session.probe(uint32_t(pixel % kWidth), uint32_t(pixel / kWidth)))
    values[v.name] = v.value;
  return values["W"] == "0" ? "" : values["film"] + " " + values["end"];
}
std::vector<std::string> samplesOf(const Session& session) {
  std::vector<std::string> samples(size_t{kWidth} * kHeight);
  for (size_t i = 0; i < samples.size(); ++i) samples[i] = sampleOf(session, i);
  return samples;
}
std::vector<Donor> donorsOf(const Session& session, size_t pixel) {
  return session.donors(uint32_t(pixel % kWidth), uint32_t(pixel / kWidth));
}
SceneCamera walked(const CompiledScene& scene, double metres) {
  SceneCamera camera = scene.source().cameras.front();
  for (int i = 0; i < 3; ++i) camera.cameraToWorld[3][i] += metres * camera.cameraToWorld[0][i];
  return camera;
}

// A method and a scene.
class DonorScenes : public testing::TestWithParam<std::pair<const char*, const char*>> {};

// The sample of a pixel after the frame equals the selected donor's sample in a session without
// spatial reuse; confidences add up.
TEST_P(DonorScenes, TheSelectedDonorGaveTheSample) {
  const auto [method, name] = GetParam();
  const auto scene = bias::builtinScene(name);
  Session alone(scene, donorsConfig(kAlone, "pixel", method)),
      session(scene, donorsConfig({}, "pixel", method));
  alone.frame();
  session.frame();
  const std::vector<std::string> before = samplesOf(alone), after = samplesOf(session);
  const Image confidence = session.aov("confidence");
  size_t own = 0, taken = 0, accepted = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const std::vector<Donor> donors = donorsOf(session, i);
    ASSERT_FALSE(donors.empty());
    EXPECT_EQ(donors[0].reuse, "canonical");
    EXPECT_EQ(donors[0].id, i);
    double sum = 0.0, shares = 0.0;
    int selected = 0;
    for (const Donor& donor : donors) {
      EXPECT_TRUE(donor.reuse == "canonical" || donor.reuse == "space") << donor.reuse;
      sum += donor.confidence;
      shares += donor.share.value_or(0.0);
      accepted += donor.shift == "accepted" && donor.reuse == "space";
      EXPECT_EQ(donor.shift == "accepted", donor.share.has_value());
      if (!donor.isSelected) continue;
      ++selected;
      EXPECT_EQ(after[i], before[donor.id]) << i;
      EXPECT_GT(*donor.share, 0.0);
      ++(donor.reuse == "canonical" ? own : taken);
    }
    EXPECT_NEAR(sum, double(confidence.pixels[i].x), 1e-5 * sum) << i;
    EXPECT_EQ(selected, after[i].empty() ? 0 : 1) << i;
    if (selected != 0) {
      EXPECT_NEAR(shares, 1.0, 1e-5) << i;
    }
  }
  EXPECT_GT(own, 50u);
  EXPECT_GT(taken, 50u);
  EXPECT_GT(accepted, taken);
}

// After several rounds the donors are those of the last one. A wrong buffer or other pairs would
// give other confidences.
TEST_P(DonorScenes, ConfidencesAddUpInTheLastRound) {
  const auto [method, name] = GetParam();
  Session session(bias::builtinScene(name),
                  donorsConfig({{"spatial_rounds", int64_t{3}}, {"spatial_neighbours", int64_t{2}}},
                               "pixel", method));
  for (int frame = 0; frame < 2; ++frame) session.frame();
  const Image confidence = session.aov("confidence");
  double most = 0.0;
  for (size_t i = 0; i < confidence.pixels.size(); ++i) {
    double sum = 0.0;
    int selected = 0;
    for (const Donor& donor : donorsOf(session, i)) {
      if (donor.reuse == "time") continue;
      sum += donor.confidence;
      selected += donor.isSelected;
    }
    EXPECT_NEAR(sum, double(confidence.pixels[i].x), 1e-5 * sum) << i;
    EXPECT_EQ(selected, sampleOf(session, i).empty() ? 0 : 1) << i;
    most = std::max(most, sum);
  }
  // One round adds two donors to each pixel at most, three rounds more.
  EXPECT_GT(most, 2.0 * 3.0);
}

// The path of a pixel's sample: x1 is seen through the pixel, and every vertex but the end is where
// a shift traces it again.
TEST_P(DonorScenes, ThePathLeadsFromThePixelToItsEnd) {
  const auto [method, name] = GetParam();
  Session session(bias::builtinScene(name), donorsConfig(kAlone, "pixel", method));
  EXPECT_TRUE(session.path(3, 4).empty());
  session.frame();
  const Image kind = session.aov("kind"), positions = session.aov("positionW");
  const bool replays = std::string(method) == "restir_pt";
  const Image replayed = replays ? session.aov("replayed") : Image(kWidth, kHeight);
  size_t paths = 0, ends = 0, longest = 0;
  for (size_t i = 0; i < kind.pixels.size(); ++i) {
    const auto x = uint32_t(i % kWidth), y = uint32_t(i / kWidth);
    const std::vector<PathVertex> path = session.path(x, y);
    EXPECT_EQ(path.empty(), kind.pixels[i].x == 0.0f) << i;
    if (path.empty()) continue;
    ++paths;
    const PathVertex& x1 = path.front();
    EXPECT_EQ(x1.name, "x1");
    EXPECT_FALSE(x1.isReconnected);
    ASSERT_TRUE(x1.film.has_value());
    EXPECT_NEAR(x1.film->x, float(x) + 0.5f, 0.501f) << i;
    EXPECT_NEAR(x1.film->y, float(y) + 0.5f, 0.501f) << i;
    // This frame's sample is the one whose film sample the layers show.
    EXPECT_LT(glm::length(x1.posW - positions.pixels[i]), 1e-4f) << i;
    const bool isWhole = kind.pixels[i].x == 7.0f;
    EXPECT_EQ(path.size(), 2 + size_t(replayed.pixels[i].x)) << i;
    EXPECT_EQ(path.back().isReconnected, !isWhole) << i;
    for (size_t k = 0; k + 1 < path.size(); ++k) EXPECT_FALSE(path[k].isReconnected) << i;
    if (path.back().isDirection) {
      EXPECT_NEAR(glm::length(path.back().posW), 1.0f, 1e-3f) << i;
    }
    ends += path.back().name == "light" || path.back().name == "environment";
    longest = std::max(longest, path.size());
  }
  EXPECT_GT(paths, kind.pixels.size() / 10);
  EXPECT_GT(ends, 20u);
  EXPECT_EQ(longest > 2, replays);
}

// The layer says of the first donor what the probe says of it.
TEST_P(DonorScenes, TheOutcomeOfAShiftIsThatOfTheProbe) {
  const auto [method, name] = GetParam();
  Session session(bias::builtinScene(name), donorsConfig({}, "pixel", method));
  session.frame();
  const Method of = findMethod(method, "pixel", "none");
  const auto layers = of.layers();
  const auto layer = std::find_if(layers.begin(), layers.end(), [](const LayerInfo* one) {
    return one->name == "shift_outcome";
  });
  ASSERT_NE(layer, layers.end());
  const Image outcome = session.aov("shift_outcome"), partner = session.aov("partner");
  size_t compared = 0, failed = 0;
  for (size_t i = 0; i < outcome.pixels.size(); ++i) {
    EXPECT_EQ(outcome.pixels[i].x == 0.0f, partner.pixels[i].x == 0.0f) << i;
    if (outcome.pixels[i].x == 0.0f) continue;
    const std::vector<Donor> donors = donorsOf(session, i);
    ASSERT_GT(donors.size(), 1u);
    EXPECT_EQ((*layer)->wordsOf(outcome.pixels[i].x), donors[1].shift) << i;
    ++compared;
    failed += donors[1].shift != "accepted";
  }
  EXPECT_GT(compared, 100u);
  EXPECT_GT(failed, 5u);
}

// Frames without donors leave nothing to read: the memory of the shifts is the last frame's
// G-buffer.
TEST(Donors, WithoutDonorsAShiftHasNoOutcome) {
  const auto scene = bias::builtinScene("cornell-box");
  Session session(scene, donorsConfig({{"young_frames", 0.0}, {"aged_neighbours", int64_t{0}}}));
  session.frame();
  session.setCamera(walked(*scene, 0.1));
  session.frame();
  for (const glm::vec3& number : session.aov("shift_outcome").pixels) ASSERT_EQ(number.x, 0.0f);
}

// Old histories have another number of donors, with a share of their confidence.
TEST_P(DonorScenes, ConfidencesAddUpInOldHistories) {
  const auto [method, name] = GetParam();
  Session session(
      bias::builtinScene(name),
      donorsConfig({{"young_frames", 3.0}, {"aged_neighbours", int64_t{1}}}, "pixel", method));
  for (int frame = 0; frame < 8; ++frame) session.frame();
  const Image confidence = session.aov("confidence");
  for (size_t i = 0; i < confidence.pixels.size(); ++i) {
    double sum = 0.0, own = 0.0;
    size_t space = 0;
    for (const Donor& donor : donorsOf(session, i)) {
      if (donor.reuse != "time") sum += donor.confidence;
      if (donor.reuse == "canonical") own = donor.confidence;
      space += donor.reuse == "space";
      if (donor.reuse != "time") continue;
      EXPECT_EQ(donor.id, i);
      EXPECT_NEAR(donor.confidence, own - 1.0, 1e-5);
      EXPECT_NEAR(*donor.misWeight, donor.confidence / own, 1e-5);
    }
    EXPECT_LE(space, 1u);
    EXPECT_NEAR(sum, double(confidence.pixels[i].x), 1e-5 * sum) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scene, DonorScenes,
    testing::Values(std::pair{"restir_gi", "door-ajar"}, std::pair{"restir_gi", "glossy-gallery"},
                    std::pair{"restir_gi", "courtyard"}, std::pair{"restir_di", "courtyard"},
                    std::pair{"restir_pt", "glossy-gallery"}),
    [](const auto& test) {
      std::string name = std::string(test.param.first) + "_" + test.param.second;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

class DonorsOf : public testing::TestWithParam<const char*> {};

// Without spatial reuse a pixel's sample after the frame comes from the temporal donor or is its
// own; if the camera has moved, that donor is another pixel.
TEST_P(DonorsOf, TimeAreThePixelsThatShowedTheSurface) {
  const auto scene = bias::builtinScene("cornell-box");
  for (const double moved : {0.0, 0.2}) {
    Session session(scene, donorsConfig(kAlone, "pixel", GetParam()));
    for (int frame = 0; frame < 3; ++frame) session.frame();
    const std::vector<std::string> before = samplesOf(session);
    session.setCamera(walked(*scene, moved));
    session.frame();
    const std::vector<std::string> after = samplesOf(session);
    size_t found = 0, selected = 0, elsewhere = 0;
    double expected = 0.0, variance = 0.0;
    for (size_t i = 0; i < after.size(); ++i) {
      for (const Donor& donor : donorsOf(session, i)) {
        if (donor.reuse != "time") continue;
        ++found;
        elsewhere += donor.id != i;
        selected += donor.isSelected;
        EXPECT_EQ(donor.isSelected, !after[i].empty() && after[i] == before[donor.id]) << i;
        EXPECT_NEAR(donor.confidence, 3.0, 1e-5);
        const double share = donor.share.value_or(0.0);
        expected += share;
        variance += share * (1.0 - share);
        if (share > 0.999) {
          EXPECT_TRUE(donor.isSelected) << i;
        }
        if (share < 1e-4) {
          EXPECT_FALSE(donor.isSelected) << i;
        }
      }
    }
    EXPECT_GT(found, after.size() / 2);
    EXPECT_GT(selected, found / 4);
    // A donor's share is its probability of being selected.
    EXPECT_LT(std::abs(double(selected) - expected), 4.0 * std::sqrt(variance));
    EXPECT_GT(variance, 20.0);
    if (moved == 0.0) {
      EXPECT_EQ(elsewhere, 0u);
    }
    if (moved != 0.0) {
      EXPECT_GT(elsewhere, found / 4);
    }
  }
}

TEST_P(DonorsOf, EntriesAreInTheCache) {
  const auto scene = bias::builtinScene("door-ajar");
  Session session(scene, donorsConfig(kAlone, "voxel", GetParam()));
  for (int frame = 0; frame < 4; ++frame) session.frame();
  session.setCamera(walked(*scene, 0.2));
  session.frame();
  const Image confidence = session.aov("confidence");
  size_t found = 0, selected = 0;
  for (size_t i = 0; i < confidence.pixels.size(); ++i) {
    double sum = 1.0;
    for (const Donor& donor : donorsOf(session, i)) {
      if (donor.reuse == "canonical") continue;
      sum += donor.confidence;
      if (donor.reuse != "entry") continue;
      ++found;
      selected += donor.isSelected;
      EXPECT_GE(donor.confidence, 0.0);
      EXPECT_LE(donor.share.value_or(0.0), 1.0 + 1e-3) << i;
      if (donor.isSelected) {
        EXPECT_GT(donor.share.value_or(0.0), 0.0) << i;
      }
    }
    EXPECT_NEAR(sum, double(confidence.pixels[i].x), 1e-4 * sum) << i;
  }
  EXPECT_GT(found, confidence.pixels.size() / 4);
  EXPECT_GT(selected, 20u);
}

INSTANTIATE_TEST_SUITE_P(Method, DonorsOf, testing::Values("restir_gi", "restir_di", "restir_pt"),
                         [](const auto& test) { return std::string(test.param); });

std::map<std::string, size_t> shiftsOf(const char* scene, const ParameterMap& parameters,
                                       const std::string& method = "restir_gi") {
  Session session(bias::builtinScene(scene), donorsConfig(parameters, "pixel", method));
  session.frame();
  std::map<std::string, size_t> counts;
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    for (const Donor& donor : donorsOf(session, i)) counts[donor.shift] += donor.reuse == "space";
  }
  return counts;
}

// Makes each test of a shift fail, by a parameter or a scene.
TEST(Donors, SayWhichTestFailed) {
  const ParameterMap far = {{"normal_threshold", -1.0}, {"plane_threshold", 10.0}};
  const auto with = [&](const char* name, double value) {
    ParameterMap parameters = far;
    parameters[name] = value;
    return parameters;
  };
  auto door = shiftsOf("door-ajar", far);
  EXPECT_GT(door["occluded"], 20u);
  EXPECT_GT(door["empty"], 20u);
  EXPECT_GT(door["dark"], 0u);
  EXPECT_EQ(door["smooth"] + door["background"], 0u);
  EXPECT_GT(shiftsOf("door-ajar", with("max_jacobian", 1.01))["jacobian"], 2 * door["jacobian"]);
  // Some vertices are seen edge-on and fail with any bound.
  EXPECT_LT(shiftsOf("door-ajar", with("max_jacobian", 1.0e6))["jacobian"], door["jacobian"]);
  EXPECT_GT(shiftsOf("courtyard", far)["background"], 0u);
  // Mirrors are smooth with any limit.
  EXPECT_GT(shiftsOf("glossy-gallery", with("roughness_limit", 0.3))["smooth"],
            2 * shiftsOf("glossy-gallery", with("roughness_limit", 0.0))["smooth"]);
}

// A replayed prefix fails in more ways.
TEST(Donors, SayWhereAReplayFailed) {
  auto gallery = shiftsOf("glossy-gallery", {}, "restir_pt");
  for (const char* reason : {"replay", "connects earlier", "pair", "jacobian", "occluded"})
    EXPECT_GT(gallery[reason], 5u) << reason;
  EXPECT_EQ(gallery["entry"], 0u);
  auto reconnected =
      shiftsOf("glossy-gallery", {{"shift", std::string("reconnection")}}, "restir_pt");
  EXPECT_EQ(reconnected["connects earlier"] + reconnected["pair"], 0u);
}

TEST(Donors, AskingChangesNoBit) {
  const auto scene = bias::builtinScene("glossy-gallery");
  Session asked(scene, donorsConfig()), other(scene, donorsConfig());
  EXPECT_TRUE(asked.donors(3, 4).empty());
  for (int frame = 0; frame < 4; ++frame) {
    asked.frame();
    other.frame();
    EXPECT_FALSE(asked.donors(3, 4).empty());
    asked.aov("rejected_shifts");
    EXPECT_EQ(countDifferent(asked.radiance(), other.radiance()), 0u);
  }
  EXPECT_THROW(asked.donors(kWidth, 0), Error);
  SessionConfig path = donorsConfig();
  path.integrator = "path";
  path.cache = "";
  Session without(scene, path);
  without.frame();
  EXPECT_TRUE(without.donors(0, 0).empty());
}

// Donors use the parameters of the shown frame, not those set for the next one.
TEST(Donors, AreThoseOfTheFrameThatIsShown) {
  Session session(bias::builtinScene("door-ajar"), donorsConfig({{"young_frames", 100.0}}));
  for (int frame = 0; frame < 3; ++frame) session.frame();
  const auto count = [&] {
    size_t sum = 0;
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) sum += donorsOf(session, i).size();
    return sum;
  };
  const size_t before = count();
  const Image layer = session.aov("rejected_shifts");
  EXPECT_FALSE(session.setParameters({{"young_frames", 0.0}, {"aged_neighbours", int64_t{0}}}));
  EXPECT_EQ(count(), before);
  EXPECT_EQ(countDifferent(session.aov("rejected_shifts"), layer), 0u);
}

TEST(DonorLayers, AreWhatTheDonorsSay) {
  const auto scene = bias::builtinScene("door-ajar");
  Session session(scene, donorsConfig());
  for (int frame = 0; frame < 2; ++frame) session.frame();
  const Image rejected = session.aov("rejected_shifts"), partner = session.aov("partner");
  std::map<float, std::vector<size_t>> pairs;
  size_t some = 0;
  for (size_t i = 0; i < rejected.pixels.size(); ++i) {
    double shifts = 0.0, failed = 0.0;
    std::set<size_t> others;
    for (const Donor& donor : donorsOf(session, i)) {
      if (donor.reuse != "space") continue;
      others.insert(donor.id);
      shifts += donor.shift != "empty";
      failed += donor.shift != "empty" && donor.shift != "accepted";
    }
    EXPECT_NEAR(double(rejected.pixels[i].x), shifts > 0.0 ? failed / shifts : 0.0, 1e-6) << i;
    some += failed > 0.0;
    const float pair = partner.pixels[i].x;
    EXPECT_EQ(partner.pixels[i], glm::vec3(pair));
    if (pair == 0.0f) continue;
    pairs[pair].push_back(i);
    const auto lower = size_t(pair) - 1;
    EXPECT_TRUE(lower == i || others.contains(lower)) << i;
  }
  EXPECT_GT(some, 50u);
  EXPECT_GT(pairs.size(), 100u);
  for (const auto& [name, pixels] : pairs) EXPECT_EQ(pixels.size(), 2u) << name;
}

// Mirrors of the gallery are replayed, and the probe says the same as the image.
TEST(DonorLayers, SayWhatIsReplayed) {
  Session session(bias::builtinScene("glossy-gallery"), donorsConfig({}, "pixel", "restir_pt"));
  session.frame();
  const Image replayed = session.aov("replayed"), kind = session.aov("kind");
  size_t some = 0, whole = 0;
  for (size_t i = 0; i < replayed.pixels.size(); ++i) {
    std::map<std::string, std::string> values;
    for (const ProbeValue& v : session.probe(uint32_t(i % kWidth), uint32_t(i / kWidth)))
      values[v.name] = v.value;
    if (values["W"] == "0") {
      EXPECT_EQ(kind.pixels[i].x, 0.0f) << i;
      continue;
    }
    EXPECT_EQ(fmt::format("{}", replayed.pixels[i].x + 2.0f), values["k"]) << i;
    EXPECT_EQ(kind.pixels[i].x == 7.0f, values["kind"] == "replayed as a whole") << i;
    some += replayed.pixels[i].x > 0.0f;
    whole += kind.pixels[i].x == 7.0f;
  }
  EXPECT_GT(some, 20u);
  EXPECT_GT(whole, 0u);
}

TEST(DonorLayers, HaveTheSameBitsForAnyNumberOfThreads) {
  const auto scene = bias::builtinScene("glossy-gallery");
  SessionConfig config = donorsConfig();
  Session one(scene, config);
  config.threads = 5;
  Session many(scene, config);
  for (int frame = 0; frame < 3; ++frame) {
    one.frame();
    many.frame();
  }
  for (const char* layer : {"rejected_shifts", "partner"})
    EXPECT_EQ(countDifferent(one.aov(layer), many.aov(layer)), 0u) << layer;
}

TEST(DonorLayers, AreZeroWithoutReuseOverSpace) {
  Session session(bias::builtinScene("cornell-box"),
                  donorsConfig({{"aged_neighbours", int64_t{0}}, {"young_frames", 0.0}}));
  for (int frame = 0; frame < 3; ++frame) session.frame();
  for (const char* layer : {"rejected_shifts", "partner"}) {
    for (const glm::vec3& value : session.aov(layer).pixels) ASSERT_EQ(value, glm::vec3(0.0f));
  }
}

}  // namespace
}  // namespace restlab::conformance
