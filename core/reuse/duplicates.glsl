// Pass of the duplication map (Lin, Kettunen and Wyman 2026): counts the pixels around each that
// hold the same sample, which its film sample names.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint film = gBuffers.sampleFilms.data[pixelIndex];
  uint count = 0u;
  uint x0 = pixel.x - min(pixel.x, RL_DUPLICATES_RADIUS);
  uint y0 = pixel.y - min(pixel.y, RL_DUPLICATES_RADIUS);
  uint x1 = min(pixel.x + RL_DUPLICATES_RADIUS, gFrame.width - 1u);
  uint y1 = min(pixel.y + RL_DUPLICATES_RADIUS, gFrame.height - 1u);
  if (film != 0u) {
    for (uint y = y0; y <= y1; y = y + 1u) {
      for (uint x = x0; x <= x1; x = x + 1u) {
        if (gBuffers.sampleFilms.data[pixelIndexOf(uvec2(x, y))] == film) count = count + 1u;
      }
    }
    count = count - 1u;  // the pixel itself
  }
  gBuffers.duplicates.data[pixelIndex] = count;
}
