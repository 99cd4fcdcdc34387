// KHR_materials_variants: a file's sets of materials.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Gives each primitive its material in the variant of that name, where it has one. Fails if the
// file has no such variant, or if a part of the extension is not what it should be. Without a name
// nothing changes, and faults in the extension matter to nothing that is drawn. Returns the names
// of all variants. validateDocument() must have accepted the document.
std::vector<std::string> applyVariant(nlohmann::json& document,
                                      const std::optional<std::string>& name, Report& report);

}  // namespace restlab::gltf
