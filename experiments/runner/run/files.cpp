#include "experiments/runner/run/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/error.h"

namespace restlab {

namespace fs = std::filesystem;

void makeWritableDirectory(const fs::path& directory) {
  std::error_code status;
  fs::create_directories(directory, status);
  if (status || !fs::is_directory(directory)) {
    failInput(fmt::format("{}: cannot be made a directory: {}", directory.string(),
                          status ? status.message() : "a file of that name exists"));
  }
  const fs::path probe = directory / fmt::format(".probe{}", getpid());
  std::ofstream out(probe);
  const std::string reason = out ? "" : std::strerror(errno);
  out.close();
  fs::remove(probe, status);
  if (!reason.empty())
    failInput(fmt::format("{}: cannot be written to: {}", directory.string(), reason));
}

fs::path sceneFolder() {
  std::error_code status;
  if (const char* given = std::getenv("RESTLAB_SCENES"); given && *given) {
    return fs::is_directory(given, status) ? fs::path(given) : fs::path();
  }
  const fs::path beside = "../shared/scenes";
  return fs::is_directory(beside, status) ? beside : fs::path();
}

fs::path findAsset(const std::string& name) {
  std::error_code status;
  if (name.empty()) return {};
  std::vector<fs::path> folders = {""};
  if (fs::path(name).is_relative()) {
    if (const char* given = std::getenv("RESTLAB_SCENES"); given && *given)
      folders.push_back(given);
    folders.push_back("../shared/scenes");
  }
  for (const fs::path& folder : folders) {
    for (const char* extension : {"", ".gltf", ".glb"}) {
      const fs::path candidate = folder / (name + extension);
      if (fs::exists(candidate, status)) return candidate;
    }
  }
  return {};
}

std::filesystem::path resolvedPath(const std::filesystem::path& name) {
  std::error_code status;
  const std::filesystem::path real = std::filesystem::weakly_canonical(name, status);
  return status ? name : real;
}

std::string safeFileName(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_';
    if (plain) {
      safe += c;
    } else if (!safe.empty() && safe.back() != '-') {
      safe += '-';
    }
  }
  while (!safe.empty() && safe.back() == '-') safe.pop_back();
  return safe.empty() || safe[0] == '.' ? fmt::format("unnamed{}", safe) : safe;
}

}  // namespace restlab
