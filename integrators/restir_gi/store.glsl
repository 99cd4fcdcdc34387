// Anchors and reservoirs to and from their buffers: the read and write of the cache. Reads are of
// what earlier passes left (RL_PAST_QUAD): no pass reads what it has written itself.

RL_FN Anchor anchorUnpack(RL_IN(uvec4) q0, RL_IN(uvec4) q1, RL_IN(uvec4) q2, RL_IN(uvec4) q3,
                          RL_IN(Camera) camera) {
  Anchor a;
  a.posW = recordVec3(q0);
  a.posError = uintBitsToFloat(q0.w);
  a.nGeoW = recordVec3(q1);
  a.isReusable = q1.w;
  a.nShadeW = recordVec3(q2);
  a.wo = cameraDirectionFrom(camera, a.posW);
  a.bsdf.diffuse = recordVec3(q3);
  a.bsdf.lobes = RL_LOBE_DIFFUSE;
  a.bsdf.f0 = vec3(0.0f, 0.0f, 0.0f);
  a.bsdf.f90 = 0.0f;
  a.bsdf.transmission = vec3(0.0f, 0.0f, 0.0f);
  a.bsdf.alpha = 1.0f;
  a.bsdf.eta = 1.0f;
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    a.bsdf.alpha = uintBitsToFloat(q2.w);
    a.bsdf.lobes = q3.w;
  }
  return a;
}

RL_FN Anchor cacheAnchorNow(uint slot) {
  uint at = slot * RL_GI_ANCHOR_QUADS;
  Anchor a =
      anchorUnpack(RL_PAST_QUAD(gBuffers.anchors, at), RL_PAST_QUAD(gBuffers.anchors, at + 1u),
                   RL_PAST_QUAD(gBuffers.anchors, at + 2u), RL_PAST_QUAD(gBuffers.anchors, at + 3u),
                   gFrame.camera);
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    uvec4 glossy = RL_PAST_QUAD(gBuffers.anchorsGlossy, slot);
    a.bsdf.f0 = recordVec3(glossy);
    a.bsdf.f90 = uintBitsToFloat(glossy.w);
  }
  return a;
}

RL_FN Anchor cacheAnchorBefore(uint slot) {
  uint at = slot * RL_GI_ANCHOR_QUADS;
  Anchor a = anchorUnpack(RL_PAST_QUAD(gBuffers.previousAnchors, at),
                          RL_PAST_QUAD(gBuffers.previousAnchors, at + 1u),
                          RL_PAST_QUAD(gBuffers.previousAnchors, at + 2u),
                          RL_PAST_QUAD(gBuffers.previousAnchors, at + 3u), gFrame.previousCamera);
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    uvec4 glossy = RL_PAST_QUAD(gBuffers.previousAnchorsGlossy, slot);
    a.bsdf.f0 = recordVec3(glossy);
    a.bsdf.f90 = uintBitsToFloat(glossy.w);
  }
  return a;
}

RL_FN void cacheWriteAnchor(uint slot, RL_IN(Anchor) a) {
  uint at = slot * RL_GI_ANCHOR_QUADS;
  RL_WRITE_QUAD(gBuffers.anchors, at, recordQuad(a.posW, floatBitsToUint(a.posError)));
  RL_WRITE_QUAD(gBuffers.anchors, at + 1u, recordQuad(a.nGeoW, a.isReusable));
  RL_WRITE_QUAD(gBuffers.anchors, at + 2u, recordQuad(a.nShadeW, floatBitsToUint(a.bsdf.alpha)));
  RL_WRITE_QUAD(gBuffers.anchors, at + 3u, recordQuad(a.bsdf.diffuse, a.bsdf.lobes));
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    RL_WRITE_QUAD(gBuffers.anchorsGlossy, slot, recordQuad(a.bsdf.f0, floatBitsToUint(a.bsdf.f90)));
  }
}

RL_FN ReservoirState stateUnpack(RL_IN(uvec4) q0, RL_IN(uvec4) q1) {
  ReservoirState state;
  state.F = recordVec3(q0);
  state.W = uintBitsToFloat(q0.w);
  state.residual = recordVec3(q1);
  state.confidence = uintBitsToFloat(q1.w);
  return state;
}

RL_FN void stateWrite(RL_IN(QuadRef) quads, uint at, RL_IN(ReservoirState) state) {
  RL_WRITE_QUAD(quads, at, recordQuad(state.F, floatBitsToUint(state.W)));
  RL_WRITE_QUAD(quads, at + 1u, recordQuad(state.residual, floatBitsToUint(state.confidence)));
}

RL_FN ReservoirState stateRead(RL_IN(QuadRef) quads, uint at) {
  return stateUnpack(RL_PAST_QUAD(quads, at), RL_PAST_QUAD(quads, at + 1u));
}

