#include "core/backend/kernel_cache.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/base/cache_folder.h"
#include "core/base/error.h"
#include "core/image/io/atomic_file.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// File header: magic, number of bytes behind it, and their hash.
struct Header {
  char magic[8] = {'r', 'l', 'k', 'e', 'r', 'n', '1', '\n'};
  uint64_t count = 0;
  uint64_t hash = 0;
};

}  // namespace

std::string contentKey(const std::string& text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

KernelCache::KernelCache(fs::path folder, Warn warn)
    : folder_(std::move(folder)), warn_(std::move(warn)) {}

fs::path KernelCache::defaultFolder() { return cacheFolder("kernels"); }

std::optional<std::vector<uint8_t>> KernelCache::read(const std::string& name) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path file = folder_ / name;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream),
                             std::istreambuf_iterator<char>()};
  Header header;
  const Header expected;
  bool isWhole = bytes.size() >= sizeof header;
  if (isWhole) {
    std::memcpy(&header, bytes.data(), sizeof header);
    const uint8_t* content = bytes.data() + sizeof header;
    const size_t count = bytes.size() - sizeof header;
    isWhole = std::memcmp(header.magic, expected.magic, sizeof header.magic) == 0 &&
              header.count == count && header.hash == XXH3_64bits(content, count);
  }
  if (!isWhole) {
    warn_(fmt::format("{}: is damaged; compiled anew", file.string()));
    return std::nullopt;
  }
  bytes.erase(bytes.begin(), bytes.begin() + std::ptrdiff_t(sizeof header));
  return bytes;
}

void KernelCache::write(const std::string& name, const void* bytes, size_t count) const {
  if (folder_.empty()) return;
  Header header;
  header.count = count;
  header.hash = XXH3_64bits(bytes, count);
  std::error_code status;
  fs::create_directories(folder_, status);
  try {
    AtomicFile file(folder_ / name);
    file.stream().write(reinterpret_cast<const char*>(&header), sizeof header);
    file.stream().write(static_cast<const char*>(bytes), std::streamsize(count));
    file.commit();
  } catch (const Error& error) {
    warn_(fmt::format("{}; compiled kernels are not kept", error.what()));
  }
}

}  // namespace restlab
