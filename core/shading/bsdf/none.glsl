// A surface that scatters nothing, and a draw that finds no direction.

RL_FN Bsdf bsdfNone() {
  Bsdf b;
  b.diffuse = vec3(0.0f, 0.0f, 0.0f);
  b.lobes = 0u;
  b.f0 = vec3(0.0f, 0.0f, 0.0f);
  b.f90 = 0.0f;
  b.transmission = vec3(0.0f, 0.0f, 0.0f);
  b.alpha = 1.0f;
  b.eta = 1.0f;
  b.closure = RL_CLOSURE_GLTF;
  b.tangent = vec2(1.0f, 0.0f);
  b.p0 = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  b.p1 = b.p0;
  b.p2 = b.p0;
  b.p3 = b.p0;
  return b;
}

// A draw that found no direction: the light is absorbed.
RL_FN BsdfSample bsdfSampleNone() {
  BsdfSample s;
  s.wi = vec3(0.0f, 0.0f, 1.0f);
  s.pdfSolidAngle = 0.0f;
  s.weight = vec3(0.0f, 0.0f, 0.0f);
  s.lobe = 0u;
  return s;
}
