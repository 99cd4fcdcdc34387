// EXT_meshopt_compression: buffer views whose bytes are compressed.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Returns whether a buffer only stands where decoded bytes would: it is not loaded.
bool isMeshoptFallback(const nlohmann::json& buffer);

// Checks every compressed view: its range, mode, filter, stride and size. Checks that only
// compressed views lie in fallback buffers. validateDocument() must have accepted the document.
void checkMeshopt(const nlohmann::json& document, Report& report);

// Decodes every compressed view into a buffer of its own, behind those of the document. `buffers`
// holds the bytes of each buffer; checkMeshopt() must have accepted the document. Fails on a
// damaged stream.
void decodeMeshopt(nlohmann::json& document, std::vector<std::vector<uint8_t>>& buffers,
                   Report& report);

}  // namespace restlab::gltf
