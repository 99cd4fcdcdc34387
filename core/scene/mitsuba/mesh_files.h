// Meshes of Mitsuba's formats from their bytes. `file` starts every error line. Throw Error
// (badInput).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/mitsuba/report.h"
#include "core/scene/scene.h"

namespace restlab::mitsuba {

using Bytes = std::vector<uint8_t>;

// Wavefront OBJ: v, vt, vn and f. Texture coordinates as the file has them.
MeshGeometry readObj(const Bytes& bytes, const std::string& file, Report& report);

// PLY, as text or binary of either order of bytes.
MeshGeometry readPly(const Bytes& bytes, const std::string& file, Report& report);

// Mitsuba's own format, versions 3 and 4: the shape of that index.
MeshGeometry readSerialized(const Bytes& bytes, size_t shape, const std::string& file,
                            Report& report);

// Checks the result of any reader. Fails on coordinates that are not finite, on indices without
// vertex, and on more vertices than indices can name.
void checkMesh(const MeshGeometry& mesh, const std::string& file, const Report& report);

// Gives vertices without a normal the mean of their faces, weighted by angle. Triangles turn so
// that their front is where the normals point.
void completeNormals(MeshGeometry& mesh);

// Tangents along increasing u, with the bitangent at its left, as Mitsuba frames normal maps.
void addTangents(MeshGeometry& mesh);

}  // namespace restlab::mitsuba
