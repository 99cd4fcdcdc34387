#include "core/scene/gltf/triangles.h"

#include <fmt/format.h>

#include <numeric>

#include "core/scene/gltf/accessor.h"

namespace restlab::gltf {
namespace {

std::vector<uint32_t> readIndices(const tinygltf::Model& model, int accessorIndex,
                                  size_t vertexCount, const std::string& place, Report& report) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(accessorIndex)];
  const bool isUnsigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned || accessor.normalized) {
    report.fail(place, fmt::format("accessors[{}] is {}; unsigned integer scalars expected",
                                   accessorIndex, formatOf(accessor)));
  }
  const AccessorReader reader(model, accessorIndex);
  const uint64_t bits = 8u * static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(
                                 static_cast<uint32_t>(accessor.componentType)));
  const uint64_t restart = (uint64_t(1) << bits) - 1;
  std::vector<uint32_t> indices(reader.count());
  for (size_t i = 0; i < indices.size(); ++i) {
    indices[i] = reader.index(i);
    if (indices[i] >= vertexCount) {
      report.fail(place, fmt::format("element {} of accessors[{}] is {}, but the primitive has {} "
                                     "vertices",
                                     i, accessorIndex, indices[i], vertexCount));
    }
    if (indices[i] == restart) {
      report.warn("restart index", place,
                  fmt::format("element {} is {}, the restart value that glTF "
                              "does not allow; read as a vertex",
                              i, restart));
    }
  }
  return indices;
}

}  // namespace

std::vector<glm::uvec3> readTriangles(const tinygltf::Model& model,
                                      const tinygltf::Primitive& primitive, size_t vertexCount,
                                      const std::string& place, Report& report) {
  std::vector<uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = readIndices(model, primitive.indices, vertexCount, place + ".indices", report);
  } else {
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  const size_t n = indices.size();
  std::vector<glm::uvec3> triangles;
  const auto incomplete = [&](size_t rest) {
    report.warn(
        "incomplete triangles", place,
        fmt::format("{} vertices do not make whole triangles; the last {} are left out", n, rest));
  };
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(n / 3);
    for (size_t i = 0; i + 2 < n; i += 3) {
      triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    if (n % 3 != 0) incomplete(n % 3);
    return triangles;
  }
  if (n < 3) {
    incomplete(n);
    return triangles;
  }
  const bool isStrip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  triangles.reserve(n - 2);
  for (size_t i = 0; i + 2 < n; ++i) {
    // Every second triangle of a strip runs the other way round; a fan ends at its first vertex.
    const glm::uvec3 triangle =
        isStrip ? glm::uvec3(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2])
                : glm::uvec3(indices[i + 1], indices[i + 2], indices[0]);
    // Skip degenerate triangles: they only stitch strips together.
    if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x) continue;
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace restlab::gltf
