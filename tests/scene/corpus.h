// Collection of scenes outside the project: the folder of RESTLAB_SCENES, else ../shared/scenes
// beside the project. Tests that need it skip, visibly, if it is absent.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <vector>

namespace restlab::test {

inline std::filesystem::path sceneFolder() {
  const char* variable = std::getenv("RESTLAB_SCENES");
  return variable && *variable ? std::filesystem::path(variable)
                               : std::filesystem::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
}

// Lists every .gltf and .glb below a folder, sorted.
inline std::vector<std::filesystem::path> gltfsBelow(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path extension = entry.path().extension();
    if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace restlab::test

#define SKIP_WITHOUT(folder)                                                                      \
  if (!std::filesystem::is_directory(folder)) {                                                   \
    std::cout << "skipped: " << (folder) << " is absent (RESTLAB_SCENES names the collection)\n"; \
    GTEST_SKIP() << (folder) << " is absent";                                                     \
  }
