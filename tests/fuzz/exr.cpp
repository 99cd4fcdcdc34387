#include "core/image/image.h"
#include "core/scene/scene.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readExr(const uint8_t* bytes, size_t count) {
  const std::filesystem::path file = inputFile("image.exr", bytes, count);
  const bool read = isRead(file, ExitCode::badInput, [&] { restlab::readExr(file); });
  // Environments may be cubes, which are converted.
  if (read) isRead(file, ExitCode::badInput, [&] { loadEnvironment(file); });
  return read;
}

}  // namespace restlab::fuzz
