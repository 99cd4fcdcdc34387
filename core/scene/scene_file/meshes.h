// Meshes of scene files: their files and their normals.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/scene/scene.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

// Reads the mesh that 'file' names, below `folder`, an .obj or a .ply; adds it to the content hash
// of the scene. Throws Error (badInput, badUsage).
MeshGeometry readMeshFile(const ConfigTable& table, const std::filesystem::path& folder,
                          Scene& scene);

// Reads an .obj or a .ply alone. Throws Error (badInput).
Scene sceneOfMesh(const std::filesystem::path& file);
bool isSingleMesh(const std::string& name);

// Reads a file that is named at `place`, below `folder`; adds it to the content hash of the scene.
// Throws Error (badInput).
NamedFile readNamedFile(const std::string& name, const std::string& place, uint64_t mostBytes,
                        const std::filesystem::path& folder, Scene& scene);

// Gives a mesh the normals that the key 'normals' says: "file" (as they are), "flat", "smooth" or
// the angle of creases in degrees. Without the key: as they are. Throws Error (badUsage).
void readNormals(const ConfigTable& table, MeshGeometry& mesh);

}  // namespace restlab
