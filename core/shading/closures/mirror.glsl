// A mirror with a colour: f = color delta(wi - mirrored wo) / |cos_i|.
//   p0: colour
#ifdef RL_CLOSURE_DECLARED
info.is("mirror with a colour at every angle", "Kajiya 1986");
info.color("color", 1.0, "share of the light that is reflected");
#else

RL_FN void mirrorLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  b.f0 = closureColor(at, 0u);
  b.f90 = 1.0f;
  b.alpha = 0.0f;
  if (!rlIsBlack(b.f0)) b.lobes = RL_LOBE_SPECULAR_DELTA;
}

RL_FN vec3 mirrorEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  return vec3(0.0f, 0.0f, 0.0f);
}

RL_FN BsdfSample mirrorSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s;
  s.wi = vec3(-woL.x, -woL.y, woL.z);
  s.pdfSolidAngle = 1.0f;
  s.weight = b.f0;
  s.lobe = RL_LOBE_SPECULAR_DELTA;
  return s;
}
#endif
