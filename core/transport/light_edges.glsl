// Pixels at the edge of a lamp that the camera sees, and of its image in a mirror. A single film
// sample hits the lamp or misses it: the largest error of a frame with a lamp in view. Camera rays
// are cheap compared with paths, so such pixels take several.
//
// Edges of the sky keep one film sample. Objects before the sky are often as bright as the sky, and
// then directly visible and reflected light should come from the same film sample. In a white
// furnace that is exact.

// Returns whether a lamp ends at this pixel, judged by its centre and those of the eight pixels
// around it. `gbuffer`: core/gbuffer/gbuffer.h.
RL_FN bool lightsEndHere(RL_IN(Uvec4Ref) gbuffer, RL_IN(uvec2) pixel) {
  uint here = RL_EARLIER_UVEC4(gbuffer, pixelIndexOf(pixel)).w >> 31u;
  for (uint i = 0u; i < 9u; i = i + 1u) {
    // Left of column 0 and above row 0 the index wraps to a large number: outside, too.
    uint x = pixel.x + i % 3u - 1u;
    uint y = pixel.y + i / 3u - 1u;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    if (RL_EARLIER_UVEC4(gbuffer, pixelIndexOf(uvec2(x, y))).w >> 31u != here) return true;
  }
  return false;
}

// Returns whether a pixel may show a part of a lamp or of a mirror: the centre of one of the 5 x 5
// pixels around it does. A lamp that no centre shows is missed and keeps the path's one sample.
RL_FN bool lightsAreNear(RL_IN(Uvec4Ref) gbuffer, RL_IN(uvec2) pixel) {
  for (uint i = 0u; i < 25u; i = i + 1u) {
    uint x = pixel.x + i % 5u - 2u;
    uint y = pixel.y + i / 5u - 2u;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    uvec4 words = RL_EARLIER_UVEC4(gbuffer, pixelIndexOf(uvec2(x, y)));
    if (((words.x | words.w) >> 31u) != 0u) return true;
  }
  return false;
}
