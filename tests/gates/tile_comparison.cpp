#include "tests/gates/tile_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/gates/gate_files.h"

namespace restlab::gates {
namespace {

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values.at(size_t(std::lround(q * double(values.size() - 1))));
}

// Standard error of the mean of the parts' values.
double standardError(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / double(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / double(values.size() - 1) / double(values.size()));
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& tiles) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& t : tiles) sum += t;
  return sum / double(tiles.size());
}

double relativeDifference(double value, double truth) {
  return value == truth ? 0.0 : std::abs(value / truth - 1.0);
}

}  // namespace

std::filesystem::path gateFolder(const std::string& gate) {
  const char* variable = std::getenv("RESTLAB_SCENES");
  const std::filesystem::path root =
      variable != nullptr && *variable != '\0'
          ? std::filesystem::path(variable)
          : std::filesystem::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
  return root / "gates" / gate;
}

std::vector<glm::dvec3> tileMeans(const Image& image, uint32_t tilesPerSide) {
  const uint32_t w = image.width / tilesPerSide, h = image.height / tilesPerSide;
  if (w * tilesPerSide != image.width || h * tilesPerSide != image.height || w == 0 || h == 0) {
    throw std::invalid_argument("tileMeans: the image is no whole number of tiles");
  }
  std::vector<glm::dvec3> means(size_t(tilesPerSide) * tilesPerSide, glm::dvec3(0.0));
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      means[size_t(y / h) * tilesPerSide + x / w] += glm::dvec3(image.at(x, y));
    }
  }
  for (glm::dvec3& m : means) m /= double(w) * double(h);
  return means;
}

Parts renderParts(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
                  uint32_t parts, uint32_t frames) {
  Session session(scene, config);
  Parts result;
  result.mean = Image(config.width, config.height);
  for (uint32_t part = 0; part < parts; ++part) {
    Image image(config.width, config.height);
    session.reset(config.seed + part);
    for (uint32_t i = 0; i < frames; ++i) {
      session.frame();
      for (size_t p = 0; p < image.pixels.size(); ++p) {
        image.pixels[p] += session.radiance().pixels[p] * (1.0f / float(frames));
      }
    }
    for (size_t p = 0; p < image.pixels.size(); ++p) {
      result.mean.pixels[p] += image.pixels[p] * (1.0f / float(parts));
    }
    result.images.push_back(std::move(image));
  }
  return result;
}

TileComparison compareTiles(const Parts& parts, const std::vector<glm::dvec3>& truth) {
  const auto side = uint32_t(std::lround(std::sqrt(double(truth.size()))));
  const std::vector<glm::dvec3> ours = tileMeans(parts.mean, side);
  if (ours.size() != truth.size()) throw std::invalid_argument("compareTiles: other tiles");
  std::vector<std::vector<glm::dvec3>> ofPart;
  for (const Image& image : parts.images) ofPart.push_back(tileMeans(image, side));

  TileComparison result;
  std::vector<double> differences, noise;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> wholes;
    for (const auto& tiles : ofPart) wholes.push_back(meanOf(tiles)[c]);
    result.meanRatio[c] = meanOf(ours)[c] / meanOf(truth)[c];
    result.meanRatioError[c] = standardError(wholes) / meanOf(truth)[c];
    for (size_t t = 0; t < truth.size(); ++t) {
      differences.push_back(relativeDifference(ours[t][c], truth[t][c]));
      std::vector<double> values;
      for (const auto& tiles : ofPart) values.push_back(tiles[t][c]);
      if (ours[t][c] > 0.0) noise.push_back(standardError(values) / ours[t][c]);
    }
  }
  result.p50 = quantile(differences, 0.5);
  result.p90 = quantile(differences, 0.9);
  result.worst = quantile(differences, 1.0);
  result.noise = quantile(noise, 0.5);
  return result;
}

std::string TileComparison::text() const {
  return fmt::format(
      "mean {:+.3f} {:+.3f} {:+.3f} % (standard error {:.3f} %), tiles: median {:.2f} %, p90 "
      "{:.2f} "
      "%, worst {:.2f} % (own noise {:.2f} %)",
      100.0 * (meanRatio.x - 1.0), 100.0 * (meanRatio.y - 1.0), 100.0 * (meanRatio.z - 1.0),
      100.0 * std::max({meanRatioError.x, meanRatioError.y, meanRatioError.z}), 100.0 * p50,
      100.0 * p90, 100.0 * worst, 100.0 * noise);
}

}  // namespace restlab::gates
