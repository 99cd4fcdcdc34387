// What nodes carry: meshes (also instanced by the GPU extension), cameras, punctual lights.
#pragma once

#include <vector>

#include "core/scene/gltf_mesh.h"
#include "core/scene/gltf_nodes.h"

namespace restlab::gltf {

// Adds the instances of the nodes' meshes to the scene. One whose transform flattens it is a plate;
// one of which less than a plane is left has no area and is left out. A warning says either.
void addMeshInstances(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                      MeshImporter& meshes, Scene& scene, Report& report);

// Adds one camera for every node that carries one. Names: the camera's, else the node's. Scales of
// nodes count for nothing but mirrors of the nodes above (docs/gltf.md).
void addCameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
                Report& report);

// Adds KHR_lights_punctual lights. The scale of their nodes has no effect on their numbers.
void addLights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
               Report& report);

}  // namespace restlab::gltf
