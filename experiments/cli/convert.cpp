// `restlab convert`: a scene as glTF.
#include <fmt/format.h>

#include <memory>

#include "core/scene/gltf_write/gltf_write.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"

namespace restlab {
namespace {

struct ConvertOptions {
  SceneRequest request;
  std::string output;
};

void convert(const ConvertOptions& options) {
  checkOutputs({{"-o", options.output, ".gltf"}}, options.request);
  const Scene scene = loadScene(options.request.scene);
  for (const std::string& warning : scene.warnings) logWarning(warning);
  for (const std::string& note : scene.notes) logInfo(note);
  for (const std::string& note : writeGltf(scene, options.output)) logWarning(note);
  print("{}: {} meshes, {} instances, {} materials, {} textures\n", options.output,
        scene.geometries.size(), scene.instances.size(), scene.materials.size(),
        scene.images.size());
}

}  // namespace

Action addConvertVerb(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* verb = app.add_subcommand("convert", "writes a scene as glTF 2.0");
  verb->add_option("scene", options->request.scene,
                   "a glTF, Mitsuba or scene file or a built-in scene")
      ->required();
  addSceneSettings(*verb, options->request.scene);
  verb->add_option("-o,--output,--outfile", options->output, "glTF file to write (.gltf)")
      ->required();
  return [options](Outcome&) { convert(*options); };
}

}  // namespace restlab
