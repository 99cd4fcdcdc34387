// Surfaces that pixels show at their centres: packing, the test of two, and the way back to the
// last frame.

// A unit vector as two numbers of 16 bits on the octahedron (Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 2014). Off by at most 1e-4.
RL_FN uint visiblePackNormal(RL_IN(vec3) n) {
  float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
  float x = n.x * scale;
  float y = n.y * scale;
  if (n.z < 0.0f) {
    float foldedX = (1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
    float foldedY = (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
    x = foldedX;
    y = foldedY;
  }
  uint qx = uint(clamp(x * 0.5f + 0.5f, 0.0f, 1.0f) * 65535.0f + 0.5f);
  uint qy = uint(clamp(y * 0.5f + 0.5f, 0.0f, 1.0f) * 65535.0f + 0.5f);
  return qx | (qy << 16u);
}

RL_FN vec3 visibleUnpackNormal(uint packed) {
  float x = float(packed & 0xffffu) * (2.0f / 65535.0f) - 1.0f;
  float y = float(packed >> 16u) * (2.0f / 65535.0f) - 1.0f;
  float z = 1.0f - abs(x) - abs(y);
  if (z < 0.0f) {
    float foldedX = (1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
    float foldedY = (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
    x = foldedX;
    y = foldedY;
  }
  return normalize(vec3(x, y, z));
}

// Three numbers of 0 to 1, in 10 bits each.
RL_FN uint visiblePackColor(RL_IN(vec3) c) {
  uint r = uint(clamp(c.x, 0.0f, 1.0f) * 1023.0f + 0.5f);
  uint g = uint(clamp(c.y, 0.0f, 1.0f) * 1023.0f + 0.5f);
  uint b = uint(clamp(c.z, 0.0f, 1.0f) * 1023.0f + 0.5f);
  return r | (g << 10u) | (b << 20u);
}
RL_FN vec3 visibleUnpackColor(uint packed) {
  return vec3(float(packed & 0x3ffu), float((packed >> 10u) & 0x3ffu),
              float((packed >> 20u) & 0x3ffu)) *
         (1.0f / 1023.0f);
}

RL_FN VisibleSurface visibleRead(RL_IN(QuadRef) quads, uint pixelIndex) {
  uvec4 q0 = RL_PAST_QUAD(quads, pixelIndex * RL_VISIBLE_QUADS);
  uvec4 q1 = RL_PAST_QUAD(quads, pixelIndex * RL_VISIBLE_QUADS + 1u);
  VisibleSurface v;
  v.posW = recordVec3(q0);
  v.isHit = q0.w;
  v.nGeoW = q1.x;
  v.nShadeW = q1.y;
  v.reflectance = visibleUnpackColor(q1.z);
  return v;
}

RL_FN void visibleWrite(RL_IN(QuadRef) quads, uint pixelIndex, RL_IN(VisibleSurface) v) {
  RL_WRITE_QUAD(quads, pixelIndex * RL_VISIBLE_QUADS, recordQuad(v.posW, v.isHit));
  RL_WRITE_QUAD(quads, pixelIndex * RL_VISIBLE_QUADS + 1u,
                uvec4(v.nGeoW, v.nShadeW, visiblePackColor(v.reflectance), 0u));
}

// Are two of them alike enough to share a history? Symmetric. distanceToCamera: in metres. Most
// pairs lie in one plane: what both have is unpacked once.
RL_FN bool visibleMatch(RL_IN(VisibleSurface) a, RL_IN(VisibleSurface) b, float distanceToCamera,
                        float minNormalDot, float maxPlaneDistance) {
  if (a.isHit != b.isHit) return false;
  if (a.isHit == 0u) return true;
  if (a.nShadeW != b.nShadeW &&
      dot(visibleUnpackNormal(a.nShadeW), visibleUnpackNormal(b.nShadeW)) < minNormalDot)
    return false;
  vec3 d = b.posW - a.posW;
  float planeDistance = abs(dot(d, visibleUnpackNormal(a.nGeoW)));
  if (a.nGeoW != b.nGeoW)
    planeDistance = max(planeDistance, abs(dot(d, visibleUnpackNormal(b.nGeoW))));
  return planeDistance <= maxPlaneDistance * distanceToCamera;
}

// Film coordinates at which the last frame's camera saw it; false where it was out of view.
RL_FN bool visibleFilmBefore(RL_IN(VisibleSurface) v, RL_OUT(vec2) film) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec3 posW = v.posW;
  // The background is as far as it can be: only the direction counts.
  if (v.isHit == 0u) posW += gFrame.previousCamera.posW;
  if (!cameraProject(gFrame.previousCamera, posW, resolution, film)) return false;
  return film.x >= 0.0f && film.y >= 0.0f && film.x < resolution.x && film.y < resolution.y;
}
