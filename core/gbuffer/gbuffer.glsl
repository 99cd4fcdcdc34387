// Visible surfaces at pixel centres: packing, similarity tests, and reprojection to the last frame.

// Index of a pixel in per-pixel buffers, and its inverse.
RL_FN uint pixelIndexOf(RL_IN(uvec2) pixel) { return pixel.y * gFrame.width + pixel.x; }
RL_FN uvec2 pixelOfIndex(uint pixelIndex) {
  return uvec2(pixelIndex % gFrame.width, pixelIndex / gFrame.width);
}

// Reads the visible surface of a pixel in an image that `camera` took.
RL_FN GBufferTexel gbufferRead(RL_IN(Uvec4Ref) words, RL_IN(Camera) camera, uint pixelIndex) {
  uvec4 q = RL_EARLIER_UVEC4(words, pixelIndex);
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec2 centre =
      vec2(float(pixelIndex % gFrame.width) + 0.5f, float(pixelIndex / gFrame.width) + 0.5f);
  Ray ray = cameraRay(camera, centre, resolution);
  GBufferTexel v;
  v.isHit = (q.w >> 30u) & 1u;
  v.emits = q.w >> 31u;
  v.isMirror = q.x >> 31u;
  v.posW = v.isHit != 0u ? ray.origin + ray.dir * uintBitsToFloat(q.x & 0x7fffffffu) : ray.dir;
  v.nGeoW = q.y;
  v.nShadeW = q.z;
  v.reflectance = unpackColor(q.w);
  return v;
}

// Writes the visible surface that the pixel's centre ray hit at a distance.
RL_FN void gbufferWrite(RL_IN(Uvec4Ref) words, uint pixelIndex, RL_IN(GBufferTexel) v,
                        float distanceToCamera) {
  RL_WRITE_UVEC4(words, pixelIndex,
                 uvec4(floatBitsToUint(distanceToCamera) | (v.isMirror << 31u), v.nGeoW, v.nShadeW,
                       packColor(v.reflectance) | (v.isHit << 30u) | (v.emits << 31u)));
}

// Returns whether two surfaces are similar enough to share a history. Symmetric. distanceToCamera:
// metres. nGeoW: unpacked a.nGeoW, so that a caller that compares several `b` unpacks it once. Most
// pairs lie in one plane: equal packed normals are not unpacked again.
RL_FN bool gbufferMatchOf(RL_IN(GBufferTexel) a, RL_IN(vec3) nGeoW, RL_IN(GBufferTexel) b,
                          float distanceToCamera, RL_IN(SimilarityThresholds) test) {
  if (a.isHit != b.isHit) return false;
  if (a.isHit == 0u) return true;
  if (a.nShadeW != b.nShadeW &&
      dot(unpackNormal(a.nShadeW), unpackNormal(b.nShadeW)) < test.minNormalDot)
    return false;
  vec3 d = b.posW - a.posW;
  float planeDistance = abs(dot(d, nGeoW));
  if (a.nGeoW != b.nGeoW) planeDistance = max(planeDistance, abs(dot(d, unpackNormal(b.nGeoW))));
  return planeDistance <= test.maxPlaneDistance * distanceToCamera;
}
RL_FN bool gbufferMatch(RL_IN(GBufferTexel) a, RL_IN(GBufferTexel) b, float distanceToCamera,
                        RL_IN(SimilarityThresholds) test) {
  return gbufferMatchOf(a, unpackNormal(a.nGeoW), b, distanceToCamera, test);
}

// Returns whether two surfaces are similar enough to exchange samples. Symmetric. The background is
// similar to nothing.
RL_FN bool gbufferIsSimilar(RL_IN(GBufferTexel) a, RL_IN(GBufferTexel) b,
                            RL_IN(SimilarityThresholds) test) {
  if (a.isHit == 0u || b.isHit == 0u) return false;
  vec3 camera = gFrame.camera.posW;
  float distanceToCamera = max(distance(camera, a.posW), distance(camera, b.posW));
  return gbufferMatch(a, b, distanceToCamera, test);
}

// Returns whether a film position, in pixels, lies within the image. Every reprojection uses this
// test.
RL_FN bool filmIsInView(RL_IN(vec2) film) {
  return film.x >= 0.0f && film.y >= 0.0f && film.x < float(gFrame.width) &&
         film.y < float(gFrame.height);
}

// Film coordinates at which the last frame's camera saw the surface; false if it was out of view.
RL_FN bool filmPointPrevious(RL_IN(GBufferTexel) v, RL_OUT(vec2) film) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec3 posW = v.posW;
  // The background is infinitely far: only the direction counts.
  if (v.isHit == 0u) posW += gFrame.previousCamera.posW;
  if (!cameraProject(gFrame.previousCamera, posW, resolution, film)) return false;
  return filmIsInView(film);
}
