// restir_gi, temporal pass, in frames of a new view: merges the last frame's reservoir of the
// pixel's surface into this frame's. (In a still view the initial pass merges both, without a ray.)
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/resampling/reproject.glsl"
#include "integrators/restir_gi/reservoir_store.glsl"
#include "integrators/restir_gi/temporal_merge.glsl"
#include "core/caches/entries/groups.glsl"
#include "integrators/restir_gi/history_weight.glsl"
#include "integrators/restir_gi/reflectance_ratio.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  if (gParams.temporalReuse == 0u || gParams.reproject == 0u) return;
  uint before = reprojectedPixelIndex(pixelIndex);
  if (before == RL_INVALID) return;
  uint flags = gParams.temporalFlags;
  PathReservoir here;
  here.path.suffix = pathNoSuffix();
  PathReservoir donor = here;
  giReadNow(pixelIndex, here);
  giReadBefore(before, donor);
  GiTemporalMerge t;
  // Share kept, as found at the donor's pixel.
  float kept = giHistoryWeight(before);
  if (!(kept > 0.0f)) return;
  giBeginTemporalMerge(t, donor.state, pixelIndex);
  t.donor.confidence *= kept;
  t.ratio = giReflectanceRatio(visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before),
                               pixelIndex);
  // Shift the pixel's own sample to the last frame, then the last frame's sample to the pixel.
  PathShift shift =
      pathShiftTo(here, pixelOfIndex(before), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
  PathSample path = here.path;
  t.canonicalAtNeighbour = shift.shifted;
  for (uint i = 0u; i < 2u; i = i + 1u) {
    if (i == 1u) {
      t.canonicalAtNeighbour = shift.shifted;
      shift = pathShiftTo(donor, pixel, false, (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u);
      path = donor.path;
    }
    pathShiftTrace(shift, path);
  }
  t.neighbourAtCanonical = shift.shifted;
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, flags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner == RL_INVALID) {
    giWriteStateNow(pixelIndex, here);
  } else {
    here.path = donor.path;
    here.path.geometry *= jacobian;
    giWriteNow(pixelIndex, here);
  }
}
