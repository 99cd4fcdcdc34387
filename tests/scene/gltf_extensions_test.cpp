// docs/gltf.md has a row for each extension that Khronos has ratified, and each row is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "core/scene/gltf/schema.h"

namespace restlab {
namespace {

// Extension -> "drawn" or "warned", of the rows of the table.
std::map<std::string, std::string> extensionRows() {
  std::ostringstream text;
  text << std::ifstream(std::string(RESTLAB_SOURCE_DIR) + "/docs/gltf.md").rdbuf();
  const std::string page = text.str();
  static const std::regex row("\\n\\| `(\\w+)` \\| (\\w+) \\|");
  std::map<std::string, std::string> rows;
  for (std::sregex_iterator it(page.begin(), page.end(), row), end; it != end; ++it)
    EXPECT_TRUE(rows.emplace((*it)[1].str(), (*it)[2].str()).second) << (*it)[1] << " twice";
  return rows;
}

TEST(GltfExtensions, TheTableIsComplete) {
  const std::map<std::string, std::string> rows = extensionRows();
  // "Ratified Khronos Extensions" of the registry.
  for (const char* ratified : {"KHR_animation_pointer",
                               "KHR_draco_mesh_compression",
                               "KHR_lights_punctual",
                               "KHR_materials_anisotropy",
                               "KHR_materials_clearcoat",
                               "KHR_materials_dispersion",
                               "KHR_materials_emissive_strength",
                               "KHR_materials_ior",
                               "KHR_materials_iridescence",
                               "KHR_materials_sheen",
                               "KHR_materials_specular",
                               "KHR_materials_transmission",
                               "KHR_materials_unlit",
                               "KHR_materials_variants",
                               "KHR_materials_volume",
                               "KHR_mesh_quantization",
                               "KHR_texture_basisu",
                               "KHR_texture_transform",
                               "KHR_xmp_json_ld",
                               "EXT_mesh_gpu_instancing",
                               "EXT_meshopt_compression",
                               "EXT_texture_webp"})
    EXPECT_TRUE(rows.contains(ratified)) << ratified;
  const std::vector<std::string>& supported = gltf::supportedExtensions();
  for (const std::string& name : supported)
    EXPECT_TRUE(rows.contains(name) && rows.at(name) == "drawn") << name;
  for (const auto& [name, state] : rows) {
    const bool isDrawn = std::find(supported.begin(), supported.end(), name) != supported.end();
    EXPECT_EQ(state, isDrawn ? "drawn" : "warned") << name;
  }
}

}  // namespace
}  // namespace restlab
