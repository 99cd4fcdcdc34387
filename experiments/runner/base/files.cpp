#include "experiments/runner/base/files.h"

#include <fmt/format.h>
#include <locale.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <cwctype>
#include <fstream>
#include <vector>

#include "core/base/error.h"
#include "core/base/share_folder.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/scene/scene_folders.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Locale that classifies letters of every script, independent of the user's locale.
locale_t anyScript() {
  static const locale_t locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t(nullptr));
  return locale;
}

// Returns the number of bytes of the letter, digit, accent, '.' or '_' that begins at `at`; 0 for
// any other character.
size_t letterBytes(const std::string& name, size_t at) {
  const char c = name[at];
  if (uint8_t(c) < 0x80) return std::isalnum(uint8_t(c)) || c == '.' || c == '_' ? 1 : 0;
  if (anyScript() == locale_t(nullptr)) return 0;
  const locale_t before = uselocale(anyScript());
  std::mbstate_t state{};
  wchar_t letter = 0;
  const size_t bytes = std::mbrtowc(&letter, name.data() + at, name.size() - at, &state);
  const bool isWhole = bytes <= name.size() - at;  // else invalid UTF-8
  const bool isLetter = isWhole && (std::iswalnum(std::wint_t(letter)) ||
                                    std::iswctype(std::wint_t(letter), std::wctype("combining")));
  uselocale(before);
  return isLetter ? bytes : 0;
}

}  // namespace

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
  for (const fs::path& folder : sceneFoldersFor(name)) {
    for (const char* extension : {"", ".gltf", ".glb", ".scene.toml", ".xml"}) {
      const fs::path candidate = folder / (name + extension);
      if (fs::exists(candidate, status)) return candidate;
    }
  }
  return {};
}

fs::path findSuite(const fs::path& name) {
  std::error_code status;
  if (name.empty() || name.is_absolute() || shareFolder().empty() ||
      fs::is_regular_file(name, status))
    return name;
  const fs::path installed = shareFolder() / "suites" / name;
  for (const char* extension : {"", ".toml"}) {
    const fs::path candidate = installed.string() + extension;
    if (fs::is_regular_file(candidate, status)) return candidate;
  }
  return name;
}

std::vector<std::string> installedSuites() {
  std::vector<std::string> names;
  if (shareFolder().empty()) return names;
  std::error_code status;
  for (fs::directory_iterator it(shareFolder() / "suites", status), end; !status && it != end;
       it.increment(status))
    if (it->path().extension() == ".toml") names.push_back(it->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool isSuite(const std::string& name) {
  return fs::path(name).extension() == ".toml" && !isSceneFile(splitSceneSettings(name).first);
}

std::filesystem::path resolvedPath(const std::filesystem::path& name) {
  std::error_code status;
  const std::filesystem::path real = std::filesystem::weakly_canonical(name, status);
  return status ? name : real;
}

std::string safeFileName(const std::string& name) {
  std::string safe;
  for (size_t at = 0; at < name.size();) {
    const size_t bytes = letterBytes(name, at);
    if (bytes > 0) {
      safe.append(name, at, bytes);
    } else if (!safe.empty() && safe.back() != '-') {
      safe += '-';
    }
    at += std::max<size_t>(1, bytes);
  }
  while (!safe.empty() && safe.back() == '-') safe.pop_back();
  return safe.empty() || safe[0] == '.' ? fmt::format("unnamed{}", safe) : safe;
}

std::string plainId(const std::string& safeName) {
  std::string id;
  for (const char c : safeName) {
    const bool isFirstByte = (uint8_t(c) & 0xc0u) != 0x80u;
    if (uint8_t(c) < 0x80u) {
      id += c;
    } else if (isFirstByte) {
      id += '_';
    }
  }
  if (id == safeName) return id;
  return fmt::format("{}-{:08x}", id,
                     uint32_t(XXH3_64bits(safeName.data(), safeName.size()) >> 32));
}

}  // namespace restlab
