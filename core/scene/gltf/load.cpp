// loadGltf(): runs the parts of the import in order.
#include <new>

#include "core/base/error.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf/accessor.h"
#include "core/scene/gltf/closures.h"
#include "core/scene/gltf/container.h"
#include "core/scene/gltf/document.h"
#include "core/scene/gltf/draco.h"
#include "core/scene/gltf/material.h"
#include "core/scene/gltf/mesh.h"
#include "core/scene/gltf/nodes.h"
#include "core/scene/gltf/objects.h"
#include "core/scene/gltf/rules.h"
#include "core/scene/gltf/specular_glossiness.h"
#include "core/scene/gltf/texture.h"
#include "core/scene/gltf/validate.h"
#include "core/scene/gltf/variants.h"
#include "core/scene/scene.h"

namespace restlab {
namespace {

// Earlier versions drew files without these extensions; their references are not those of this one.
uint64_t withNewExtensions(const tinygltf::Model& model, uint64_t hash) {
  for (const std::string& name : model.extensionsUsed) {
    if (name == "EXT_meshopt_compression" || name == "KHR_draco_mesh_compression" ||
        name == gltf::kSpecularGlossiness)
      hash = hashBytes(name.data(), name.size(), hash);
  }
  return hash;
}

Scene import(const std::filesystem::path& file, const std::optional<std::string>& variant,
             gltf::Report& report) {
  gltf::Container container = gltf::readContainer(file, report);
  gltf::checkVersionAndExtensions(container.json, report);
  gltf::validateDocument(container.json, report);
  gltf::checkRules(container.json, report);
  gltf::warnNotImported(container.json, report);
  const std::vector<std::string> variants = gltf::applyVariant(container.json, variant, report);
  const std::vector<int> priorities = gltf::readPriorities(container.json, report);
  const std::vector<std::string> closures = gltf::readClosures(container.json, report);
  const std::optional<uint32_t> bounces = gltf::readBounces(container.json, report);
  const std::vector<glm::uvec2> films = gltf::readFilms(container.json, report);
  gltf::Document document = gltf::loadDocument(std::move(container), file.parent_path(), report);
  gltf::decodeDraco(document.model, report);
  gltf::checkAccessors(document.model, report);

  Scene scene;
  scene.name = file.stem().string();
  scene.source = file;
  scene.maxBounces = bounces;
  scene.contentHash = withNewExtensions(document.model, document.contentHash);
  scene.variants = variants;
  scene.variant = variant;
  if (variant) {
    scene.name += "?variant=" + *variant;
    scene.contentHash = hashBytes(variant->data(), variant->size(), scene.contentHash);
  }
  gltf::TextureImporter textures(document, scene, report);
  gltf::importMaterials(document, priorities, textures, scene, report);
  textures.checkUnusedImages();
  gltf::MeshImporter meshes(document, scene, report);
  const std::vector<gltf::PlacedNode> nodes = gltf::placeNodes(document.model, report);
  gltf::addMeshInstances(document.model, nodes, meshes, scene, report);
  gltf::applyClosures(closures, file, scene);  // after the default material, which has an index
  gltf::addCameras(document.model, nodes, films, scene, report);
  gltf::addLights(document.model, nodes, scene, report);
  meshes.checkUnusedMeshes();
  gltf::surveyAccessors(document.model, report);
  if (scene.instances.empty()) report.warn("empty scene", "", "the scene holds no triangle");
  if (scene.cameras.empty()) {
    scene.cameras.push_back(framingCamera(scene));
    if (boundsWithoutStrays(scene) != worldBounds(scene)) {
      report.warn("framing", "cameras",
                  "the file has none; the camera that is made for it leaves out what lies far off "
                  "the rest");
    }
  }
  return scene;
}

}  // namespace

std::optional<uint32_t> bouncesOfGltf(const std::filesystem::path& file) {
  gltf::Report report(file.string());
  gltf::Container container = gltf::readContainer(file, report);
  gltf::validateDocument(container.json, report);
  return gltf::readBounces(container.json, report);
}

Scene loadGltf(const std::filesystem::path& file, const std::optional<std::string>& variant) {
  gltf::Report report(file.string());
  try {
    Scene scene = import(file, variant, report);
    scene.warnings = report.lines();
    return scene;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::deviceUnavailable, file.string() + ": not enough memory for this scene");
  }
}

}  // namespace restlab
