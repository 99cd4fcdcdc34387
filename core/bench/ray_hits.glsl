// ray_hits: what a raster pass finds, by rays.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  vec2 place = cameraFilmPoint(pixel, film);
  uint key = cameraAlphaKey(film);
  if (gParams.raster.isAtCentre != 0u) {
    place = vec2(float(pixel.x) + 0.5f, float(pixel.y) + 0.5f);
    key = pixelIndex;
  }
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  Hit hit = traceNoHit();
  traceRay(cameraRay(gFrame.camera, place, resolution), RL_RAY_PATH, key, hit);
  RL_WRITE_UVEC4(
      gBuffers.raster.hits, pixelIndex,
      uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.bary.x), floatBitsToUint(hit.bary.y)));
}
