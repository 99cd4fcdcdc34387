// `restlab distance-field`: distances to a closed surface, sampled on a grid.
#include <fmt/format.h>

#include <memory>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/distance/distance_grid.h"
#include "core/scene/field/grid_file.h"
#include "core/scene/scene_file/meshes.h"
#include "core/scene/shapes/shape_info.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"

namespace restlab {
namespace {

struct DistanceFieldOptions {
  SceneRequest request;
  std::string output;
  int cells = 64;
};

void logShapes(const Scene& scene) {
  for (const MeshGeometry& geometry : scene.geometries)
    if (geometry.shape)
      logWarning(fmt::format("{}: {} triangles stand in for the shape of kind {}", geometry.name,
                             geometry.triangles.size(), geometry.shape->info->name));
}

SampledGrid sampledDistances(const Scene& scene, const DistanceFieldOptions& options) {
  try {
    return distanceGrid(closedTriangles(scene), options.cells);
  } catch (const Error& error) {
    if (error.code() != ExitCode::badInput) throw;
    failInput(fmt::format("{}: {}", options.request.scene, error.what()));
  }
}

void makeDistanceField(const DistanceFieldOptions& options) {
  checkOutputs({{"-o", options.output, ".vol"}}, options.request);
  checkWritable(options.output);
  const std::string& name = options.request.scene;
  const Scene scene = isSingleMesh(name) ? sceneOfMesh(name) : loadScene(name);
  for (const std::string& warning : scene.warnings) logWarning(warning);
  for (const std::string& note : scene.notes) logInfo(note);
  logShapes(scene);
  const SampledGrid grid = sampledDistances(scene, options);
  const std::vector<uint8_t> bytes = gridBytes(grid);
  writeTextFile(options.output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  print("{}: {} x {} x {} samples, cells of {:g}\n", options.output, grid.samples.x, grid.samples.y,
        grid.samples.z, (grid.high.x - grid.low.x) / double(grid.samples.x - 1));
}

}  // namespace

Action addDistanceFieldVerb(CLI::App& app) {
  auto options = std::make_shared<DistanceFieldOptions>();
  CLI::App* verb = app.add_subcommand(
      "distance-field", "writes the distances to a closed surface as a grid for solids (sdf)");
  verb->add_option("scene", options->request.scene,
                   "an .obj, a .ply, a glTF, Mitsuba or scene file or a built-in scene")
      ->required();
  addSceneSettings(*verb, options->request.scene);
  verb->add_option(
          "--cells", options->cells,
          "cells along the longest edge, two of them around the surface at each end (default 64)")
      ->transform(wholeNumberFrom(kLeastCells, kMostCells))
      ->capture_default_str();
  verb->add_option("-o,--output,--outfile", options->output, "file to write: .vol")->required();
  return [options](Outcome&) { makeDistanceField(*options); };
}

}  // namespace restlab
