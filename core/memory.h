// How much memory there is left: what does not fit is refused with a line before it is touched,
// because the kernel ends a program that takes more without a word.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace restlab {

// Bytes that can still be taken without swapping: the least of what the machine has (MemAvailable)
// and what the control group allows (version 2; its page cache counts as free). Nothing where the
// system says neither. `root` is where proc and sys are looked for.
std::optional<uint64_t> availableMemory(const std::filesystem::path& root = "/");

// Throws Error (deviceUnavailable) where width x height x bytesPerPixel is more than what is
// available; `what` starts the line.
void requireMemory(const std::string& what, uint32_t width, uint32_t height,
                   uint64_t bytesPerPixel);

// What reading a file takes, piece by piece, on the word of that file.
class MemoryGuard {
 public:
  // Before `bytes` bytes are allocated: throws Error (deviceUnavailable) where they are more than
  // what is available; `what` starts the line. Small pieces are added up and asked for together, as
  // asking costs a tenth of a millisecond.
  void take(const std::string& what, uint64_t bytes);

 private:
  uint64_t notAsked_ = 0;
};

}  // namespace restlab
