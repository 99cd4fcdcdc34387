// The mesh of elements of `radiosity`, made from the triangles of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace restlab {

class CompiledScene;

// Triangles divided until no edge of an element is longer than the size asked for. Elements of one
// triangle are alike. Vertices are shared where positions meet within an instance and shading
// normals differ by less than 3 degrees. Triangles whose edges are below a quarter of the size
// share them in cells of that quarter, where normals differ by less than 25 degrees: the number of
// vertices follows the area, not the triangles.
struct ElementMesh {
  // Words of the kernels' tables (integrators/radiosity/radiosity.h).
  std::vector<uint32_t> instances, triangles, elements, vertices;
  size_t elementCount = 0, vertexCount = 0;
  double size = 0.0;              // metres: longest edge that was allowed
  double areaM2 = 0.0;            // of one side of all triangles
  double otherThanLambert = 0.0;  // share of the area whose material is not diffuse alone
};

// Throws Error (badInput) if some surface is not of triangles.
void requireTriangles(const CompiledScene& scene);

// Number of elements for a size in metres.
size_t countElements(const CompiledScene& scene, double size);

// Size of elements that gives a scene about `elements` of them. Throws Error (badInput) if it has
// no triangle with an area.
double elementSizeOf(const CompiledScene& scene, size_t elements);

// The mesh of a scene whose surfaces are all of triangles; `size` in metres.
std::shared_ptr<const ElementMesh> makeElementMesh(const CompiledScene& scene, double size);

}  // namespace restlab