RL_FN void lightRead(RL_IN(QuadRef) quads, uint slot, RL_OUT(LightReservoir) r) {
  uint at = slot * RL_GI_LIGHT_QUADS;
  uvec4 q0 = RL_PAST_QUAD(quads, at);
  uvec4 q1 = RL_PAST_QUAD(quads, at + 1u);
  uvec4 q2 = RL_PAST_QUAD(quads, at + 2u);
  uvec4 q3 = RL_PAST_QUAD(quads, at + 3u);
  r.light.point = recordVec3(q0);
  r.light.kind = q0.w;
  r.light.normal = recordVec3(q1);
  r.light.pdf = uintBitsToFloat(q1.w);
  r.light.radiance = recordVec3(q2);
  r.light.posError = uintBitsToFloat(q2.w);
  r.light.cone = vec2(uintBitsToFloat(q3.x), uintBitsToFloat(q3.y));
  r.light.isTwoSided = q3.z;
  r.state = stateRead(quads, at + 4u);
}

RL_FN void lightWrite(RL_IN(QuadRef) quads, uint slot, RL_IN(LightReservoir) r) {
  uint at = slot * RL_GI_LIGHT_QUADS;
  RL_WRITE_QUAD(quads, at, recordQuad(r.light.point, r.light.kind));
  RL_WRITE_QUAD(quads, at + 1u, recordQuad(r.light.normal, floatBitsToUint(r.light.pdf)));
  RL_WRITE_QUAD(quads, at + 2u, recordQuad(r.light.radiance, floatBitsToUint(r.light.posError)));
  RL_WRITE_QUAD(quads, at + 3u,
                uvec4(floatBitsToUint(r.light.cone.x), floatBitsToUint(r.light.cone.y),
                      r.light.isTwoSided, 0u));
  stateWrite(quads, at + 4u, r.state);
}

RL_FN void cacheReadNow(uint slot, RL_OUT(LightReservoir) r) {
  lightRead(gBuffers.lights, slot, r);
}
RL_FN void cacheReadBefore(uint slot, RL_OUT(LightReservoir) r) {
  lightRead(gBuffers.lightsHistory, slot, r);
}
RL_FN void cacheWriteNow(uint slot, RL_IN(LightReservoir) r) {
  lightWrite(gBuffers.lights, slot, r);
}
RL_FN void cacheWriteHistory(uint slot, RL_IN(LightReservoir) r) {
  lightWrite(gBuffers.lightsHistory, slot, r);
}

RL_FN void pathRead(RL_IN(QuadRef) vertices, RL_IN(QuadRef) suffixes, uint slot,
                    RL_INOUT(PathReservoir) r) {
  uint at = slot * RL_GI_PATH_QUADS;
  uvec4 q0 = RL_PAST_QUAD(vertices, at);
  uvec4 q1 = RL_PAST_QUAD(vertices, at + 1u);
  uvec4 q2 = RL_PAST_QUAD(vertices, at + 2u);
  r.vertex.posW = recordVec3(q0);
  r.vertex.posError = uintBitsToFloat(q0.w);
  r.vertex.nGeoW = recordVec3(q1);
  r.vertex.kind = q1.w;
  r.vertex.radiance = recordVec3(q2);
  r.state = stateRead(vertices, at + 3u);
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    at = slot * RL_GI_SUFFIX_QUADS;
    uvec4 s0 = RL_PAST_QUAD(suffixes, at);
    uvec4 s1 = RL_PAST_QUAD(suffixes, at + 1u);
    uvec4 s2 = RL_PAST_QUAD(suffixes, at + 2u);
    uvec4 s3 = RL_PAST_QUAD(suffixes, at + 3u);
    uvec4 s4 = RL_PAST_QUAD(suffixes, at + 4u);
    uvec4 s5 = RL_PAST_QUAD(suffixes, at + 5u);
    r.suffix.nShadeW = recordVec3(s0);
    r.suffix.pdfLight = uintBitsToFloat(s0.w);
    r.suffix.wi = recordVec3(s1);
    r.suffix.bsdf.lobes = s1.w;
    r.suffix.emitted = recordVec3(s2);
    r.suffix.bsdf.f90 = uintBitsToFloat(s2.w);
    r.suffix.bsdf.diffuse = recordVec3(s3);
    r.suffix.bsdf.alpha = uintBitsToFloat(s3.w);
    r.suffix.bsdf.f0 = recordVec3(s4);
    r.suffix.bsdf.eta = uintBitsToFloat(s4.w);
    r.suffix.bsdf.transmission = recordVec3(s5);
  }
}

