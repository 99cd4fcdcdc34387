// Meshes made by code, for the built-in scenes. Positions are in metres; faces are
// counter-clockwise seen from where their normal points. Closed solids share vertices, so they are
// watertight by index.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::builtin {

// Planar quads, four corners each, flat: split along the diagonal from the first corner.
MeshGeometry quads(const std::string& name, const std::vector<glm::dvec3>& corners);

// The parallelogram corner, corner + u, corner + u + v, corner + v; its normal is along u x v.
MeshGeometry quad(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                  const glm::dvec3& v);

// The parallelogram of quad() as columns x rows cells along u and v, two triangles each, with
// shared vertices.
MeshGeometry grid(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                  const glm::dvec3& v, uint32_t columns, uint32_t rows);

// Axis-aligned box, flat, closed, 12 triangles. Throws std::logic_error unless low < high.
MeshGeometry box(const std::string& name, const glm::dvec3& low, const glm::dvec3& high);

// Icosahedron subdivided `level` times (20 x 4^level triangles), vertices on the sphere. With
// `smooth` the mesh carries the sphere's normals; without, the mesh is a convex polyhedron.
MeshGeometry sphere(const std::string& name, const glm::dvec3& center, double radius, int level,
                    bool smooth = true);

// Upright closed cylinder: smooth side, flat caps.
MeshGeometry cylinder(const std::string& name, const glm::dvec3& baseCenter, double radius,
                      double height, int segments);

// Adds `part` to `mesh`. Both must carry normals or neither does (std::logic_error).
void append(MeshGeometry& mesh, const MeshGeometry& part);

// The mesh under a rigid or scaling transform; a mirroring one reverses the winding.
MeshGeometry transformed(MeshGeometry mesh, const glm::dmat4& transform);

// Turns the mesh inside out: winding and normals reversed.
MeshGeometry insideOut(MeshGeometry mesh);

// Rotation by `degrees` about the vertical through `pivot`, counter-clockwise seen from above.
glm::dmat4 turnAbout(const glm::dvec3& pivot, double degrees);

}  // namespace restlab::builtin
