// Caches whose queries are pixels, by the surfaces at their centres.
RL_FN uint entryQuery(RL_IN(uvec2) pixel) { return pixelIndexOf(pixel); }
RL_FN GBufferTexel entryVisible(uint pixelIndex) {
  return gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
}
