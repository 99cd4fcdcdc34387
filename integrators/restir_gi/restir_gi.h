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

// State of the temporal merge: one donor.
struct GiOverTime {
  ReservoirState donor;  // confidence is capped
  Shifted ours;
  Shifted theirs;
  vec3 ratio;
  float u;
};

// State of the spatial merge: the slot's partners are the donors.
struct GiOverSpace {
  uint slot;
  float share;  // factor of the donors' confidence
  Rng rng;
};

// State of the merge of a pixel with its entries, and of an entry with the offers of pixels: up to
// RL_MAX_DONORS donors.
struct GiWithEntries {
  uint slot;   // slot of the pixel; or the entry
  uint id[4];  // entries; or groups of pixels. RL_INVALID: none
  Shifted ours[4];
  Shifted theirs[4];
  Rng rng;
};

// Number of samples in the average of a pixel's own light.
struct GiOwnCount {
  uint taken;   // film samples that lights_in_view took when the view was new
  uint frames;  // frames of this view, less those that were forgotten
};

struct RestirGiBuffers {
  QuadRef visible;  // core/dialect/visible.h
  QuadRef visibleBefore;
  // From caches in world space (core/caches/README.md).
  UintRef proposals;
  QuadRef anchors;
  UintRef feeders;
  RadianceBuffers cells;
  UintRef changes;  // core/changes
  Vec3Ref radiance;
  // One quad per pixel: light that no other pixel could reuse, averaged over time in a still view,
  // and its GiOwnCount. lights_in_view leaves its light here for the initial pass.
  QuadRef own;
  QuadRef ownBefore;
  QuadRef reservoirs;  // reservoirs of this frame: initial, then temporal
  QuadRef history;     // last frame's, in still views then offers; replaced by the spatial pass
  QuadRef suffixes;
  QuadRef suffixesHistory;
  // Between the exchange and the spatial pass, spatialNeighbours entries per pixel: the pixel's
  // sample shifted to the partner, and the partner's slot (RL_INVALID: none).
  QuadRef exchange;
  UintRef outlines;  // 1: a pixel beside it shows another surface
  // For caches in world space: reservoirs of entries (core/caches/entries/entries.glsl).
  QuadRef entryReservoirs;
  QuadRef entrySuffixes;
};

struct RestirGiParams {
  uint temporalFlags;  // RL_REUSE_*
  uint spatialFlags;
  uint spatialNeighbours;  // donors of young histories; at least agedNeighbours
  uint agedNeighbours;
  uint settledFrames;  // after so many still frames no history is young
  uint lightEdgeSamples;
  float donorNoise;    // reuseDonorShare()
  uint temporalReuse;  // 0: off
  uint reproject;      // 0: no reprojection
  float confidenceCap;
  float movingConfidenceCap;  // in frames of a new view
  float maxReflectanceRatio;  // bound per channel on the reflectance ratio of carried estimates
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
