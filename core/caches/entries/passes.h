// Passes and buffers of a frame that caches of entries share.
#pragma once

#include <string>

#include "core/frame/frame_graph.h"

namespace restlab {

struct EntryBuffers {
  Buffer surfaces;
  Buffer proposals;      // per pixel: entries.proposals entries
  Buffer shadingPoints;  // this and the next four: per entry
  Buffer insertions;
  Buffer keys, seen, claims;
  Buffer entryOfPixel;
};

// Declares the buffers, and shares those that integrators read.
EntryBuffers entryBuffers(FrameGraph& graph, const FrameInfo& frame);

// Records the passes of a cache: kernels <name>_clear, _find, _claim, _resolve_claims,
// _find_after_claims, _propose, _insertions (core/caches/entries/*.glsl). `shapes`: a buffer of the
// cache's own that tells where its entries lie.
void recordEntries(const FrameInfo& frame, const std::string& name, const EntryBuffers& buffers,
                   Buffer shapes, const Kernels& kernels);

}  // namespace restlab
