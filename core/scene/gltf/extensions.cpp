// checkVersionAndExtensions(): checks whether this program can read the file at all.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/scene/gltf/json.h"
#include "core/scene/gltf/schema.h"
#include "core/scene/gltf/validate.h"

namespace restlab::gltf {
namespace {

using nlohmann::json;

// Collects the extension names below `value`, at any depth.
void collectExtensions(const json& value, std::set<std::string>& names) {
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) {
      if (key == "extras") continue;
      if (key == "extensions" && item.is_object()) {
        for (const auto& [name, content] : item.items()) {
          if (!content.is_null()) names.insert(name);
        }
      }
      collectExtensions(item, names);
    }
  } else if (value.is_array()) {
    for (const json& item : value) collectExtensions(item, names);
  }
}

std::vector<std::string> textsOf(const json& document, const char* key) {
  const auto it = document.find(key);
  return it == document.end() || it->is_null() ? std::vector<std::string>()
                                               : it->get<std::vector<std::string>>();
}

// Extensions for images of other formats, and tools that convert those.
constexpr std::pair<const char*, const char*> kImageFormats[] = {
    {"KHR_texture_basisu", "'ktx extract' makes PNG of KTX2"},
    {"EXT_texture_webp", "'dwebp' makes PNG of WebP"},
    {"EXT_texture_avif", "'avifdec' makes PNG of AVIF"}};

bool isImageFormat(const std::string& extension) {
  return std::any_of(std::begin(kImageFormats), std::end(kImageFormats),
                     [&](const auto& format) { return extension == format.first; });
}

// Advice for a required extension that is not read.
std::string remedyFor(const std::string& extension) {
  for (const auto& [name, tool] : kImageFormats) {
    if (extension == name) return fmt::format("textures as PNG or JPEG expected; {}", tool);
  }
  const std::string nearest = nearestName(extension, supportedExtensions());
  return nearest.empty() ? "export the file without it" : "did you mean '" + nearest + "'?";
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void checkVersion(const json& document, Report& report) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object()) {
    report.fail("asset",
                "is missing; a glTF 2.0 file begins with {\"asset\": {\"version\": \"2.0\"}}");
  }
  for (const char* key : {"minVersion", "version"}) {
    const bool isMinimum = std::string_view(key) == "minVersion";
    const auto it = asset->find(key);
    if (it == asset->end() || (isMinimum && it->is_null())) {
      if (!isMinimum) report.fail("asset.version", "is missing; '2.0' expected");
      continue;
    }
    const std::string place = fmt::format("asset.{}", key);
    if (!it->is_string()) {
      report.fail(place, fmt::format("is {}; a string expected", typeName(*it)));
    }
    const std::string version = *it;
    const bool wellFormed = version.size() >= 3 && version.compare(0, 2, "2.") == 0 &&
                            version.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!wellFormed || (isMinimum && version != "2.0")) {
      report.fail(place, fmt::format("'{}' is not supported; glTF 2.0 expected", version));
    }
    if (version != "2.0") {
      report.warn("version", place, fmt::format("{} is read as 2.0", version));
    }
  }
}

void checkExtensions(const json& document, Report& report) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const auto it = document.find(key);
    if (it == document.end() || it->is_null()) continue;
    if (!it->is_array()) {
      report.fail(key, fmt::format("is {}; an array of strings expected", typeName(*it)));
    }
    for (size_t i = 0; i < it->size(); ++i) {
      if (!(*it)[i].is_string()) {
        report.fail(fmt::format("{}[{}]", key, i),
                    fmt::format("is {}; a string expected", typeName((*it)[i])));
      }
    }
  }
  const std::vector<std::string> used = textsOf(document, "extensionsUsed");
  const std::vector<std::string> needed = textsOf(document, "extensionsRequired");
  const std::vector<std::string>& supported = supportedExtensions();
  for (size_t i = 0; i < needed.size(); ++i) {
    const std::string place = fmt::format("extensionsRequired[{}]", i);
    if (!contains(supported, needed[i])) {
      report.fail(place, fmt::format("{} is required, but not supported; {}", needed[i],
                                     remedyFor(needed[i])));
    }
    if (!contains(used, needed[i])) {
      report.warn("extension lists", place,
                  fmt::format("{} is required, but not listed in extensionsUsed", needed[i]));
    }
  }
  std::set<std::string> seen;
  for (size_t i = 0; i < used.size(); ++i) {
    if (!seen.insert(used[i]).second) {
      report.warn("extension lists", fmt::format("extensionsUsed[{}]", i),
                  fmt::format("{} is listed twice", used[i]));
      continue;
    }
    if (contains(supported, used[i])) continue;
    report.warn(
        "extension " + used[i], fmt::format("extensionsUsed[{}]", i),
        fmt::format("{} is not supported and not read{}", used[i],
                    isImageFormat(used[i]) ? "; the PNG or JPEG beside its images is drawn" : ""));
  }
  std::set<std::string> present;
  collectExtensions(document, present);
  for (const std::string& name : present) {
    if (seen.count(name) != 0) continue;
    report.warn("extension " + name, "extensions",
                contains(supported, name)
                    ? fmt::format("{} is read although extensionsUsed does not list it", name)
                    : fmt::format("{} is not supported and not read", name));
  }
}

}  // namespace

void checkVersionAndExtensions(const json& document, Report& report) {
  checkVersion(document, report);
  checkExtensions(document, report);
}

}  // namespace restlab::gltf
