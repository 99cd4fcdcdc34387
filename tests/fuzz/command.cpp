#include "experiments/view/command.h"

#include <string>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readCommand(const uint8_t* bytes, size_t count) {
  const std::string text(reinterpret_cast<const char*>(bytes), count);
  return isRead("command", ExitCode::badUsage, [&] { parseViewCommand(text); });
}

}  // namespace restlab::fuzz
