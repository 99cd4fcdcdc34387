#include "tests/gates/known_pixels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "experiments/statistics/holm.h"
#include "experiments/statistics/welch.h"
#include "tests/bias/independent_runs.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab::gates {
namespace {

constexpr double kFamilyError = 1e-3;
constexpr uint32_t kFirstSeeds = 30'000'000, kSecondSeeds = 40'000'000;

// Means of pixels and, at the end, of the whole image, by runs: [3 i + channel][run].
using Observations = std::vector<std::vector<double>>;

// Judges only pixels that have a truth.
std::vector<glm::dvec3> pixelsOf(const KnownScene& scene, const PixelTruth& truth) {
  std::vector<glm::dvec3> pixels;
  for (uint32_t y = 0; y < scene.height; ++y)
    for (uint32_t x = 0; x < scene.width; ++x) pixels.push_back(truth(x, y));
  return pixels;
}

bool isJudged(const glm::dvec3& pixel) { return !std::isnan(pixel.x + pixel.y + pixel.z); }

glm::dvec3 wholeOf(const std::vector<glm::dvec3>& pixels, const std::vector<glm::dvec3>& mask) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (size_t p = 0; p < pixels.size(); ++p) {
    if (!isJudged(mask[p])) continue;
    sum += pixels[p];
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

Observations observe(const std::shared_ptr<const CompiledScene>& compiled, const KnownScene& scene,
                     const std::vector<glm::dvec3>& mask, uint32_t firstSeed) {
  bias::Method method = bias::pathMethod(scene.frames);
  method.config.width = scene.width;
  method.config.height = scene.height;
  method.config.maxBounces = compiled->source().maxBounces.value_or(scene.bounces);
  Observations all(3 * (mask.size() + 1));
  bias::forEachRun(compiled, method, firstSeed, scene.runs, [&](const Image& image) {
    std::vector<glm::dvec3> pixels;
    for (const glm::vec3& pixel : image.pixels) pixels.emplace_back(pixel);
    pixels.push_back(wholeOf(pixels, mask));
    for (size_t i = 0; i < all.size(); ++i) all[i].push_back(pixels[i / 3][int(i % 3)]);
  });
  return all;
}

struct Verdict {
  std::vector<int> side;     // of what is rejected: 1 brighter than the truth, -1 darker, else 0
  size_t judged = 0;         // pixels
  double furthest = 0.0;     // largest |t|
  double medianError = 0.0;  // relative, of pixels that are not black
  std::string worst;         // the furthest in words
};

Verdict judge(const Observations& observed, const std::vector<glm::dvec3>& truth,
              const KnownScene& scene) {
  Verdict verdict;
  std::vector<double> pValues, errors;
  std::vector<size_t> members;
  verdict.side.assign(observed.size(), 0);
  std::vector<glm::dvec3> all = truth;
  all.push_back(wholeOf(truth, truth));
  for (size_t i = 0; i < observed.size(); ++i) {
    if (!isJudged(all[i / 3])) continue;
    if (i % 3 == 0 && i / 3 < truth.size()) ++verdict.judged;
    const double known = all[i / 3][int(i % 3)];
    stats::Sample sample = stats::summarise(observed[i]);
    const double rounding = scene.rounding * std::max(std::abs(known), std::abs(sample.mean));
    sample.variance += sample.n * rounding * rounding;
    const stats::WelchResult w = stats::welchTest(sample, {1.0, known, 0.0});
    const bool isBlack = w.difference == 0.0 && w.standardError == 0.0;
    pValues.push_back(isBlack ? 1.0 : w.pValue);
    members.push_back(i);
    verdict.side[i] = w.difference > 0.0 ? 1 : -1;
    if (known > 0.0) errors.push_back(w.standardError / known);
    if (isBlack || !(std::abs(w.t) > verdict.furthest)) continue;
    verdict.furthest = std::abs(w.t);
    const size_t pixel = i / 3;
    verdict.worst =
        fmt::format("{} channel {}: {:.6g} beside {:.6g}, t {:.2f}",
                    pixel < truth.size()
                        ? fmt::format("pixel x {} y {}", pixel % scene.width, pixel / scene.width)
                        : std::string("whole image"),
                    i % 3, sample.mean, known, w.t);
  }
  const std::vector<bool> isRejected = stats::holmReject(pValues, kFamilyError);
  for (size_t m = 0; m < members.size(); ++m)
    if (!isRejected[m]) verdict.side[members[m]] = 0;
  for (size_t i = 0; i < observed.size(); ++i)
    if (!isJudged(all[i / 3])) verdict.side[i] = 0;
  std::sort(errors.begin(), errors.end());
  if (!errors.empty()) verdict.medianError = errors[errors.size() / 2];
  return verdict;
}

size_t countOf(const Verdict& verdict) {
  return size_t(verdict.side.size()) -
         size_t(std::count(verdict.side.begin(), verdict.side.end(), 0));
}

// Counts the rejections of both batches on the same side.
size_t confirmed(const Verdict& first, const Verdict& second) {
  size_t count = 0;
  for (size_t i = 0; i < first.side.size(); ++i)
    count += first.side[i] != 0 && first.side[i] == second.side[i];
  return count;
}

}  // namespace

void expectPixels(const KnownScene& scene, const PixelTruth& truth,
                  const std::vector<WrongTruth>& wrong) {
  test::MitsubaFolder folder;
  for (const auto& [name, bytes] : scene.files) folder.write(name, bytes);
  const auto compiled = CompiledScene::build(folder.load(scene.xml));
  EXPECT_EQ(compiled->source().cameras.at(0).film, glm::uvec2(scene.width, scene.height))
      << scene.name;
  const std::vector<glm::dvec3> right = pixelsOf(scene, truth);
  const Observations first = observe(compiled, scene, right, kFirstSeeds);
  std::optional<Observations> second;
  const auto again = [&]() -> const Observations& {
    if (!second) second = observe(compiled, scene, right, kSecondSeeds);
    return *second;
  };
  const Verdict verdict = judge(first, right, scene);
  EXPECT_GE(verdict.judged, right.size() / 4) << scene.name;
  const size_t alarms = countOf(verdict);
  const size_t rejected = alarms > 0 ? confirmed(verdict, judge(again(), right, scene)) : 0;
  EXPECT_EQ(rejected, 0u) << scene.name << ": " << verdict.worst;
  std::string line = fmt::format(
      "gate Mitsuba {}: {} pixels, median standard error {:.2f} %, largest |t| {:.2f}, rejected "
      "{} ({} confirmed)",
      scene.name, verdict.judged, 100.0 * verdict.medianError, verdict.furthest, alarms, rejected);
  for (const WrongTruth& w : wrong) {
    const std::vector<glm::dvec3> pixels = pixelsOf(scene, w.pixel);
    const Verdict found = judge(first, pixels, scene);
    const size_t caught = countOf(found) > 0 ? confirmed(found, judge(again(), pixels, scene)) : 0;
    EXPECT_GT(caught, 0u) << scene.name << ", wrong truth: " << w.name;
    line += fmt::format("; {}: {}", w.name, caught);
  }
  std::printf("%s\n", line.c_str());
}

glm::dvec3 TheirCamera::through(double x, double y) const {
  return ahead + left * (halfWidth * (1.0 - 2.0 * x / width)) +
         up * (halfWidth * (height - 2.0 * y) / width);
}

TheirCamera lookingAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                      double fov, const KnownScene& scene) {
  TheirCamera camera;
  camera.origin = origin;
  camera.ahead = glm::normalize(target - origin);
  camera.left = glm::normalize(glm::cross(up, camera.ahead));
  camera.up = glm::cross(camera.ahead, camera.left);
  camera.halfWidth = std::tan(fov * std::numbers::pi / 360.0);
  camera.width = scene.width;
  camera.height = scene.height;
  return camera;
}

