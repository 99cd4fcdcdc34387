#include "experiments/cli/bsdf_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "experiments/bsdf/simulate.h"
#include "experiments/bsdf/tested_material.h"
#include "experiments/runner/base/print.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

constexpr glm::uvec3 kDirectionSizes{64u, 64u, 64u};
constexpr glm::uvec3 kSimulatedSizes{32u, 32u, 32u};

glm::uvec3 sizesOf(const BsdfOptions& options, const glm::uvec3& fallback) {
  if (options.sizes.empty()) return fallback;
  const glm::uvec3 sizes(options.sizes[0], options.sizes[1], options.sizes[2]);
  const uint64_t cells = uint64_t(sizes.x) * sizes.y * sizes.z;
  if (cells > kMaxTableCells)
    failUsage(fmt::format("--sizes {},{},{}: {} cells; at most {} are supported", sizes.x, sizes.y,
                          sizes.z, cells, kMaxTableCells));
  return sizes;
}

void requireEqualAngles(const glm::uvec3& sizes) {
  if (sizes.x != sizes.y)
    failUsage(
        fmt::format("--sizes {},{},{}: the first two are the angles of wo and wi; equal "
                    "numbers expected",
                    sizes.x, sizes.y, sizes.z));
}

double luminance(const glm::vec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; }

}  // namespace

void addTableOptions(CLI::App& verb, BsdfOptions& options) {
  verb.add_option("--tabulate", options.tabulate,
                  "write the BRDF of the kind as a table: .binary (MERL's format) or .exr");
  verb.add_option("--angles", options.angles, "axes of an .exr: half vectors, or directions")
      ->check(CLI::IsMember({"half", "directions"}))
      ->capture_default_str();
  verb.add_option("--sizes", options.sizes,
                  "cells along the three axes of an .exr (default: 90,90,180; 64,64,64; simulated "
                  "32,32,32)")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(2u, kMaxTableSide));
  verb.add_option("--simulate", options.simulate,
                  "EXR of heights: rays through them become a table, -o FILE.exr; --samples for "
                  "each angle");
  verb.add_option("--base", options.base, "what the facets of --simulate are made of")
      ->check(CLI::IsMember({"lambert", "mirror"}))
      ->capture_default_str();
  verb.add_option("--albedo", options.albedo, "of these facets")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb.add_option("--spacing", options.spacing, "of two heights, in the unit of the heights")
      ->check(CLI::Range(1e-9, 1e9))
      ->capture_default_str();
  verb.add_option("--bounces", options.bounces, "scattering events that --simulate follows")
      ->check(CLI::Range(1u, 10'000u))
      ->capture_default_str();
}

void writeTable(const BsdfOptions& options) {
  const fs::path file = options.tabulate;
  const std::string extension = file.extension().string();
  if (extension != ".binary" && extension != ".exr")
    failUsage(
        fmt::format("--tabulate {}: .binary (MERL's format) or .exr expected", file.string()));
  if (extension == ".binary" && (options.angles != "half" || !options.sizes.empty()))
    failUsage(
        "--tabulate FILE.binary: MERL's format has 90 x 90 x 180 half vectors; --angles and "
        "--sizes go with an .exr");
  const bool isHalf = options.angles == "half";
  const glm::uvec3 sizes = sizesOf(options, isHalf ? kMerlSizes : kDirectionSizes);
  if (!isHalf) requireEqualAngles(sizes);
  checkWritable(file);
  const ClosureTable table = tabulated(testedMaterial(options.kind, options.settings),
                                       isHalf ? TableAngles::half : TableAngles::directions, sizes);
  if (extension == ".exr") {
    writeTableExr(file, table);
  } else {
    writeMerl(file, table);
  }
  print("{}: {} x {} x {} values of {}\n", file.string(), sizes.x, sizes.y, sizes.z, options.kind);
}

void simulateTable(const BsdfOptions& options) {
  if (!options.kind.empty() || !options.settings.empty() || !options.tabulate.empty())
    failUsage("bsdf --simulate: its facets are --base's: no kind, --set or --tabulate");
  const fs::path file = options.output;
  if (file.extension() != ".exr") failUsage("bsdf --simulate: -o FILE.exr expected, the table");
  const LayeredImage image = readExr(options.simulate, {ExrLayers::all});
  SimulationConfig config;
  config.base = options.base == "mirror" ? FacetBase::mirror : FacetBase::lambert;
  config.albedo = options.albedo;
  config.bounces = options.bounces;
  config.samples = options.samples;
  config.sizes = sizesOf(options, kSimulatedSizes);
  requireEqualAngles(config.sizes);
  checkWritable(file);
  const HeightField field{image.layers.begin()->second, options.spacing};
  const Simulation result = atPlace(options.simulate, [&] { return simulateBrdf(field, config); });
  writeTableExr(file, result.table);
  const glm::uvec3& n = config.sizes;
  print("{}: {} x {} x {} values, {} rays for each of {} angles\n", file.string(), n.x, n.y, n.z,
        config.samples, n.x);
  print(
      "  slope {:.4g} (root mean square; alpha of Beckmann's facets where heights are Gaussian)\n",
      result.slope);
  print(
      "  from the normal: f {:.4g} per sr to the mirrored direction; {:.3g} of all rays were not "
      "out after {} events\n",
      luminance(result.table.at(0, 0, 0)), result.absorbed, config.bounces);
  if (result.lostRays > 0)
    print("  {} rays fell through seams of the triangles: not counted\n", result.lostRays);
}

}  // namespace restlab
