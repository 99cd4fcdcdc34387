// KHR_draco_mesh_compression: primitives whose geometry is compressed.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/gltf/report.h"
#include "core/scene/gltf/tinygltf.h"

namespace restlab::gltf {

// Moves the indices of compressed primitives into their extension, as tinygltf takes no indices
// without a buffer view. validateDocument() must have accepted the document.
void hideDracoIndices(nlohmann::json& document);

// Decodes every compressed primitive into new buffers and makes its accessors refer to them.
// Accessors' bounds are not checked yet; those of compressed primitives agree with the streams
// afterwards. An accessor that others use, too, stays as it is, and the primitive gets a copy. The
// document that the model was made of had its indices hidden.
void decodeDraco(tinygltf::Model& model, Report& report);

}  // namespace restlab::gltf
