// Orthonormal frames. Local coordinates: z along the normal.

// Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017): continuous except at
// n.z = -0.
RL_FN void frameFromNormal(RL_IN(vec3) n, RL_OUT(vec3) t, RL_OUT(vec3) b) {
  float s = n.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (s + n.z);
  float c = n.x * n.y * a;
  t = vec3(1.0f + s * n.x * n.x * a, s * c, -s * n.x);
  b = vec3(c, s + n.y * n.y * a, -n.y);
}

RL_FN vec3 frameToLocal(RL_IN(vec3) n, RL_IN(vec3) v) {
  vec3 t;
  vec3 b;
  frameFromNormal(n, t, b);
  return vec3(dot(v, t), dot(v, b), dot(v, n));
}

RL_FN vec3 frameToWorld(RL_IN(vec3) n, RL_IN(vec3) v) {
  vec3 t;
  vec3 b;
  frameFromNormal(n, t, b);
  return t * v.x + b * v.y + n * v.z;
}
