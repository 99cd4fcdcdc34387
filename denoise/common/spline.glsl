// Three-tap spline filter, and reads of the mean luminance around pixels.

// Weight of a tap. Repeated at twice the distance each time, the filter is a triangle without
// steps.
RL_FN float splineWeight(uint at) { return at == 1u ? 0.5f : 0.25f; }

// Row or column of a tap; taps lie `apart` pixels apart. Returns false outside the image.
RL_FN bool splineAt(uint here, uint at, uint apart, uint size, RL_OUT(uint) there) {
  // Below 0 the index wraps to a large number: outside, too.
  there = here + at * apart - apart;
  return there < size;
}

RL_FN LocalLuminance aroundRead(RL_IN(Vec2Ref) arounds, uint pixelIndex) {
  vec2 words = arounds.data[pixelIndex];
  LocalLuminance a;
  a.luminance = words.x;
  a.variance = words.y;
  return a;
}