std::string sensorXml(const std::string& origin, const std::string& target, const std::string& up,
                      double fov, const KnownScene& scene) {
  return fmt::format(
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"{}\"/>"
      "<transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" up=\"{}\"/></transform>"
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/>"
      "<integer name=\"height\" value=\"{}\"/></film></sensor>\n",
      fov, origin, target, up, scene.width, scene.height);
}

PixelTruth meanOver(const TheirCamera& camera,
                    std::function<glm::dvec3(const glm::dvec3& origin, const glm::dvec3& dir)> of) {
  return [camera, of = std::move(of)](uint32_t x, uint32_t y) {
    constexpr std::array<double, 4> kAt{0.06943184420297371, 0.33000947820757187,
                                        0.66999052179242813, 0.93056815579702629},
        kWeight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j)
        sum += kWeight[i] * kWeight[j] *
               of(camera.origin, glm::normalize(camera.through(x + kAt[i], y + kAt[j])));
    return sum;
  };
}

double overlap(uint32_t i, double low, double high) {
  return std::max(0.0, std::min(double(i) + 1.0, high) - std::max(double(i), low));
}

glm::dvec3 floorOf(const glm::dvec3& origin, const glm::dvec3& dir) {
  return origin - dir * (origin.y / dir.y);
}

}  // namespace restlab::gates
