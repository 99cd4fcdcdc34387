#include "core/scene/scene.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readHdr(const uint8_t* bytes, size_t count) {
  const std::filesystem::path file = inputFile("sky.hdr", bytes, count);
  return isRead(file, ExitCode::badInput, [&] { loadEnvironment(file); });
}

}  // namespace restlab::fuzz
