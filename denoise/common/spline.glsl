// A spline over three places, and what a pixel's surroundings are.

// Repeated at twice the distance each time, its sum is a triangle without steps.
RL_FN float splineWeight(uint at) { return at == 1u ? 0.5f : 0.25f; }

// The row or column of the image at one of the three places, which lie so many pixels apart; false
// outside.
RL_FN bool splineAt(uint here, uint at, uint apart, uint size, RL_OUT(uint) there) {
  // Below 0 the number wraps to the largest there is: outside, too.
  there = here + at * apart - apart;
  return there < size;
}

RL_FN Around aroundRead(RL_IN(Vec2Ref) arounds, uint slot) {
  vec2 words = arounds.data[slot];
  Around a;
  a.luminance = words.x;
  a.variance = words.y;
  return a;
}
