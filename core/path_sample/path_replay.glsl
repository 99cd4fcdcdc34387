// Replays the prefix of a path with its own random numbers from another pixel: the walker, with a
// state that draws no light. In primary sample space its Jacobian is 1. Russian roulette does not
// act. The replay fails where a pair of vertices connects that does not in the path: the shift
// would have no inverse.
#define RL_WALK_STATE PathReplay

// Shows where a replay goes to who asks (Session::path()). Kernels leave these empty.
#ifndef RL_REPLAY_WATCH_VERTEX
#define RL_REPLAY_WATCH_VERTEX(posW)
#define RL_REPLAY_WATCH_LIGHT(isEnd, posW)
#define RL_REPLAY_WATCH_MISS(dirW)
#endif

RL_FN PathReplay pathReplayBegin(RL_IN(PathSample) path) {
  PathReplay q;
  q.before = pathConnectorNone();
  q.base = path.base;
  q.kind = pathKind(path);
  q.isMirrored = 1u;
  q.failed = RL_FAILED_REPLAY;
  q.x = surfaceNone();
  q.throughput = vec3(1.0f, 1.0f, 1.0f);
  q.sigma = vec3(0.0f, 0.0f, 0.0f);
  q.rank = gFrame.cameraMedia.x;
  q.radiance = vec3(0.0f, 0.0f, 0.0f);
  return q;
}

RL_FN void pathReplayFinds(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                           float pdfLight) {
  if (q.kind != RL_PATH_WHOLE_REPLAY || walk.bounces != q.base + 1u) return;
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  q.radiance = walk.throughput * radiance * weight;
  q.failed = RL_FAILED_NOT;
}
RL_FN void onMiss(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(vec3) radiance, float pdfLight) {
  RL_REPLAY_WATCH_MISS(walk.ray.dir)
  pathReplayFinds(q, walk, radiance, pdfLight);
  if (walk.bounces == 0u) q.failed = RL_FAILED_BACKGROUND;
}
RL_FN void onEmission(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(Hit) hit,
                      float pdfLight) {
  RL_REPLAY_WATCH_LIGHT(walk.bounces > q.base, s.posW)
  // Direct light of mirrors in view is not resampled.
  if (q.isMirrored == 0u) pathReplayFinds(q, walk, s.emission, pdfLight);
}

RL_FN uint onVertex(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  if (walk.bounces > q.base) return RL_WALK_ENDS;
  RL_REPLAY_WATCH_VERTEX(s.posW)
  if (walk.bounces == 0u) q.before.footprint = pathFootprintOfX1(s, walk.ray.origin);
  if (walk.bounces > 0u && pathConnects(q.before, walk, s)) {
    q.failed = RL_FAILED_CONNECTS;
    return RL_WALK_ENDS;
  }
  bool isRough = pathIsRough(s);
  if (!pathIsMirror(s)) q.isMirrored = 0u;
  q.before.posW = s.posW;
  q.before.isRough = isRough ? 1u : 0u;
  if (walk.bounces < q.base) return 0u;
  bool isSmoothKind = q.kind == RL_PATH_WEIGHED || q.kind == RL_PATH_WHOLE_REPLAY;
  if (isRough == isSmoothKind) return RL_WALK_ENDS;
  if (q.kind == RL_PATH_WEIGHED && (q.isMirrored != 0u || pathIsLightUnresampled(s)))
    return RL_WALK_ENDS;
  if (q.kind == RL_PATH_WHOLE_REPLAY) return 0u;
  q.x = s;
  q.throughput = walk.throughput;
  q.sigma = walk.sigma;
  q.rank = walk.media.x;
  q.failed = RL_FAILED_NOT;
  return RL_WALK_ENDS;
}

// The other events of a walk leave a replay as it is.
RL_FN void onMedium(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {}
RL_FN bool onLightSample(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(Rng) rng, RL_IN(Surface) s,
                         RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  return false;
}
RL_FN void onShadowRay(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, float transmittance) {}
RL_FN void onBsdfSample(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfSample) draw) {}
RL_FN void onRoulette(RL_INOUT(PathReplay) q, RL_IN(Walk) walk, float factor) {}

#include "core/transport/walk.glsl"

// Replays a path from a camera ray.
RL_FN PathReplay pathReplay(RL_IN(PathSample) path, RL_IN(Ray) cameraRay) {
  PathReplay q = pathReplayBegin(path);
  Walk walk = walkBegin(rngOfKey(path.key), path.film, cameraRay, 0u);
  walk.rouletteStart = RL_INVALID;
  if (RL_HAS(RL_FEATURE_VOLUME)) {
    walk.media = gFrame.cameraMedia;
    walk.sigma = vec3(mediaOfRank(walk.media.x));
  }
  walkOn(q, walk);
  return q;
}
