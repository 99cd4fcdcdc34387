// First hits: the surfaces that the eye sees straight are found by rays, or by the rasteriser
// (core/raster/raster.h).
#pragma once

#include "core/frame/frame_graph.h"
#include "core/frame/part.h"
#include "core/raster/raster.h"

namespace restlab {

// The parameter `first_hit`, for methods that have such surfaces, and FrameBuffers::rasterBoxes.
// Goes before the parts that ask for first hits.
const PartInfo& firstHitsPartInfo();
bool rasterisesFirstHits(const ParameterMap& parameters);

// Records a raster pass, unless a part before has done so, and returns its hits. Not there if rays
// are to find them. At pixel centres: recorded in frames of a new view alone. At the frame's film
// sample: all pixels then have one (FrameData::sharesFilm).
Buffer recordCentreHits(FrameGraph& g, const FrameInfo& f);
Buffer recordFilmHits(FrameGraph& g, const FrameInfo& f);

// For raster passes of others.
rl::RasterParams rasterParams(const CompiledScene& scene, bool isAtCentre, bool hasLight);
// RasterBuffers::boxes; empty if the scene has no shapes.
std::shared_ptr<const std::vector<uint32_t>> rasterBoxWords(const CompiledScene& scene);

}  // namespace restlab
