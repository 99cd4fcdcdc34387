// loadScene() finds a scene by name or path; findCamera() finds a camera in it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <exception>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/scene/mitsuba/mitsuba.h"
#include "core/scene/scene.h"
#include "core/scene/scene_folders.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

bool isScene(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code error;
  return (extension == ".gltf" || extension == ".glb" || isSceneFile(file) ||
          isMitsubaScene(file)) &&
         fs::is_regular_file(file, error);
}

// Lists scenes in a directory and in its direct subdirectories (NAME/glTF/NAME.gltf is common).
std::vector<fs::path> scenesIn(const fs::path& directory, int depth = 1) {
  std::vector<fs::path> found, subdirectories;
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (isScene(it->path())) {
      found.push_back(it->path());
    } else if (it->is_directory(ignored)) {
      subdirectories.push_back(it->path());
    }
  }
  if (found.empty() && depth > 0) {
    for (const fs::path& subdirectory : subdirectories) {
      for (const fs::path& file : scenesIn(subdirectory, depth - 1)) found.push_back(file);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Resolves a candidate: a file, a directory with one scene in it, or a stem. Empty if nothing is
// there.
fs::path resolve(const fs::path& candidate) {
  std::error_code error;
  if (fs::is_directory(candidate, error)) {
    const std::vector<fs::path> scenes = scenesIn(candidate);
    if (scenes.size() == 1) return scenes[0];
    if (scenes.empty()) {
      const std::string reason = unreadableReason(candidate);
      failInput(fmt::format(
          "{}: {}", candidate.string(),
          reason.empty() ? "no .gltf, .glb, .scene.toml or .xml in this directory" : reason));
    }
    std::string names;
    for (const fs::path& scene : scenes) {
      names += (names.empty() ? "" : ", ") + scene.lexically_relative(candidate).string();
    }
    failInput(fmt::format("{}: {} scenes in this directory; name one of {}", candidate.string(),
                          scenes.size(), names));
  }
  if (fs::exists(candidate, error)) return candidate;
  if (isHidden(error))
    failInput(fmt::format("{}: {}", candidate.string(), unreadableReason(candidate)));
  for (const char* extension : {".gltf", ".glb", ".scene.toml", ".xml"}) {
    fs::path file = candidate;
    file += extension;
    if (fs::is_regular_file(file, error)) return file;
  }
  return {};
}

// Collects names that would be found directly under `directory`, for "did you mean".
void collectNames(const fs::path& directory, const fs::path& prefix,
                  std::vector<std::string>& names) {
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored) || isScene(it->path())) {
      names.push_back((prefix / it->path().filename()).string());
    }
  }
}

// Finds a scene of this name further down in a folder of scenes, as a user would give it; "" if
// there is none.
std::string namesakeBelow(const fs::path& folder, const fs::path& name) {
  constexpr int kDepth = 3;
  std::error_code error;
  std::vector<std::string> found;
  fs::recursive_directory_iterator it(folder, error), end;
  for (; !error && it != end; it.increment(error)) {
    if (it.depth() + 1 >= kDepth) it.disable_recursion_pending();
    const fs::path& path = it->path();
    std::error_code ignored;
    const bool isOne = it->is_directory(ignored) ? scenesIn(path).size() == 1 : isScene(path);
    if (isOne && path.stem() == name.stem())
      found.push_back(path.lexically_relative(folder).string());
  }
  // Prefer the shortest: a folder before the file in it.
  const auto isShorter = [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  };
  const auto shortest = std::min_element(found.begin(), found.end(), isShorter);
  return shortest == found.end() ? "" : *shortest;
}

// The variant that is named behind the '?' of a glTF file: all that follows "variant=".
std::optional<std::string> variantOf(const std::string& settings, const std::string& name) {
  if (settings.empty()) return std::nullopt;
  const std::string key = "variant=";
  if (!settings.starts_with(key)) {
    failInput(fmt::format("{}: '{}' is no setting of a glTF file; '?variant=NAME' expected", name,
                          settings));
  }
  return settings.substr(key.size());
}

std::optional<uint32_t> bouncesOf(const std::string& nameOrPath, int depth);

// glTF files that are damaged have none: loading says what is wrong with them.
std::optional<uint32_t> bouncesOfGltfOrNone(const fs::path& file) {
  try {
    return bouncesOfGltf(file);
  } catch (const std::exception&) {  // also of memory
    return {};
  }
}

