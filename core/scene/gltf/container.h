// A .gltf or .glb file split into its JSON document and the binary chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

struct Container {
  nlohmann::json json;                         // an object
  std::optional<std::vector<uint8_t>> binary;  // the BIN chunk of a .glb
  std::vector<uint8_t> fileBytes;              // all of a .gltf; a .glb without its BIN chunk
  uint64_t missingBytes = 0;                   // how much a .glb is shorter than its header says
};

// Reads the first `bytes` bytes of a regular file (all of it by default). Fails at `place`.
std::vector<uint8_t> readFile(const std::filesystem::path& file, const std::string& place,
                              Report& report, uint64_t bytes = UINT64_MAX);

// Reads a file, checks the GLB structure and parses the JSON. The first bytes decide whether the
// file is a .glb or a .gltf.
Container readContainer(const std::filesystem::path& file, Report& report);

}  // namespace restlab::gltf