RL_FN void pathWrite(RL_IN(QuadRef) vertices, RL_IN(QuadRef) suffixes, uint slot,
                     RL_IN(PathReservoir) r) {
  uint at = slot * RL_GI_PATH_QUADS;
  RL_WRITE_QUAD(vertices, at, recordQuad(r.vertex.posW, floatBitsToUint(r.vertex.posError)));
  RL_WRITE_QUAD(vertices, at + 1u, recordQuad(r.vertex.nGeoW, r.vertex.kind));
  RL_WRITE_QUAD(vertices, at + 2u, recordQuad(r.vertex.radiance, 0u));
  stateWrite(vertices, at + 3u, r.state);
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    at = slot * RL_GI_SUFFIX_QUADS;
    Bsdf b = r.suffix.bsdf;
    RL_WRITE_QUAD(suffixes, at, recordQuad(r.suffix.nShadeW, floatBitsToUint(r.suffix.pdfLight)));
    RL_WRITE_QUAD(suffixes, at + 1u, recordQuad(r.suffix.wi, b.lobes));
    RL_WRITE_QUAD(suffixes, at + 2u, recordQuad(r.suffix.emitted, floatBitsToUint(b.f90)));
    RL_WRITE_QUAD(suffixes, at + 3u, recordQuad(b.diffuse, floatBitsToUint(b.alpha)));
    RL_WRITE_QUAD(suffixes, at + 4u, recordQuad(b.f0, floatBitsToUint(b.eta)));
    RL_WRITE_QUAD(suffixes, at + 5u, recordQuad(b.transmission, 0u));
  }
}

RL_FN void cacheReadNow(uint slot, RL_INOUT(PathReservoir) r) {
  pathRead(gBuffers.paths, gBuffers.suffixes, slot, r);
}
RL_FN void cacheReadBefore(uint slot, RL_INOUT(PathReservoir) r) {
  pathRead(gBuffers.pathsHistory, gBuffers.suffixesHistory, slot, r);
}
RL_FN void cacheWriteNow(uint slot, RL_IN(PathReservoir) r) {
  pathWrite(gBuffers.paths, gBuffers.suffixes, slot, r);
}
RL_FN void cacheWriteHistory(uint slot, RL_IN(PathReservoir) r) {
  pathWrite(gBuffers.pathsHistory, gBuffers.suffixesHistory, slot, r);
}

// The state alone: merges decide by it, and only the winner's payload has to be moved.
RL_FN void cacheReadStateNow(uint slot, RL_INOUT(LightReservoir) r) {
  r.state = stateRead(gBuffers.lights, slot * RL_GI_LIGHT_QUADS + 4u);
}
RL_FN void cacheReadStateNow(uint slot, RL_INOUT(PathReservoir) r) {
  r.state = stateRead(gBuffers.paths, slot * RL_GI_PATH_QUADS + 3u);
}
RL_FN void cacheWriteStateNow(uint slot, RL_IN(LightReservoir) r) {
  stateWrite(gBuffers.lights, slot * RL_GI_LIGHT_QUADS + 4u, r.state);
}
RL_FN void cacheWriteStateNow(uint slot, RL_IN(PathReservoir) r) {
  stateWrite(gBuffers.paths, slot * RL_GI_PATH_QUADS + 3u, r.state);
}
RL_FN void cacheWriteStateHistory(uint slot, RL_IN(LightReservoir) r) {
  stateWrite(gBuffers.lightsHistory, slot * RL_GI_LIGHT_QUADS + 4u, r.state);
}
RL_FN void cacheWriteStateHistory(uint slot, RL_IN(PathReservoir) r) {
  stateWrite(gBuffers.pathsHistory, slot * RL_GI_PATH_QUADS + 3u, r.state);
}

// A slot's sample as its k-th partner sees it.
RL_FN uint cacheExchangeIndex(uint slot, uint k) { return slot * gParams.spatialNeighbours + k; }
RL_FN void cacheWriteShifted(uint index, RL_IN(LightReservoir) r, RL_IN(Shifted) s) {
  RL_WRITE_QUAD(gBuffers.shiftedLights, index, recordQuad(s.F, floatBitsToUint(s.jacobian)));
}
RL_FN void cacheWriteShifted(uint index, RL_IN(PathReservoir) r, RL_IN(Shifted) s) {
  RL_WRITE_QUAD(gBuffers.shiftedPaths, index, recordQuad(s.F, floatBitsToUint(s.jacobian)));
}
RL_FN Shifted shiftedUnpack(RL_IN(uvec4) q) {
  Shifted s;
  s.F = recordVec3(q);
  s.jacobian = uintBitsToFloat(q.w);
  return s;
}
RL_FN void cacheReadShifted(uint index, RL_IN(LightReservoir) r, RL_OUT(Shifted) s) {
  s = shiftedUnpack(RL_PAST_QUAD(gBuffers.shiftedLights, index));
}
RL_FN void cacheReadShifted(uint index, RL_IN(PathReservoir) r, RL_OUT(Shifted) s) {
  s = shiftedUnpack(RL_PAST_QUAD(gBuffers.shiftedPaths, index));
}
