// Objects that nodes carry: meshes (also instanced by the GPU extension), cameras, punctual lights.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/scene/gltf/mesh.h"
#include "core/scene/gltf/nodes.h"

namespace restlab::gltf {

// Adds the instances of the nodes' meshes to the scene. A transform that flattens an instance makes
// a plate; an instance of which less than a plane remains has no area and is left out. A warning
// reports each case.
void addMeshInstances(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                      MeshImporter& meshes, Scene& scene, Report& report);

// This project's own properties, which writeGltf() keeps: `extras.restlab.max_bounces` of the scene
// that is drawn (Scene::maxBounces), and `extras.restlab.film` of each camera, [width, height] in
// pixels (SceneCamera::film; 0: it has none). Others than whole numbers in range are an error.
std::optional<uint32_t> readBounces(const nlohmann::json& document, const Report& report);
std::vector<glm::uvec2> readFilms(const nlohmann::json& document, const Report& report);

// Adds one camera for every node that carries one. Names: the camera's, else the node's. Scales of
// nodes have no effect, except mirrors of the nodes above (docs/gltf.md). `films`: of the cameras
// of the file.
void addCameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                const std::vector<glm::uvec2>& films, Scene& scene, Report& report);

// Adds KHR_lights_punctual lights. Node scales do not change their intensity or range.
void addLights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
               Report& report);

}  // namespace restlab::gltf
