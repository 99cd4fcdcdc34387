// `restlab convert`: a scene as glTF, or its materials as a scene file.
#include <fmt/format.h>

#include <memory>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/gltf_write/gltf_write.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/scene/scene_write/scene_write.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"

namespace restlab {
namespace {

struct ConvertOptions {
  SceneRequest request;
  std::string output;
};

void writeSceneFile(const Scene& scene, const std::string& output) {
  const SceneFileText file =
      sceneFileOf(scene, baseNameOf(scene, std::filesystem::path(output).parent_path()));
  writeTextFile(output, file.text);
  print("{}: {} materials, {} more in comments\n", output, file.named, file.commentary);
}

// Folders, stems and bases name files, too, that the scene is made from.
void requireOtherFile(const Scene& scene, const std::string& output) {
  for (const std::filesystem::path& file : filesOfScene(scene))
    if (resolvedPath(file) == resolvedPath(output))
      failUsage(fmt::format("-o {}: is a file that the scene is made from; give it another name",
                            output));
}

void convert(const ConvertOptions& options) {
  const bool isToml = isSceneFile(options.output);
  checkOutputs({{"-o", options.output, isToml ? ".toml" : ".gltf", ", or *.scene.toml"}},
               options.request);
  const Scene scene = loadScene(options.request.scene);
  for (const std::string& warning : scene.warnings) logWarning(warning);
  for (const std::string& note : scene.notes) logInfo(note);
  requireOtherFile(scene, options.output);
  if (isToml) return writeSceneFile(scene, options.output);
  for (const std::string& note : writeGltf(scene, options.output)) logWarning(note);
  print("{}: {} meshes, {} instances, {} materials, {} textures\n", options.output,
        scene.geometries.size(), scene.instances.size(), scene.materials.size(),
        scene.images.size());
}

}  // namespace

Action addConvertVerb(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* verb =
      app.add_subcommand("convert", "writes a scene as glTF 2.0, or its materials as a scene file");
  verb->add_option("scene", options->request.scene,
                   "a glTF, Mitsuba or scene file or a built-in scene")
      ->required();
  addSceneSettings(*verb, options->request.scene);
  verb->add_option("-o,--output,--outfile", options->output, "file to write: .gltf, or .scene.toml")
      ->required();
  return [options](Outcome&) { convert(*options); };
}

}  // namespace restlab
