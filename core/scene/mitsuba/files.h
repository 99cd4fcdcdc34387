// Files that a Mitsuba scene names: only those below its folder are read, and every byte counts in
// the scene's content hash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/mitsuba/report.h"

namespace restlab::mitsuba {

class Files {
 public:
  Files(std::filesystem::path folder, Report& report) : folder_(folder), report_(report) {}

  // Adds a folder that names are looked for in, relative to the scene's (<path>).
  void addFolder(const std::string& name, const std::string& place);

  // Returns the regular file of that name. Fails at `place` on absolute paths, paths that leave the
  // folder, and missing files.
  std::filesystem::path find(const std::string& name, const std::string& place) const;

  // Reads a file whole, at most `mostBytes`, and hashes it.
  std::vector<uint8_t> read(const std::filesystem::path& file, const std::string& place,
                            uint64_t mostBytes);

  uint64_t contentHash() const { return hash_; }
  // Adds words that the scene is made from as well.
  void hash(const std::string& text);

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> more_;
  Report& report_;
  uint64_t hash_ = 0;
};

}  // namespace restlab::mitsuba
