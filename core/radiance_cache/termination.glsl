// Ends paths in radiance cells. A path ends at the first vertex beyond x1 that lies on a rough
// surface, where its spread is at least the cell's side (times `footprint`), and whose cell has
// enough samples. Biased: a cell has one radiance for all its points and, times their reflectance,
// for all directions. The includer has gBuffers.cells and gParams.cells, and includes
// core/caches/entries/groups.glsl.
#include "core/radiance_cache/key.glsl"

// Hook of core/transport/walk.glsl; the state has a CacheTermination `end`.
#define RL_WALK_END(state, walk, surface, radiance) \
  cacheTerminates(state.end, walk, surface, radiance)

// Initial state of a pixel's path. Pixels of a group take turns to ask for a ray
// (core/caches/entries/groups.glsl).
RL_FN CacheTermination cacheTerminationBegin(uint pixelIndex) {
  CacheTermination end;
  end.spread = 0.0f;
  end.group = RL_INVALID;
  if (gParams.cells.count == 0u) return end;
  uint group = groupOfPixel(pixelIndex, gParams.cells.every);
  if (groupCandidatePixel(group, gParams.cells.every) != pixelIndex) return end;
  end.group = group;
  RL_WRITE_UVEC4(gBuffers.cells.rays, group * RL_RADIANCE_RAY_UVEC4S, uvec4(0u, 0u, 0u, 0u));
  return end;
}

// Returns whether the path ends at this vertex; `radiance` is what the cell sends back along the
// path.
RL_FN bool cacheTerminates(RL_INOUT(CacheTermination) end, RL_IN(Walk) walk, RL_IN(Surface) s,
                           RL_OUT(vec3) radiance) {
  radiance = vec3(0.0f, 0.0f, 0.0f);
  if (gParams.cells.count == 0u || walk.bounces == 0u) return false;
  // Add up over the path the square root of the area that one sample of the density stands for
  // (Mueller et al. 2021, "Real-time Neural Radiance Caching", section 3.4).
  if (walk.pdfBsdf > 0.0f) {
    float cosine = abs(dot(s.nGeoW, walk.ray.dir));
    end.spread += distance(walk.ray.origin, s.posW) / sqrt(max(walk.pdfBsdf * cosine, 1.0e-12f));
  }
  if (!(end.spread >= gParams.cells.footprint * radianceSide(gParams.cells, s.posW))) return false;
  if (!bsdfIsReusable(s.bsdf, gParams.cells.minAlpha)) return false;
  if (RL_HAS(RL_FEATURE_VOLUME) && !rlIsBlack(walk.sigma)) return false;
  if (end.group != RL_INVALID) {
    uint at = end.group * RL_RADIANCE_RAY_UVEC4S;
    RL_WRITE_UVEC4(gBuffers.cells.rays, at, recordUvec4(walk.ray.origin, walk.bounces));
    RL_WRITE_UVEC4(gBuffers.cells.rays, at + 1u, recordUvec4(walk.ray.dir, 0u));
    end.group = RL_INVALID;
  }
  uvec2 key = radianceKey(gParams.cells, s.posW, s.nGeoW);
  uint cell = gridFind(gParams.cells.grid, gBuffers.cells.keys, key);
  if (cell == RL_INVALID) return false;
  uvec4 light = RL_EARLIER_UVEC4(gBuffers.cells.light, cell);
  if (uintBitsToFloat(light.w) < gParams.cells.leastCount) return false;
  uvec4 place = RL_EARLIER_UVEC4(gBuffers.cells.places, cell);
  if (!radianceFaces(place, s.nGeoW)) return false;
  if (!radianceSees(place, s.posW, s.nGeoW, s.posError)) return false;
  radiance = recordVec3(light) * bsdfReflectance(s.bsdf);
  return true;
}
