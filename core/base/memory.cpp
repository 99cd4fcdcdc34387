#include "core/base/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Returns the number after the word `key` in a file of "key number" lines.
std::optional<uint64_t> numberAfter(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    uint64_t value = 0;
    if (word == key && in >> value) return value;
  }
  return std::nullopt;
}

// Returns the number that a file consists of; nullopt for the word "max".
std::optional<uint64_t> numberIn(const fs::path& file) {
  std::ifstream in(file);
  uint64_t value = 0;
  if (in >> value) return value;
  return std::nullopt;
}

std::optional<uint64_t> leftInControlGroup(const fs::path& folder) {
  const std::optional<uint64_t> limit = numberIn(folder / "memory.max");
  const std::optional<uint64_t> current = numberIn(folder / "memory.current");
  if (!limit || !current) return std::nullopt;
  // Count cached files as free: the kernel drops them when memory is needed.
  uint64_t used = *current;
  for (const char* key : {"active_file", "inactive_file"}) {
    used -= std::min(used, numberAfter(folder / "memory.stat", key).value_or(0));
  }
  return *limit - std::min(*limit, used);
}

}  // namespace

std::optional<uint64_t> availableMemory(const fs::path& root) {
  std::optional<uint64_t> available = numberAfter(root / "proc/meminfo", "MemAvailable:");
  if (available) *available *= 1024;  // given in KiB
  const std::optional<uint64_t> left = leftInControlGroup(root / "sys/fs/cgroup");
  if (!left) return available;
  return available ? std::min(*available, *left) : *left;
}

void requireMemory(const std::string& what, uint32_t width, uint32_t height,
                   uint64_t bytesPerPixel) {
  const std::optional<uint64_t> available = availableMemory();
  const uint64_t pixels = uint64_t(width) * height;
  // Divide, as a product could overflow.
  if (!available || bytesPerPixel == 0 || pixels <= *available / bytesPerPixel) return;
  throw Error(
      ExitCode::deviceUnavailable,
      fmt::format("{}: {}x{} pixels of {} bytes need {:.0f} MiB of memory, {} MiB are "
                  "available; choose a smaller resolution",
                  what, width, height, bytesPerPixel,
                  double(pixels) * double(bytesPerPixel) / double(1 << 20), *available >> 20));
}

void MemoryGuard::take(const std::string& what, uint64_t bytes) {
  constexpr uint64_t kAsked = uint64_t(32) << 20;
  notAsked_ += std::min(bytes, ~notAsked_);
  if (notAsked_ < kAsked) return;
  notAsked_ = 0;
  const std::optional<uint64_t> available = availableMemory();
  if (!available || bytes <= *available) return;
  throw Error(ExitCode::deviceUnavailable,
              fmt::format("{}: needs {} MiB of memory, {} MiB are available", what, bytes >> 20,
                          *available >> 20));
}

}  // namespace restlab
