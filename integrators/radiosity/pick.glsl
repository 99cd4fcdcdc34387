// Pass over the shots of an iteration of Southwell: of the sides of elements that are the shot's
// own, every `shots`-th one, the one that has most to send. One shot is Southwell's method, several
// its form by blocks.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint shot = row.y * RL_ENTRY_ROW + row.x;
  if (solveIsDone() || shot >= gParams.shots) return;
  float most = 0.0f;
  uint best = RL_INVALID;
  float left = 0.0f;
  vec3 sent = vec3(0.0f, 0.0f, 0.0f);
  for (uint side = shot; side < 2u * gParams.elements; side = side + gParams.shots) {
    vec3 unshot = meshMeanIrradiance(side) - gBuffers.shot.data[side];
    vec3 radiosity = gBuffers.albedo.data[side / 2u] * unshot;
    float energy = uintBitsToFloat(meshElementVertices(side / 2u).w) * rlLuminance(abs(radiosity));
    left += energy;
    if (energy > most) {
      most = energy;
      best = side;
      sent = radiosity;
    }
  }
  RL_WRITE_UVEC4(gBuffers.chosen, shot, recordUvec4(sent, best));
  if (best != RL_INVALID) gBuffers.shot.data[best] = meshMeanIrradiance(best);
  gBuffers.parts.data[shot] = vec2(left, 0.0f);
}
