// Buffers, parameters and state of the passes of reuse (core/reuse/README.md). A method's Params
// struct has `reuse` (ReuseParams), `pairs` (which pixels are neighbours), `entries` (reservoirs in
// world space), `cells` (radiance cache) and `changes` (temporal gradients), and what its samples
// need.
#ifndef RL_REUSE_H
#define RL_REUSE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/radiance_cache/radiance.h"
#include "core/resampling/pairs.h"
#include "core/resampling/reservoir.h"
#include "core/temporal_gradients/changes.h"

RL_NAMESPACE_BEGIN

// State of the temporal merge: one donor.
struct TemporalMerge {
  ReservoirState donor;  // confidence is capped
  Shifted canonicalAtNeighbour;
  Shifted neighbourAtCanonical;
  vec3 ratio;
  float u;
};

// State of the spatial merge: the neighbours are the donors.
struct SpatialMerge {
  uint pixelIndex;
  float share;  // factor of the donors' confidence
  Rng rng;
};

// State of the merge of a pixel with its entries, and of an entry with the candidates of pixels: up
// to RL_MAX_DONORS donors.
struct CacheMerge {
  uint owner;       // whose reservoir it is: a pixel; or an entry
  uint donorId[4];  // entries; or groups of pixels. RL_INVALID: none
  Shifted canonicalAtNeighbour[4];
  Shifted neighbourAtCanonical[4];
  Rng rng;
};

// Pixels to each side of the square in which equal samples are counted, and the other pixels of it.
const uint RL_DUPLICATES_RADIUS = 8u;
const float RL_DUPLICATES_MOST = 288.0f;

// Number of samples in the average of a pixel's unresampled light.
struct UnresampledCount {
  uint taken;   // film samples that light_edges took when the view was new; 8 bits
  uint level;   // of the light in view: 0 none, else the exponent of its luminance; 8 bits
  uint frames;  // frames of this view, less those that were forgotten; 16 bits. From light_edges:
                // 1, if the samples are to be forgotten in a still view
};

// The light in view ends where its levels differ by more: by a factor of 4 to 16.
const uint RL_LEVELS_OF_AN_EDGE = 2u;
const uint RL_LIGHT_IN_VIEW_SEED = 0x7f4a7c15u;

struct ReuseBuffers {
  Uvec4Ref gbuffer;  // core/gbuffer/gbuffer.h
  Uvec4Ref gbufferPrevious;
  // From caches in world space (core/caches/README.md).
  UintRef proposals;
  Uvec4Ref shadingPoints;
  UintRef insertions;
  RadianceBuffers cells;
  UintRef changes;  // core/temporal_gradients
  Vec3Ref radiance;
  FloatRef radianceFrames;  // frames that each pixel's radiance averages, this one included
  // One uvec4 per pixel: light that no other pixel could reuse, averaged over time in a still view,
  // and its UnresampledCount. light_edges leaves its light here for the initial pass.
  Uvec4Ref unresampled;
  Uvec4Ref unresampledPrevious;
  Uvec4Ref reservoirs;  // of this frame: initial, then temporal, or of the round before
  // The last frame's. In still views with a cache the initial pass leaves candidates here; the
  // spatial pass writes its result. In a round before the last this is another buffer, for the
  // reservoirs of the next round.
  Uvec4Ref history;
  // Between the spatial_shift and the spatial pass, a buffer for each of up to RL_MAX_DONORS
  // neighbours: the pixel's sample shifted to the neighbour, and the neighbour's pixel index
  // (RL_INVALID: none). Buffers of their own, so that each can share memory.
  Uvec4Ref pairedShifts0;
  Uvec4Ref pairedShifts1;
  Uvec4Ref pairedShifts2;
  Uvec4Ref pairedShifts3;
  UintRef outlines;  // 1: a pixel beside it shows another surface
  // With duplicationMap: the film sample of each pixel's sample, which names it (0: none), and how
  // many pixels around it hold the same.
  UintRef sampleFilms;
  UintRef duplicates;
  // For caches in world space: reservoirs of entries (core/caches/entries/entries.glsl).
  Uvec4Ref entryReservoirs;
};

struct ReuseParams {
  uint temporalFlags;  // RL_REUSE_*
  uint spatialFlags;
  uint spatialNeighbours;  // donors of young histories; at least agedNeighbours
  uint agedNeighbours;
  uint youngFrames;  // after so many still frames no history is young
  uint lightEdgeSamples;
  float donorNoise;    // donors' confidence is scaled by 1 / (1 + this (age - 1))
  uint temporalReuse;  // 0: off
  uint reproject;      // 0: no reprojection
  float confidenceCap;
  float movingConfidenceCap;  // in frames of a new view
  float maxReflectanceRatio;  // bound per channel on the reflectance ratio of residuals
  uint spatialFeedback;       // 1: the last spatial merge is the history, 0: what went into it
  uint duplicationMap;        // 1: samples that many pixels hold have a lower cap
  uint spatialRounds;         // merges with neighbours, one after another
  uint spatialRound;          // number of this pass's round; the last one shades
  uint writesRadianceFrames;  // 1: a denoiser reads them
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS ReuseBuffers

#endif
