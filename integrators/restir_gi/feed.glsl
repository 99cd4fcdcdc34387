// restir_gi, feed pass of caches in world space: each entry that was seen merges samples that
// pixels have offered in this frame. An offer is the sample that the pixel found in this frame
// alone, at this frame's film sample. The entry's own sample is shifted to the offer's x1, so that
// the merge is right for each film sample on its own. A new entry begins with an offer, at the x1
// that the offer started from: the offer is a valid sample there, and for no other point. An entry
// without feeders may forget (change.glsl).
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "core/payload/path_shift.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/caches/entries/entries.glsl"
#include "core/caches/entries/surface.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/change.glsl"

#define RL_REUSE_STATE GiWithEntries

RL_FN bool reuseDonor(RL_IN(GiWithEntries) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  if (s.id[k] == RL_INVALID) return false;
  donor = giReadOfferState(entryOfferer(s.id[k]));
  return true;
}
RL_FN Shifted reuseOurs(RL_IN(GiWithEntries) s, uint k) { return s.ours[k]; }
RL_FN Shifted reuseTheirs(RL_IN(GiWithEntries) s, uint k) { return s.theirs[k]; }
RL_FN real3 reuseRatio(RL_IN(GiWithEntries) s, uint k) {
  uint slot = entryOfferer(s.id[k]);
  VisibleSurface donor = visibleRead(gBuffers.visible, gFrame.camera, slot);
  return reuseReflectanceRatio(donor.reflectance,
                               anchorRead(gBuffers.anchors, s.slot).surface.reflectance,
                               gParams.maxReflectanceRatio);
}
RL_FN real reuseUniform(RL_IN(GiWithEntries) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/reuse.glsl"

// Traces three rays per offer: the camera ray to the offer's x1, from that x1 to the entry's
// sample, and from the anchor to the offer's sample. If the entry has no anchor, the first offer
// that shows the pixel's surface provides it: `here` becomes that offer, and the entry begins.
// Returns whether the entry has begun.
RL_FN bool giAskOffers(RL_INOUT(GiWithEntries) s, RL_INOUT(PathReservoir) here,
                       RL_INOUT(Anchor) anchor) {
  bool isNew = anchor.surface.isHit == 0u;
  bool hasBegun = false;
  bool hasX1 = false;
  PathReservoir offer = here;
  Surface x1 = anchorSurface(anchorNone());
  for (uint i = 0u; i < 3u * RL_ENTRY_FEEDERS; i = i + 1u) {
    uint k = i / 3u;
    uint leg = i - 3u * k;
    uint group = s.id[k];
    if (group == RL_INVALID || hasBegun) continue;
    uint slot = entryOfferer(group);
    PathShift shift = pathShiftNone();
    if (leg == 0u) {
      giReadOffer(slot, offer);
      shift.ray = cameraFilmRay(gFrame.camera, pixelOfSlot(slot), offer.path.film);
      shift.asks = RL_SHIFT_ASKS_X1;
    } else if (leg == 1u) {
      if (!isNew && hasX1) shift = pathShiftToSurface(here, x1);
    } else if (anchor.surface.isHit != 0u) {
      shift = pathShiftToSurface(offer, anchorSurface(anchor));
    }
    if (shift.asks != RL_SHIFT_DONE) {
      Hit hit = traceNoHit();
      uint mode = leg == 0u ? RL_RAY_PATH : RL_RAY_SHADOW;
      uint key = pathShiftKey(mode, offer.path.film);
      float transmittance = traceRay(shift.ray, mode, key, hit);
      if (leg != 0u) {
        shift.shifted.F *= transmittance;
      } else {
        hasX1 = false;
        if (hit.instance != RL_INVALID) {
          x1 = surfaceLoad(hit, shift.ray.dir);
          hasX1 = pathIsReusable(x1.bsdf);
        }
        if (!hasX1) s.id[k] = isNew ? RL_INVALID : group;
        if (hasX1 && isNew) {
          VisibleSurface shown = visibleRead(gBuffers.visible, gFrame.camera, slot);
          Anchor candidate = anchorOfSurface(x1, slot);
          if (visibleAlike(shown, candidate.surface, gParams.partners.alike)) anchor = candidate;
        }
      }
    }
    if (leg == 1u) s.ours[k] = shift.shifted;
    if (leg == 2u) s.theirs[k] = shift.shifted;
    if (leg == 2u && isNew && anchor.surface.isHit != 0u) {
      hasBegun = true;
      here = offer;
      here.state.F = shift.shifted.F;
      here.state.residual = vec3(0.0f, 0.0f, 0.0f);
      if (!(reuseTarget(here.state.F) > 0.0f)) here.state.W = 0.0f;
      here.path.geometry *= shift.shifted.jacobian;
    }
  }
  return hasBegun;
}

RL_FN void giForgetOutOfView(uint entry) {
  float kept = giKeptOutOfView(entry);
  if (kept == 1.0f) return;
  Anchor anchor = anchorRead(gBuffers.anchors, entry);
  if (anchor.surface.isHit == 0u) return;
  PathReservoir here;
  here.path.suffix = pathNoSuffix();
  giReadEntry(entry, here);
  here.state.confidence *= kept;
  giWriteEntry(entry, here);
  if (!(kept > 0.0f)) anchorWrite(gBuffers.anchors, entry, anchorNone());
}

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  if (entry >= gParams.entries.count) return;
  GiWithEntries s;
  s.slot = entry;
  uint first = RL_INVALID;
  for (uint k = 0u; k < RL_ENTRY_FEEDERS; k = k + 1u) {
    uint ticket = gBuffers.feeders.data[entry * RL_ENTRY_FEEDERS + k];
    s.id[k] = ticket != 0u ? entryOfTicket(ticket) : RL_INVALID;
    if (ticket != 0u && first == RL_INVALID) first = k;
  }
  if (first == RL_INVALID) {
    giForgetOutOfView(entry);
    return;
  }
  Anchor anchor = anchorRead(gBuffers.anchors, entry);
  PathReservoir here;
  here.path.suffix = pathNoSuffix();
  giReadEntry(entry, here);
  // Share kept, as found at the pixel of the first feeder.
  float kept = giKept(entryOfferer(s.id[first]));
  here.state.confidence = reuseCapped(here.state.confidence, gParams.entries.cap) * kept;
  bool isForgotten = !(kept > 0.0f);
  if (isForgotten) anchor = anchorNone();
  bool isNew = anchor.surface.isHit == 0u;
  if (isNew) here.state = reservoirEmpty();
  bool hasBegun = giAskOffers(s, here, anchor);
  if (isNew) {
    if (!hasBegun && !isForgotten) return;
    anchorWrite(gBuffers.anchors, entry, anchor);
    reservoirGuard(here.state);
    giWriteEntry(entry, here);
    return;
  }
  s.rng = rngInit(gFrame.seed, entry, gFrame.frame);
  s.rng.vertex = RL_VERTEX_FEED;
  uint winner;
  float jacobian;
  reuseMerge(s, RL_ENTRY_FEEDERS, gParams.spatialFlags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner != RL_INVALID) {
    giTakeOfferPath(entryOfferer(s.id[winner]), here);
    here.path.geometry *= jacobian;
  }
  giWriteEntry(entry, here);
}
