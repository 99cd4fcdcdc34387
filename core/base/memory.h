// Available memory. Requests that do not fit are refused with a line before memory is touched, as
// the kernel kills a program that takes too much without a message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace restlab {

// Bytes that can still be taken without swapping: the minimum of what the machine has
// (MemAvailable) and what the control group allows (version 2; its page cache counts as free).
// nullopt if the system reports neither. `root` is the directory that contains proc and sys.
std::optional<uint64_t> availableMemory(const std::filesystem::path& root = "/");

// Throws Error (deviceUnavailable) if width x height x bytesPerPixel exceeds the available memory;
// `what` starts the line.
void requireMemory(const std::string& what, uint32_t width, uint32_t height,
                   uint64_t bytesPerPixel);

// Checks the memory for reading a file, piece by piece, as the file declares it.
class MemoryGuard {
 public:
  // Call before allocating `bytes` bytes: throws Error (deviceUnavailable) if they exceed the
  // available memory; `what` starts the line. Small pieces are summed and checked together, as a
  // check costs a tenth of a millisecond.
  void take(const std::string& what, uint64_t bytes);

 private:
  uint64_t notAsked_ = 0;
};

}  // namespace restlab
