#include "experiments/cli/bench_first_hits.h"

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/bench/first_hits.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/print.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::array<uint32_t, 2>, 4> kSizes = {
    {{320, 180}, {640, 360}, {1280, 720}, {1920, 1080}}};

// Times both ways in turn: the machine may be busy.
Json rowOf(FirstHits& hits, const std::array<uint32_t, 2>& size, double seconds) {
  using Clock = std::chrono::steady_clock;
  hits.byRays();
  const std::vector<glm::uvec4> ofRays = hits.hits();
  hits.byRaster();
  const HitAgreement agreement = agreementOf(ofRays, hits.hits());
  std::vector<double> rays, raster;
  const auto begin = Clock::now();
  do {
    throwIfInterrupted("the benchmark is not finished");
    rays.push_back(hits.byRays());
    raster.push_back(hits.byRaster());
  } while (rays.size() < 5 ||
           std::chrono::duration<double>(Clock::now() - begin).count() < 2.0 * seconds);
  std::vector<double> ratios;
  for (size_t i = 0; i < rays.size(); ++i) ratios.push_back(rays[i] / raster[i]);
  return {{"width", size[0]},
          {"height", size[1]},
          {"rays_ms", median(rays)},
          {"raster_ms", median(raster)},
          {"rays_over_raster", median(ratios)},
          {"rays_over_raster_range", {percentile(ratios, 0.05), percentile(ratios, 0.95)}},
          {"same_primitive", agreement.share()},
          {"same_instance", double(agreement.sameInstance) / double(agreement.pixels)}};
}

}  // namespace

void benchFirstHits(const PreparedScene& prepared, const SessionConfig& config, double seconds,
                    bool asJson) {
  const BackendOptions options{config.threads, config.device, config.rayTracing, config.validate};
  const SceneCamera& camera = prepared.scene->source().cameras[config.camera];
  Json rows = Json::array();
  std::string device;
  for (const std::array<uint32_t, 2>& size : kSizes) {
    FirstHits hits(prepared.scene, config.backend, options, camera, {size[0], size[1]});
    device = hits.device();
    rows.push_back(rowOf(hits, size, seconds));
  }
  const Json json = {{"scene", prepared.scene->source().name},
                     {"triangles", prepared.scene->instancedTriangleCount()},
                     {"backend", config.backend},
                     {"device", device},
                     {"machine", machineJson()},
                     {"build", buildJson()},
                     {"sizes", rows}};
  if (asJson) return printJsonText(json.dump(2));
  print("{}, {} triangles, {}: first hits at pixel centres; {}\n\n",
        json["scene"].get<std::string>(), prepared.scene->instancedTriangleCount(), config.backend,
        device);
  print("{:<10} {:>9} {:>10} {:>12} {:>14} {:>15}\n", "image", "rays, ms", "raster, ms",
        "rays/raster", "5 to 95 %", "same triangle");
  for (const Json& row : rows) {
    print("{:<10} {:>9.2f} {:>10.2f} {:>12.2f} {:>6.2f} to {:<5.2f} {:>13.3f} %\n",
          fmt::format("{}x{}", row["width"].get<uint32_t>(), row["height"].get<uint32_t>()),
          row["rays_ms"].get<double>(), row["raster_ms"].get<double>(),
          row["rays_over_raster"].get<double>(), row["rays_over_raster_range"][0].get<double>(),
          row["rays_over_raster_range"][1].get<double>(),
          100.0 * row["same_primitive"].get<double>());
  }
}

}  // namespace restlab