// `depth`: of scene files that begin with each other.
std::optional<uint32_t> bouncesOfFile(const fs::path& file, const std::string& settings,
                                      int depth) {
  if (isMitsubaFile(file)) return bouncesOfMitsuba(file, settings);
  if (!isSceneFile(file)) return bouncesOfGltfOrNone(file);
  if (depth > 8) return {};
  const std::string base = ConfigTable::parseFile(file).getString("base", "");
  if (base.empty() || isBuiltinScene(base)) return {};
  const auto [name, ofBase] = splitSceneSettings(base);
  const fs::path beside = file.parent_path() / name;
  std::error_code error;
  if (fs::exists(beside, error)) return bouncesOfFile(resolve(beside), ofBase, depth + 1);
  return bouncesOf(base, depth + 1);
}

std::optional<uint32_t> bouncesOf(const std::string& nameOrPath, int depth) {
  if (nameOrPath.empty() || isBuiltinScene(nameOrPath)) return {};
  const auto [name, settings] = splitSceneSettings(nameOrPath);
  for (const fs::path& folder : sceneFoldersFor(name))
    if (const fs::path file = resolve(folder / name); !file.empty())
      return bouncesOfFile(file, settings, depth);
  return {};
}

}  // namespace

std::optional<uint32_t> suggestedBounces(const std::string& nameOrPath) {
  return bouncesOf(nameOrPath, 0);
}

Scene loadScene(const std::string& nameOrPath) {
  if (nameOrPath.empty()) failInput("scene: the name is empty; a built-in or a path expected");
  const std::vector<std::string>& builtins = builtinSceneNames();
  if (isBuiltinScene(nameOrPath)) return makeBuiltinScene(nameOrPath);
  const auto [name, settings] = splitSceneSettings(nameOrPath);
  const fs::path path(name);
  const std::vector<fs::path> folders = sceneFoldersFor(path);
  std::vector<std::string> near = builtins;
  std::string tried, namesake;
  for (const fs::path& folder : folders) {
    const fs::path candidate = folder / path;
    if (const fs::path file = resolve(candidate); !file.empty()) {
      if (isSceneFile(file)) return loadSceneFile(file, settings);
      if (isMitsubaFile(file)) return loadMitsuba(file, settings);
      return loadGltf(file, variantOf(settings, nameOrPath));
    }
    tried += (tried.empty() ? "" : ", ") + candidate.string();
    const fs::path parent = candidate.parent_path();
    collectNames(parent.empty() ? "." : parent, path.parent_path(), near);
    if (namesake.empty() && !folder.empty()) namesake = namesakeBelow(folder, path);
  }
  std::sort(near.begin() + static_cast<ptrdiff_t>(builtins.size()), near.end());
  failInput(
      fmt::format("scene '{}': neither a built-in scene nor a file (tried {}){}", nameOrPath, tried,
                  namesake.empty() ? didYouMean(nameOrPath.substr(0, nameOrPath.find('?')), near)
                                   : fmt::format("; did you mean '{}'?", namesake)));
}

uint32_t findCamera(const Scene& scene, const std::string& nameOrIndex) {
  std::vector<std::string> names;
  std::vector<size_t> matches;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    names.push_back(scene.cameras[i].name);
    if (scene.cameras[i].name == nameOrIndex) matches.push_back(i);
  }
  if (matches.size() == 1) return static_cast<uint32_t>(matches[0]);
  if (matches.size() > 1) {
    failUsage(fmt::format("camera '{}': {} cameras of '{}' have this name; give an index: {}",
                          nameOrIndex, matches.size(), scene.name, fmt::join(matches, ", ")));
  }
  uint32_t index = 0;
  const char* end = nameOrIndex.data() + nameOrIndex.size();
  const auto [rest, error] = std::from_chars(nameOrIndex.data(), end, index);
  if (error == std::errc() && rest == end && !nameOrIndex.empty()) {
    if (index < scene.cameras.size()) return index;
    failUsage(fmt::format("camera {}: '{}' has cameras 0 to {}", nameOrIndex, scene.name,
                          scene.cameras.size() - 1));
  }
  failUsage(fmt::format("camera '{}': '{}' has {}{}", nameOrIndex, scene.name,
                        fmt::join(names, ", "), didYouMean(nameOrIndex, names)));
}

}  // namespace restlab
