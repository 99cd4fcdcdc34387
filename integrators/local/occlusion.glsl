// Occlusion of ambient light. By rays about the normal; in screen space by points about the
// surface, which are hidden if they lie behind what their pixel shows (Mittring 2007).

RL_FN vec3 localAlbedo(RL_IN(Surface) s) { return min(bsdfAlbedo(s.bsdf), vec3(1.0f, 1.0f, 1.0f)); }

// Light that a surface sends on of the light from everywhere, but for that of lamps.
RL_FN vec3 localAmbient(RL_IN(Surface) s) {
  vec3 sent = vec3(gParams.ambient, gParams.ambient, gParams.ambient) * localAlbedo(s);
  if (RL_HAS(RL_FEATURE_AMBIENT)) sent += surfaceAmbient(s);
  return sent;
}

// Returns whether the screen hides a point `reach` metres from a surface: it lies in view, and
// behind the plane of what its pixel shows, and that is no farther from the surface than the
// radius of occlusion. What the camera does not see hides nothing.
RL_FN bool localIsHidden(RL_IN(Surface) at, RL_IN(vec3) dirW, float reach) {
  vec3 point = at.posW + dirW * reach;
  vec2 film;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  if (!cameraProject(gFrame.camera, point, resolution, film) || !filmIsInView(film)) return false;
  uint pixelIndex = pixelIndexOf(uvec2(uint(film.x), uint(film.y)));
  GBufferTexel seen = gbufferRead(gBuffers.surfaces, gFrame.camera, pixelIndex);
  if (seen.isHit == 0u || distance(seen.posW, at.posW) > gParams.occlusionRadius) return false;
  // Normals are packed and positions rounded: a plane does not hide its own points.
  float rounding =
      1.0e-3f * distance(seen.posW, at.posW) + 1.0e-5f * distance(seen.posW, gFrame.camera.posW);
  return dot(point - seen.posW, unpackNormal(seen.nGeoW)) < -rounding;
}
