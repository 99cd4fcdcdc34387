// The Cornell box: the built-in one against its committed tiles, and two against images of other
// renderers.
#include <fmt/format.h>

#include "core/image/metrics/metrics.h"
#include "tests/analytic/cornell_tiles.h"
#include "tests/bias/independent_runs.h"
#include "tests/gates/gate_files.h"
#include "tests/gates/tile_comparison.h"
#include "experiments/statistics/holm.h"
#include "experiments/statistics/welch.h"

namespace restlab::gates {
namespace {

struct Effort {
  uint32_t side;           // pixels
  uint32_t parts, frames;  // samples per pixel: parts x frames
  int threads;
};

SessionConfig configOf(const Effort& effort, uint32_t maxBounces) {
  SessionConfig config;
  config.width = config.height = effort.side;
  config.maxBounces = maxBounces;
  config.threads = effort.threads;
  config.seed = 1 + bias::seedOffset();
  return config;
}

void expectWithin(const TileComparison& c, double meanBound, double p90Bound) {
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(c.meanRatio[channel], 1.0, meanBound) << "channel " << channel << ": " << c.text();
  }
  EXPECT_LE(c.p90, p90Bound) << c.text();
}

// Compares every tile and channel with the table by Welch's test, with the table's own error.
void expectNoTileDiffers(const Parts& parts) {
  std::vector<std::vector<glm::dvec3>> ofPart;
  for (const Image& image : parts.images) {
    ofPart.push_back(tileMeans(image, analytic::kCornellTilesPerSide));
  }
  const double n = 8.0;  // parts of the table
  std::vector<double> pValues;
  std::vector<std::string> names;
  for (size_t t = 0; t < analytic::cornellTileMeans().size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const double mean = analytic::cornellTileMeans()[t][c];
      // The table has five decimals.
      const double error = std::hypot(analytic::kCornellTileError * mean, 0.5e-5 / std::sqrt(3.0));
      std::vector<double> values;
      for (const auto& tiles : ofPart) values.push_back(tiles[t][c]);
      const stats::WelchResult w =
          stats::welchTest(stats::summarise(values), {n, mean, n * error * error});
      pValues.push_back(w.pValue);
      names.push_back(fmt::format("tile x {} y {} channel {}: {:.6g} beside {:.6g}, t {:.2f}",
                                  t % 8, t / 8, c, mean + w.difference, mean, w.t));
    }
  }
  const std::vector<bool> rejected = stats::holmReject(pValues, 1e-3);
  for (size_t i = 0; i < rejected.size(); ++i) EXPECT_FALSE(rejected[i]) << names[i];
}

void builtinAgainstItsTiles(const Effort& effort, double meanBound) {
  const auto scene = CompiledScene::build(makeBuiltinScene("cornell-box"));
  const Parts parts = renderParts(scene, configOf(effort, analytic::kCornellScatteringEvents),
                                  effort.parts, effort.frames);
  const analytic::TileMeans& table = analytic::cornellTileMeans();
  const TileComparison c = compareTiles(parts, {table.begin(), table.end()});
  std::printf("built-in cornell-box, %ux%u, %u spp: %s\n", effort.side, effort.side,
              effort.parts * effort.frames, c.text().c_str());
  expectWithin(c, meanBound, 0.01);
  expectNoTileDiffers(parts);
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& tile : tileMeans(parts.mean, 8)) mean += tile / 64.0;
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(mean[channel] / analytic::kCornellMean[channel], 1.0, meanBound) << channel;
  }
}

void gateAgainstItsImage(const std::string& gate, const std::string& sceneFile,
                         const std::string& imageFile, uint32_t maxBounces, uint32_t tilesPerSide,
                         const Effort& effort, double meanBound) {
  const auto scene = CompiledScene::build(loadGltf(gateFolder(gate) / sceneFile));
  const Image truth = readExr(gateFolder(gate) / imageFile).layers.at("");
  const Parts parts = renderParts(scene, configOf(effort, maxBounces), effort.parts, effort.frames);
  const TileComparison c = compareTiles(parts, tileMeans(truth, tilesPerSide));
  std::printf("gate %s, %ux%u, %u spp: %s\n", gate.c_str(), effort.side, effort.side,
              effort.parts * effort.frames, c.text().c_str());
  expectWithin(c, meanBound, 0.01);
}

TEST(Gates, BuiltinCornellBox) { builtinAgainstItsTiles({512, 8, 4, 1}, 0.002); }
TEST(Gates, NightlyBuiltinCornellBox) { builtinAgainstItsTiles({512, 16, 64, 0}, 0.001); }

// La Jolla, 1,024 spp, 8 scattering events; pbrt agrees.
TEST(Gates, CornellD8) {
  RESTLAB_NEED_GATE("cornell-d8");
  // Check that the file is the right image: its means are known to five digits.
  const glm::dvec3 mean =
      channelMeans(readExr(gateFolder("cornell-d8") / "reference.exr").layers.at(""));
  const glm::dvec3 stated(0.19590, 0.12730, 0.03641);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], stated[c], 0.5e-5) << "channel " << c;
  gateAgainstItsImage("cornell-d8", "cornell.gltf", "reference.exr", 8, 8, {512, 8, 4, 1}, 0.002);
}
TEST(Gates, NightlyCornellD8) {
  RESTLAB_NEED_GATE("cornell-d8");
  gateAgainstItsImage("cornell-d8", "cornell.gltf", "reference.exr", 8, 8, {512, 16, 64, 0}, 0.001);
}

// Rendered by Tungsten, 64 bounces, 1024 x 1024: 16 x 16 tiles of 64 x 64 pixels.
TEST(Gates, NightlyCornellBoxOfTungsten) {
  RESTLAB_NEED_GATE("cornell-box");
  gateAgainstItsImage("cornell-box", "cornell-box.gltf", "TungstenRender.exr", 64, 16,
                      {1024, 16, 8, 0}, 0.002);
}

}  // namespace
}  // namespace restlab::gates
