// Objects that nodes carry: meshes (also instanced by the GPU extension), cameras, punctual lights.
#pragma once

#include <vector>

#include "core/scene/gltf/mesh.h"
#include "core/scene/gltf/nodes.h"

namespace restlab::gltf {

// Adds the instances of the nodes' meshes to the scene. A transform that flattens an instance makes
// a plate; an instance of which less than a plane remains has no area and is left out. A warning
// reports each case.
void addMeshInstances(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                      MeshImporter& meshes, Scene& scene, Report& report);

// Adds one camera for every node that carries one. Names: the camera's, else the node's. Scales of
// nodes have no effect, except mirrors of the nodes above (docs/gltf.md).
void addCameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
                Report& report);

// Adds KHR_lights_punctual lights. Node scales do not change their intensity or range.
void addLights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
               Report& report);

}  // namespace restlab::gltf
