// Scenes of Mitsuba 3 and 0.6 (docs/scenes.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/scene.h"

namespace restlab {

// Returns whether a path ends in .xml.
bool isMitsubaFile(const std::filesystem::path& file);
// Returns whether a file also begins like a scene: other XML may lie in a folder of scenes.
bool isMitsubaScene(const std::filesystem::path& file);

// Reads an XML scene. settings: "NAME=VALUE&..." as behind the '?' of its name; each is the value
// of a $NAME, but allow_unknown=1, which draws plugins that are unknown as mid grey. Throws Error
// (badInput) with one line: file:line:column, what is wrong, what would be right.
Scene loadMitsuba(const std::filesystem::path& file, const std::string& settings = "");

// Reads Scene::maxBounces of a scene without its meshes and images. Throws as loadMitsuba().
std::optional<uint32_t> bouncesOfMitsuba(const std::filesystem::path& file,
                                         const std::string& settings = "");

}  // namespace restlab
