// Types, buffers and parameters of the `restir_gi` kernels.
#ifndef RL_RESTIR_GI_H
#define RL_RESTIR_GI_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/changes/changes.h"
#include "core/payload/path_gather.h"
#include "core/payload/path_sample.h"
#include "core/payload/path_shift.h"
#include "core/resampling/partners.h"

RL_NAMESPACE_BEGIN

// The merge over time: of one donor.
struct GiOverTime {
  ReservoirState donor;  // its confidence capped
  Shifted ours;
  Shifted theirs;
  vec3 ratio;
  float u;
};

// The merge over space: of the slot's partners.
struct GiOverSpace {
  uint slot;
  float share;  // of their confidence
  Rng rng;
};

// The merge of a pixel with its entries, and that of an entry with what pixels offer: of
// RL_MAX_DONORS donors.
struct GiWithEntries {
  uint slot;   // of the pixel; the entry
  uint id[4];  // entries; groups of pixels. RL_INVALID: none
  Shifted ours[4];
  Shifted theirs[4];
  Rng rng;
};

// What a pixel's own light is the average of.
struct GiOwnCount {
  uint taken;   // film samples of which lights_in_view took light in view when the view was new
  uint frames;  // of this view, but for those whose light is forgotten
};

struct RestirGiBuffers {
  QuadRef visible;  // core/dialect/visible.h
  QuadRef visibleBefore;
  // Of caches in world space (core/caches/README.md).
  UintRef proposals;
  QuadRef anchors;
  UintRef feeders;
  RadianceBuffers cells;
  UintRef changes;  // core/changes
  Vec3Ref radiance;
  // One quad: light that no other pixel could use, averaged over time in a still view, and its
  // GiOwnCount. lights_in_view leaves its light here for the initial pass.
  QuadRef own;
  QuadRef ownBefore;
  QuadRef reservoirs;  // of this frame: initial, then temporal
  QuadRef history;  // of the last frame, in still views then offers; replaced by the spatial pass
  QuadRef suffixes;
  QuadRef suffixesHistory;
  // Between the exchange and the spatial pass, spatialNeighbours entries a pixel: its sample as the
  // partner sees it, and the partner's slot (RL_INVALID: none).
  QuadRef exchange;
  UintRef outlines;  // 1: a pixel beside it shows another surface
  // Of caches in world space: reservoirs of entries (core/caches/entries/entries.glsl).
  QuadRef entryReservoirs;
  QuadRef entrySuffixes;
};

struct RestirGiParams {
  uint temporalFlags;  // RL_REUSE_*
  uint spatialFlags;
  uint spatialNeighbours;  // of young histories; at least agedNeighbours
  uint agedNeighbours;
  uint settledFrames;  // after so many still frames none is young
  uint lightEdgeSamples;
  float donorNoise;    // reuseDonorShare()
  uint temporalReuse;  // 0: off
  uint reproject;      // 0: pixels do not follow surfaces
  float confidenceCap;
  float movingConfidenceCap;  // of frames of a new view
  float maxReflectanceRatio;  // per channel, of surfaces, for the carried per-channel estimates
  PathParams path;
  PartnerParams partners;
  EntryParams entries;
  RadianceParams cells;
  ChangeParams changes;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RestirGiBuffers
#define RL_KERNEL_PARAMS RestirGiParams

#endif
