// The functions of core/dialect/lanes.h for GLSL, whose vectors are lanes.
#ifndef __cplusplus
#define Lanes vec4

Lanes lanesOfBits(uvec4 bits) { return uintBitsToFloat(bits); }
Lanes lanesAll(float v) { return vec4(v, v, v, v); }
Lanes lanesOfWords(uvec4 words) { return vec4(words); }
float lanesAt(Lanes v, uint i) { return v[i]; }
Lanes lanesSqrt(Lanes v) { return sqrt(v); }
Lanes lanesMin(Lanes a, Lanes b) { return min(a, b); }
Lanes lanesMax(Lanes a, Lanes b) { return max(a, b); }
Lanes lanesIfLess(Lanes a, Lanes b, Lanes x, Lanes y) { return mix(y, x, lessThan(a, b)); }
#endif
