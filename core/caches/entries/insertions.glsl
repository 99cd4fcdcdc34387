// Pass of every frame: selects which groups' samples go into which entries.
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint group = entryGroup(pixelIndex);
  if (entryCandidatePixel(group) != pixelIndex) return;
  uint entry = gBuffers.entries.data[pixelIndex];
  if (entry >= RL_GRID_CLAIM) return;
  ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, entry);
  if (shadingPoint.surface.isHit != 0u &&
      !gbufferIsSimilar(entryVisible(pixelIndex), shadingPoint.surface, gParams.similarity))
    return;
  groupInserts(gBuffers.insertions, entry, group);
}
