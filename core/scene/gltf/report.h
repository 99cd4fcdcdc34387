// Errors and warnings of the glTF import: `<file>: <place>: what is wrong; what would be right`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/memory.h"

namespace restlab::gltf {

// "1 byte", "2 bytes".
std::string byteCount(uint64_t bytes);

class Report {
 public:
  // `file` as given by the user; it starts every line.
  explicit Report(std::string file) : file_(std::move(file)) {}

  // Throws Error (badInput). `place` is a path such as meshes[0].primitives[1].indices, or "".
  [[noreturn]] void fail(std::string_view place, std::string_view text) const;

  // Checks that the `bytes` bytes for the object at `place` fit into memory, before allocation;
  // throws Error (deviceUnavailable) if not.
  void takeMemory(std::string_view place, std::string_view what, uint64_t bytes);

  // Adds a warning. The first kShown warnings of one `kind` are kept, the rest become one line.
  void warn(const std::string& kind, std::string_view place, std::string_view text);

  // All warnings, one line each, in the order in which their kinds first appeared.
  std::vector<std::string> lines() const;

 private:
  static constexpr size_t kShown = 4;
  struct Kind {
    std::vector<std::string> lines;
    size_t count = 0;
  };
  std::string line(std::string_view place, std::string_view text) const;

  std::string file_;
  std::map<std::string, size_t> indexOfKind_;
  std::vector<Kind> kinds_;
  MemoryGuard memory_;
};

}  // namespace restlab::gltf
