#include "core/scene/scene_file/scene_file.h"

#include <algorithm>
#include <string>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readSceneFile(const uint8_t* bytes, size_t count) {
  const uint8_t* end = std::find(bytes, bytes + count, uint8_t(0));
  const std::string settings(end == bytes + count ? end : end + 1, bytes + count);
  const std::filesystem::path file = inputFile("x.scene.toml", bytes, size_t(end - bytes));
  return isRead(file, ExitCode::badInput, [&] { loadSceneFile(file, settings); });
}

}  // namespace restlab::fuzz
