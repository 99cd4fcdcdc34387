// Intervals (least, largest). Every operation is widened by its rounding, so that a value that is
// computed from numbers in them, on any device, lies in the result.

RL_FN vec2 fieldWiden(RL_IN(vec2) v) {
  vec2 slack = abs(v) * RL_FIELD_ROUNDING + vec2(1.0e-36f, 1.0e-36f);
  return vec2(max(v.x - slack.x, -RL_FIELD_STEEPEST), min(v.y + slack.y, RL_FIELD_STEEPEST));
}

// Bounds of a division or a root: devices round them to 2.5 units in the last place and more.
RL_FN vec2 fieldWidenCoarsely(RL_IN(vec2) v) {
  return fieldWiden(v - abs(v) * vec2(1.0e-6f, -1.0e-6f));
}

RL_FN vec2 fieldTimes(float k, RL_IN(vec2) a) {
  return fieldWiden(k < 0.0f ? vec2(k * a.y, k * a.x) : vec2(k * a.x, k * a.y));
}

RL_FN vec2 fieldProduct(RL_IN(vec2) a, RL_IN(vec2) b) {
  float p = a.x * b.x;
  float q = a.x * b.y;
  float r = a.y * b.x;
  float s = a.y * b.y;
  return fieldWiden(vec2(min(min(p, q), min(r, s)), max(max(p, q), max(r, s))));
}

RL_FN vec2 fieldSum(RL_IN(vec2) a, RL_IN(vec2) b) { return fieldWiden(a + b); }

// Whether period n + offset lies in [low, high] for a whole n, with room for rounding.
RL_FN bool fieldHolds(RL_IN(vec2) a, float period, float offset) {
  vec2 slack = abs(a) * 5.0e-7f + vec2(1.0e-6f, 1.0e-6f);
  float low = (a.x - slack.x - offset) / period;
  float high = (a.y + slack.y - offset) / period;
  return floor(high) >= ceil(low);
}

// Bounds of the sine over [low, high]; of the cosine with its shift of a quarter.
RL_FN vec2 fieldWave(RL_IN(vec2) a, bool isCosine) {
  vec2 first = fieldCosSin(a.x);
  vec2 last = fieldCosSin(a.y);
  float x = isCosine ? first.x : first.y;
  float y = isCosine ? last.x : last.y;
  float quarter = isCosine ? 0.0f : 0.5f * RL_PI;
  vec2 v = vec2(min(x, y) - RL_FIELD_WAVE_ERROR, max(x, y) + RL_FIELD_WAVE_ERROR);
  if (fieldHolds(a, 2.0f * RL_PI, quarter)) v.y = 1.0f + RL_FIELD_WAVE_ERROR;
  if (fieldHolds(a, 2.0f * RL_PI, quarter + RL_PI)) v.x = -1.0f - RL_FIELD_WAVE_ERROR;
  return v;
}

RL_FN vec2 fieldSquareRange(RL_IN(vec2) a) {
  float x = a.x * a.x;
  float y = a.y * a.y;
  bool hasZero = a.x <= 0.0f && a.y >= 0.0f;
  return fieldWiden(vec2(hasZero ? 0.0f : min(x, y), max(x, y)));
}

// Bounds of a / |(a, b)|, the share of a's derivative in that of the length.
RL_FN vec2 fieldShare(RL_IN(vec2) a, RL_IN(vec2) b) {
  bool hasZero = b.x <= 0.0f && b.y >= 0.0f;
  float least = hasZero ? 0.0f : min(abs(b.x), abs(b.y));
  float most = max(abs(b.x), abs(b.y));
  float bOfLow = a.x >= 0.0f ? most : least;
  float bOfHigh = a.y >= 0.0f ? least : most;
  float sizeLow = sqrt(a.x * a.x + bOfLow * bOfLow);
  float sizeHigh = sqrt(a.y * a.y + bOfHigh * bOfHigh);
  vec2 v = vec2(-1.0f, 1.0f);
  if (sizeLow > 0.0f) v.x = max(a.x / sizeLow - 1.0e-6f, -1.0f);
  if (sizeHigh > 0.0f) v.y = min(a.y / sizeHigh + 1.0e-6f, 1.0f);
  return v;
}
