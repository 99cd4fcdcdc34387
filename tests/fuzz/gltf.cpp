#include "core/scene/compiled/compiled_scene.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readGltf(const uint8_t* bytes, size_t count) {
  // The first bytes, not the name, decide whether the file is a GLB.
  const std::filesystem::path file = inputFile("scene.gltf", bytes, count);
  return isRead(file, ExitCode::badInput, [&] { CompiledScene::build(loadGltf(file)); });
}

}  // namespace restlab::fuzz
