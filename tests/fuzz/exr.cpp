#include "core/image/image.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readExr(const uint8_t* bytes, size_t count) {
  const std::filesystem::path file = inputFile("image.exr", bytes, count);
  return isRead(file, ExitCode::badInput, [&] { restlab::readExr(file); });
}

}  // namespace restlab::fuzz
