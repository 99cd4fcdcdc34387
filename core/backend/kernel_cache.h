// Compiled kernels on disk: blobs under content keys, checked when they are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace restlab {

class KernelCache {
 public:
  // `folder` empty: nothing is kept. `warn` gets one line if a file is damaged or cannot be
  // written.
  using Warn = std::function<void(const std::string& line)>;
  KernelCache(std::filesystem::path folder, Warn warn);

  // $XDG_CACHE_HOME/restlab/kernels or ~/.cache/restlab/kernels; empty where there is neither.
  static std::filesystem::path defaultFolder();

  // Returns the bytes stored under a name; nullopt if there are none or they are damaged.
  std::optional<std::vector<uint8_t>> read(const std::string& name) const;
  // Stores bytes under a name. A failure is only a warning: a cache that cannot be written costs
  // time.
  void write(const std::string& name, const void* bytes, size_t count) const;

 private:
  std::filesystem::path folder_;
  Warn warn_;
};

// Hash of the content, 32 hexadecimal digits (XXH3, 128 bits).
std::string contentKey(const std::string& text);

}  // namespace restlab
