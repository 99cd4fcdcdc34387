// local_lamps: chooses the lamps that have shadow maps. One entry. Lights without an area come
// first, then emitting instances, each in the order of the light table, until no square is left.

#include "integrators/local/shadow_map.glsl"

// A directional light: a square that the scene's box fits in.
RL_FN void localFitBox(RL_INOUT(LocalLamp) lamp) {
  vec3 across;
  vec3 up;
  frameFromNormal(lamp.dir, across, up);
  vec3 extent = (gParams.sceneHigh - gParams.sceneLow) * 0.5f;
  float wider = 1.001f;  // rounding
  lamp.halfWidth = max(dot(abs(across), extent) * wider, 1.0e-6f);
  lamp.halfHeight = max(dot(abs(up), extent) * wider, 1.0e-6f);
  lamp.origin = (gParams.sceneLow + gParams.sceneHigh) * 0.5f;
  lamp.origin = lamp.origin - lamp.dir * max(dot(abs(lamp.dir), extent) * wider, 1.0e-6f);
}

RL_FN LocalLamp localLampOfLight(uint record, RL_IN(Light) light) {
  LocalLamp lamp;
  lamp.origin = light.p0;
  lamp.key = record;
  lamp.dir = light.e1;
  lamp.shape = RL_LOCAL_MAP_CUBE;
  lamp.halfWidth = 0.0f;
  lamp.halfHeight = 0.0f;
  lamp.firstSquare = 0u;
  lamp.isArea = 0u;
  if (light.kind == RL_LIGHT_DIRECTIONAL) {
    lamp.shape = RL_LOCAL_MAP_PARALLEL;
    localFitBox(lamp);
  }
  if (light.kind == RL_LIGHT_SPOT) {
    float cosine = -rlSafeDivide(light.e2.y, light.e2.x);
    if (cosine > RL_LOCAL_WIDEST_CONE) {
      lamp.shape = RL_LOCAL_MAP_CONE;
      lamp.halfWidth = max(sqrt(max(1.0f - cosine * cosine, 0.0f)) / cosine * 1.001f, 1.0e-4f);
      lamp.halfHeight = lamp.halfWidth;
    }
  }
  return lamp;
}

RL_FN void kernelMain(RL_IN(uvec2) entry) {
  if (entry.x != 0u || entry.y != 0u) return;
  uint count = 0u;
  uint squares = 0u;
  // Lights without an area stand behind the emitting triangles, the sky behind them.
  uint end = gScene.lightCount;
  uint first = end;
  for (uint i = 0u; i < RL_LOCAL_MOST_RECORDS && first > 0u; i = i + 1u) {
    if (recordLight(first - 1u).kind == RL_LIGHT_AREA) break;
    first = first - 1u;
  }
  for (uint record = first; record < end; record = record + 1u) {
    Light light = recordLight(record);
    if (light.kind == RL_LIGHT_ENVIRONMENT) continue;
    LocalLamp lamp = localLampOfLight(record, light);
    if (squares + localMapSquares(lamp.shape) > gParams.mapSquares) continue;
    lamp.firstSquare = squares;
    squares = squares + localMapSquares(lamp.shape);
    localLampWrite(count, lamp);
    count = count + 1u;
  }
  // The triangles of an instance follow one another: one lamp, in the middle of their area.
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  float weight = 0.0f;
  uint areas = min(first, RL_LOCAL_MOST_RECORDS);
  for (uint record = 0u; record < areas; record = record + 1u) {
    if (squares + 6u > gParams.mapSquares) break;
    Light light = recordLight(record);
    vec3 middle = light.p0;
    float area = 1.0f;
    if ((light.flags & RL_LIGHT_SHAPE) == 0u) {
      middle = middle + (light.e1 + light.e2) * (1.0f / 3.0f);
      area = length(cross(light.e1, light.e2));
    }
    sum += middle * area;
    weight += area;
    bool isLast = record + 1u == areas;
    if (!isLast) isLast = recordLight(record + 1u).instance != light.instance;
    if (!isLast) continue;
    if (weight > 0.0f) {
      LocalLamp lamp = localLampOfLight(light.instance, light);
      lamp.origin = sum * (1.0f / weight);
      lamp.isArea = 1u;
      lamp.firstSquare = squares;
      squares = squares + 6u;
      localLampWrite(count, lamp);
      count = count + 1u;
    }
    sum = vec3(0.0f, 0.0f, 0.0f);
    weight = 0.0f;
  }
  RL_WRITE_UVEC4(gBuffers.lamps, 0u, uvec4(count, squares, 0u, 0u));
}
