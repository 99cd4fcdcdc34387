// KHR_materials_variants: the material of each primitive in a variant.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/scene/corpus.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;

constexpr const char* kVariants = "KHR_materials_variants";

// Three primitives: one with a material for each variant, one for the second alone, one for none.
void addVariants(GltfBuilder& file) {
  file.doc["extensionsUsed"] = {kVariants};
  file.doc["extensions"][kVariants]["variants"] = {{{"name", "day & night"}}, {{"name", "rain"}}};
  for (const char* name : {"a", "b", "c"}) file.add("materials", {{"name", name}});
  const json both = {
      {"mappings", {{{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {1}}}}}};
  const json one = {{"mappings", {{{"material", 2}, {"variants", {1}}}}}};
  for (const json& extension : {both, one, json()}) {
    json more = {{"material", 0}};
    if (!extension.is_null()) more["extensions"][kVariants] = extension;
    file.node({{"mesh", file.triangle(more)}});
  }
}

std::vector<uint32_t> variantMaterials(const Scene& scene) {
  std::vector<uint32_t> materials;
  for (const MeshInstance& instance : scene.instances) materials.push_back(instance.material);
  return materials;
}

std::string variantError(const std::string& scene) {
  try {
    loadScene(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return error.what();
  }
  return "";
}

TEST(GltfVariants, PrimitivesTakeTheirMaterials) {
  GltfBuilder file;
  addVariants(file);
  const std::string path = file.write().string();
  const Scene plain = loadScene(path);
  EXPECT_EQ(variantMaterials(plain), (std::vector<uint32_t>{0, 0, 0}));
  EXPECT_EQ(plain.variants, (std::vector<std::string>{"day & night", "rain"}));
  EXPECT_FALSE(plain.variant);
  EXPECT_TRUE(test::warns(plain,
                          "default materials are drawn; --variant takes one of day & night, "
                          "rain"));
  const Scene day = loadScene(path + "?variant=day & night");
  EXPECT_EQ(variantMaterials(day), (std::vector<uint32_t>{1, 0, 0}));
  EXPECT_EQ(day.variant, "day & night");
  EXPECT_TRUE(day.name.ends_with("?variant=day & night")) << day.name;
  const Scene rain = loadScene(path + "?variant=rain");
  EXPECT_EQ(variantMaterials(rain), (std::vector<uint32_t>{2, 2, 0}));
  EXPECT_FALSE(test::warns(rain, "default materials"));
  EXPECT_NE(plain.contentHash, day.contentHash);
  EXPECT_NE(plain.contentHash, rain.contentHash);
  EXPECT_NE(day.contentHash, rain.contentHash);
}

TEST(GltfVariants, ASceneFileBeginsWithAVariant) {
  GltfBuilder file;
  addVariants(file);
  file.write();
  const auto scene = file.directory().write("x.scene.toml", "base = \"test.gltf?variant=rain\"\n");
  EXPECT_EQ(variantMaterials(loadScene(scene.string())), (std::vector<uint32_t>{2, 2, 0}));
}

TEST(GltfVariants, UnknownNames) {
  GltfBuilder file;
  addVariants(file);
  const std::string path = file.write().string();
  EXPECT_EQ(variantError(path + "?variant=rains"),
            path +
                ": extensions.KHR_materials_variants: has no variant 'rains'; day & night, rain "
                "expected; did you mean 'rain'?");
  EXPECT_NE(variantError(path + "?material=rain").find("'?variant=NAME' expected"),
            std::string::npos);
  GltfBuilder other;
  other.node({{"mesh", other.triangle()}});
  EXPECT_NE(variantError(other.write().string() + "?variant=rain").find("has no variants"),
            std::string::npos);
}

// Faults fail a variant that is asked for, and matter to no other image.
TEST(GltfVariants, FaultsMatterToVariantsAlone) {
  const auto expect = [](const std::string& line, auto change) {
    GltfBuilder file;
    addVariants(file);
    change(file.doc, file.doc["meshes"][0]["primitives"][0]["extensions"][kVariants]["mappings"]);
    const std::string path = file.write().string();
    EXPECT_EQ(variantError(path), "");
    EXPECT_NE(variantError(path + "?variant=rain").find(line), std::string::npos)
        << variantError(path + "?variant=rain");
  };
  const std::string first = "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings";
  expect(first + "[0].material: is 3; an index below 3, the number of materials, expected",
         [](json&, json& mappings) { mappings[0]["material"] = 3; });
  expect(first + "[0].variants[0]: is 2; an index below 2, the number of variants, expected",
         [](json&, json& mappings) { mappings[0]["variants"] = {2}; });
  expect(first + "[1].variants[0]: variant 1 has a material in another mapping; one expected",
         [](json&, json& mappings) { mappings[0]["variants"] = {1}; });
  expect(first + ": is a string; an array expected",
         [](json&, json& mappings) { mappings = "none"; });
  expect(first + "[0]: has no material",
         [](json&, json& mappings) { mappings[0].erase("material"); });
  expect("variants[0]: has no name", [](json& document, json&) {
    document["extensions"][kVariants]["variants"][0]["name"] = 5;
  });
  expect("variants[1]: is named 'rain' as variants[0]; another name expected",
         [](json& document, json&) {
           document["extensions"][kVariants]["variants"][0]["name"] = "rain";
         });
}

TEST(GltfVariants, AFileOfAnotherProgram) {
  const std::filesystem::path file =
      test::sceneFolder() / "loader/bio-18_variants/18_variants.gltf";
  SKIP_WITHOUT(file.parent_path());
  EXPECT_EQ(variantMaterials(loadGltf(file)), (std::vector<uint32_t>{1, 3, 4}));
  EXPECT_EQ(variantMaterials(loadGltf(file, "Variant_Red")), (std::vector<uint32_t>{0, 2, 4}));
}

}  // namespace
}  // namespace restlab
