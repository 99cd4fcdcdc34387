// Kinds of shapes beside triangles, for the host: what kernels see of them is in
// core/geometry/shapes.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dialect/features.h"
#include "core/scene/scene.h"

namespace restlab {

class ConfigTable;

struct ShapeParameter {
  std::string name;
  double fallback = 0.0, lo = 0.0, hi = 0.0;  // inclusive
  std::string help;
  bool isWhole = false;  // takes whole numbers alone
};

// A shape of a kind beside the one of default parameters, for tests and pictures.
struct ShapeExample {
  std::string name;
  std::vector<float> values;
  std::vector<uint32_t> words{};
};

// Where a shape of a scene file stands.
struct ShapePlace {
  std::vector<glm::dmat4> toWorld;   // of each instance, at least one
  std::vector<SceneCamera> cameras;  // none: not known yet
};

struct NamedFile {
  std::string name;  // for error lines
  std::vector<uint8_t> bytes;
};

// Reads a file that a [[shape]] names at `place`, of at most `mostBytes`. Throws Error (badInput).
using ShapeFiles =
    std::function<NamedFile(const std::string& name, const std::string& place, uint64_t mostBytes)>;

// One kind of shapeRegistry(). Functions take a shape of that kind with a value for each parameter,
// within its range.
struct ShapeInfo {
  std::string name;
  std::string summary;
  uint32_t kind = rl::RL_SHAPE_TRIANGLES;
  rl::FeatureMask feature = 0;
  std::vector<ShapeParameter> parameters;  // words of a kernel in this order, four a uvec4
  bool isConvex = false;                   // a ray that leaves to the outside never meets it again
  // Returns whether it has an inside that no ray leaves unseen.
  std::function<bool(const ShapeGeometry& shape)> isClosed;
  // Returns whether a point of its own space is inside; called of closed ones alone.
  std::function<bool(const ShapeGeometry& shape, const glm::dvec3& posL)> isInside;
  bool isFlat = false;  // in the plane z = 0, outside on +z
  // Light samples find its points. Otherwise lamps of the kind are found by scattering alone.
  bool hasDraws = true;
  std::vector<ShapeExample> examples;  // of a kind that reads more than parameters: at least one
  // Box around the shape in its own space (low, high).
  std::function<std::array<glm::vec3, 2>(const ShapeGeometry& shape)> box;
  // Triangles near the surface, counter-clockwise seen from its outside: for outlines, areas,
  // bounds and tests of what is inside.
  std::function<MeshGeometry(const ShapeGeometry& shape)> standIn;
  // Reads the keys of a [[shape]] that are not parameters, into ShapeGeometry::words. Throws Error
  // (badInput). Not set: there are none.
  std::function<void(const ConfigTable& table, const ShapeFiles& files, ShapeGeometry& shape)>
      read{};
  bool readsFile = false;  // knows the key 'file'
  // Reads a [[shape]] that becomes triangles; nullopt if it is to be met exactly. Throws Error
  // (badUsage). Not set: none does.
  std::function<std::optional<MeshGeometry>(const ConfigTable& table, const ShapePlace& place)>
      readMesh{};
};

// In the order of shapes.list.
const std::vector<ShapeInfo>& shapeRegistry();
// nullptr if there is none.
const ShapeInfo* findShape(const std::string& name);

// A shape of each kind and of each of its examples, by name: the kind's where it has its default
// parameters.
struct NamedShape {
  std::string name;
  ShapeGeometry shape;
};
const std::vector<NamedShape>& namedShapes();

// A geometry of that shape with the stand-in as its triangles.
MeshGeometry makeShape(ShapeGeometry shape, const std::string& name);
// Parameters, and behind them the words, as uvec4s that kernels read: both begin with a uvec4.
std::vector<glm::uvec4> shapeWords(const ShapeGeometry& shape);

// Grid of columns x rows cells over at(u, v), u and v in [0, 1]; counter-clockwise seen from where
// cross(d/du, d/dv) points. Vertices at u = 1 are those at u = 0.
MeshGeometry turnedGrid(uint32_t columns, uint32_t rows,
                        const std::function<glm::vec3(float u, float v)>& at);
// The unit disk at that height, seen from +z (or -z).
void addDisk(MeshGeometry& mesh, float z, bool isFromBelow, uint32_t segments);

}  // namespace restlab
