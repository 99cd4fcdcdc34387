// Meshes of scene files: their files and their normals.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/scene/scene.h"

namespace restlab {

struct NamedFile {
  std::string name;  // for error lines
  std::vector<uint8_t> bytes;
};

// Reads the file that 'file' names, below `folder`, and adds it to the content hash of the scene.
// Throws Error (badInput, badUsage).
NamedFile readNamedFile(const ConfigTable& table, const std::filesystem::path& folder,
                        Scene& scene);

// Reads the mesh that 'file' names, below `folder`, an .obj or a .ply; adds it to the content hash
// of the scene. Throws Error (badInput, badUsage).
MeshGeometry readMeshFile(const ConfigTable& table, const std::filesystem::path& folder,
                          Scene& scene);

// Gives a mesh the normals that the key 'normals' says: "file" (as they are), "flat", "smooth" or
// the angle of creases in degrees. Without the key: as they are. Throws Error (badUsage).
void readNormals(const ConfigTable& table, MeshGeometry& mesh);

}  // namespace restlab
