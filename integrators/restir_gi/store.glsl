// Anchors and reservoirs to and from their buffers: the read and write of the cache.

RL_FN Anchor anchorUnpack(RL_IN(StoredAnchor) stored, RL_IN(Camera) camera) {
  Anchor a;
  a.posW = stored.posW;
  a.posError = stored.posError;
  a.nGeoW = stored.nGeoW;
  a.nShadeW = stored.nShadeW;
  a.isReusable = stored.isReusable;
  a.wo = cameraDirectionFrom(camera, stored.posW);
  a.bsdf.diffuse = stored.diffuse;
  a.bsdf.lobes = RL_LOBE_DIFFUSE;
  a.bsdf.f0 = vec3(0.0f, 0.0f, 0.0f);
  a.bsdf.f90 = 0.0f;
  a.bsdf.transmission = vec3(0.0f, 0.0f, 0.0f);
  a.bsdf.alpha = 1.0f;
  a.bsdf.eta = 1.0f;
  return a;
}

RL_FN void anchorUnpackGlossy(RL_INOUT(Anchor) a, RL_IN(StoredAnchorGlossy) stored) {
  a.bsdf.f0 = stored.f0;
  a.bsdf.f90 = stored.f90;
  a.bsdf.alpha = stored.alpha;
  a.bsdf.lobes = stored.lobes;
}

RL_FN Anchor cacheAnchorNow(uint slot) {
  Anchor a = anchorUnpack(gBuffers.anchors.data[slot], gFrame.camera);
  if (RL_HAS(RL_FEATURE_GLOSSY)) anchorUnpackGlossy(a, gBuffers.anchorsGlossy.data[slot]);
  return a;
}

RL_FN Anchor cacheAnchorBefore(uint slot) {
  Anchor a = anchorUnpack(gBuffers.previousAnchors.data[slot], gFrame.previousCamera);
  if (RL_HAS(RL_FEATURE_GLOSSY)) anchorUnpackGlossy(a, gBuffers.previousAnchorsGlossy.data[slot]);
  return a;
}

RL_FN void cacheWriteAnchor(uint slot, RL_IN(Anchor) a) {
  StoredAnchor stored;
  stored.posW = a.posW;
  stored.posError = a.posError;
  stored.nGeoW = a.nGeoW;
  stored.isReusable = a.isReusable;
  stored.nShadeW = a.nShadeW;
  stored.diffuse = a.bsdf.diffuse;
  gBuffers.anchors.data[slot] = stored;
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    StoredAnchorGlossy glossy;
    glossy.f0 = a.bsdf.f0;
    glossy.f90 = a.bsdf.f90;
    glossy.alpha = a.bsdf.alpha;
    glossy.lobes = a.bsdf.lobes;
    gBuffers.anchorsGlossy.data[slot] = glossy;
  }
}

RL_FN void cacheReadNow(uint slot, RL_OUT(LightReservoir) r) { r = gBuffers.lights.data[slot]; }
RL_FN void cacheReadBefore(uint slot, RL_OUT(LightReservoir) r) {
  r = gBuffers.lightsHistory.data[slot];
}
RL_FN void cacheWriteNow(uint slot, RL_IN(LightReservoir) r) { gBuffers.lights.data[slot] = r; }
RL_FN void cacheWriteHistory(uint slot, RL_IN(LightReservoir) r) {
  gBuffers.lightsHistory.data[slot] = r;
}

RL_FN void cacheReadNow(uint slot, RL_INOUT(PathReservoir) r) {
  r.vertex = gBuffers.paths.data[slot];
  r.state = r.vertex.state;
  if (RL_HAS(RL_FEATURE_GLOSSY)) r.suffix = gBuffers.suffixes.data[slot];
}
RL_FN void cacheReadBefore(uint slot, RL_INOUT(PathReservoir) r) {
  r.vertex = gBuffers.pathsHistory.data[slot];
  r.state = r.vertex.state;
  if (RL_HAS(RL_FEATURE_GLOSSY)) r.suffix = gBuffers.suffixesHistory.data[slot];
}
RL_FN void cacheWriteNow(uint slot, RL_IN(PathReservoir) r) {
  PathVertex v = r.vertex;
  v.state = r.state;
  gBuffers.paths.data[slot] = v;
  if (RL_HAS(RL_FEATURE_GLOSSY)) gBuffers.suffixes.data[slot] = r.suffix;
}
RL_FN void cacheWriteHistory(uint slot, RL_IN(PathReservoir) r) {
  PathVertex v = r.vertex;
  v.state = r.state;
  gBuffers.pathsHistory.data[slot] = v;
  if (RL_HAS(RL_FEATURE_GLOSSY)) gBuffers.suffixesHistory.data[slot] = r.suffix;
}

// The state alone: merges decide by it, and only the winner's payload has to be moved.
RL_FN void cacheReadStateNow(uint slot, RL_INOUT(LightReservoir) r) {
  r.state = gBuffers.lights.data[slot].state;
}
RL_FN void cacheReadStateBefore(uint slot, RL_INOUT(LightReservoir) r) {
  r.state = gBuffers.lightsHistory.data[slot].state;
}
RL_FN void cacheWriteStateNow(uint slot, RL_IN(LightReservoir) r) {
  gBuffers.lights.data[slot].state = r.state;
}
RL_FN void cacheWriteStateHistory(uint slot, RL_IN(LightReservoir) r) {
  gBuffers.lightsHistory.data[slot].state = r.state;
}
RL_FN void cacheReadStateNow(uint slot, RL_INOUT(PathReservoir) r) {
  r.state = gBuffers.paths.data[slot].state;
}
RL_FN void cacheReadStateBefore(uint slot, RL_INOUT(PathReservoir) r) {
  r.state = gBuffers.pathsHistory.data[slot].state;
}
RL_FN void cacheWriteStateNow(uint slot, RL_IN(PathReservoir) r) {
  gBuffers.paths.data[slot].state = r.state;
}
RL_FN void cacheWriteStateHistory(uint slot, RL_IN(PathReservoir) r) {
  gBuffers.pathsHistory.data[slot].state = r.state;
}

// A slot's sample as its k-th partner sees it.
RL_FN uint cacheExchangeIndex(uint slot, uint k) { return slot * gParams.spatialNeighbours + k; }
RL_FN void cacheWriteShifted(uint index, RL_IN(LightReservoir) r, RL_IN(Shifted) s) {
  gBuffers.shiftedLights.data[index] = s;
}
RL_FN void cacheWriteShifted(uint index, RL_IN(PathReservoir) r, RL_IN(Shifted) s) {
  gBuffers.shiftedPaths.data[index] = s;
}
RL_FN void cacheReadShifted(uint index, RL_IN(LightReservoir) r, RL_OUT(Shifted) s) {
  s = gBuffers.shiftedLights.data[index];
}
RL_FN void cacheReadShifted(uint index, RL_IN(PathReservoir) r, RL_OUT(Shifted) s) {
  s = gBuffers.shiftedPaths.data[index];
}
