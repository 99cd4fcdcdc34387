// Compressed geometry of glTF, without the file around it: a few numbers, then a stream.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/gltf/draco_mesh.h"
#include "core/scene/gltf/meshopt.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

namespace {

constexpr const char* kFile = "stream";

// Reads two bytes at the beginning.
uint32_t number(const uint8_t*& bytes, size_t& count) {
  const uint32_t value = count < 2 ? 0u : bytes[0] | uint32_t(bytes[1]) << 8;
  const size_t used = count < 2 ? count : 2;
  bytes += used;
  count -= used;
  return value;
}

}  // namespace

bool readDraco(const uint8_t* bytes, size_t count) {
  gltf::DracoRequest request;
  request.place = "mesh";
  request.source = "bufferViews[0]";
  request.indices = {"indices", "accessors[0]", 0, 5125, 1, 0, false, 4};
  request.indices.count = 3 * number(bytes, count);
  const uint64_t vertices = number(bytes, count);
  request.attributes = {{"POSITION", "accessors[1]", 0, 5126, 3, vertices, false, 4}};
  const uint32_t more = number(bytes, count);
  if (more & 1u)
    request.attributes.push_back({"NORMAL", "accessors[2]", 1, 5126, 3, vertices, false, 4});
  if (more & 2u)
    request.attributes.push_back({"COLOR_0", "accessors[3]", 2, 5123, 4, vertices, true, 2});
  request.bytes = bytes;
  request.size = count;
  return isRead(kFile, ExitCode::badInput, [&] {
    gltf::Report report(kFile);
    gltf::DracoBudget budget{uint64_t(1) << 28};
    gltf::decodeDracoMesh(request, budget, report);
  });
}

bool readMeshopt(const uint8_t* bytes, size_t count) {
  static const char* const kModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
  static const char* const kFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  const uint32_t kind = number(bytes, count), elements = number(bytes, count),
                 stride = number(bytes, count);
  std::vector<std::vector<uint8_t>> buffers = {{bytes, bytes + count}};
  return isRead(kFile, ExitCode::badInput, [&] {
    gltf::Report report(kFile);
    if (count == 0 || elements == 0 || stride == 0 || stride > 256)  // as the schema has it
      report.fail("", "no stream");
    const nlohmann::json extension = {{"buffer", 0u},
                                      {"byteLength", count},
                                      {"byteStride", stride},
                                      {"count", elements},
                                      {"mode", kModes[(kind & 255u) % 3]},
                                      {"filter", kFilters[(kind >> 8) % 4]}};
    nlohmann::json document = {
        {"buffers",
         {{{"byteLength", count}},
          {{"byteLength", elements * stride},
           {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}}},
        {"bufferViews",
         {{{"buffer", 1u},
           {"byteLength", elements * stride},
           {"extensions", {{"EXT_meshopt_compression", extension}}}}}}};
    gltf::checkMeshopt(document, report);
    buffers.push_back({0});
    gltf::decodeMeshopt(document, buffers, report);
  });
}

}  // namespace restlab::fuzz
