// A metal: microfacets with the Fresnel term of a conductor, smooth where alpha is 0.
#ifdef RL_CLOSURE_DECLARED
info.is("metal: facets with the Fresnel term of a conductor",
        "Cook and Torrance 1982; Walter et al. 2007");
info.choice("metal", {"none", "Al", "Cu", "Au", "Ag", "Cr"}, "index of a metal; none: eta and k");
info.color("eta", 0.2, "index of refraction, real part", 20.0);
info.color("k", 3.9, "index of refraction, imaginary part", 20.0);
info.color("color", 1.0, "factor of the reflectance");
info.number("alpha", 0.1, 0.0, 1.0, "roughness of the facets; below 0.001: smooth");
info.number("anisotropic", 0.0, 0.0, 1.0,
            "0: the same along both axes; 1: rough along the tangent");
info.choice("distribution", {"ggx", "beckmann", "blinn"}, "D, of the facets' normals");
info.choice("masking", {"correlated", "smith", "v_cavities"},
            "G: Smith's with and without heights, or V-cavities");
info.looksAtTangent("anisotropic");
info.breaks({"energy"}, "distribution", "blinn");
#else

// Indices of refraction at 630, 550 and 450 nm (Johnson and Christy 1972 and 1974, Rakic 1995, as
// refractiveindex.info lists them).
RL_FN vec3 conductorEta(uint metal) {
  if (metal == 1u) return vec3(1.3456f, 0.96521f, 0.61722f);
  if (metal == 2u) return vec3(0.27105f, 0.67693f, 1.3164f);
  if (metal == 3u) return vec3(0.18299f, 0.42108f, 1.3734f);
  if (metal == 4u) return vec3(0.15943f, 0.14512f, 0.13547f);
  return vec3(3.1071f, 3.1812f, 2.3230f);
}
RL_FN vec3 conductorK(uint metal) {
  if (metal == 1u) return vec3(7.4746f, 6.3995f, 5.3031f);
  if (metal == 2u) return vec3(3.6092f, 2.6248f, 2.2921f);
  if (metal == 3u) return vec3(3.4242f, 2.3459f, 1.7704f);
  if (metal == 4u) return vec3(3.9291f, 3.1900f, 2.3808f);
  return vec3(3.3314f, 3.3291f, 3.1350f);
}

RL_FN uint conductorDistribution(uint choice) {
  return choice == 0u ? RL_FACETS_GGX : choice == 1u ? RL_FACETS_BECKMANN : RL_FACETS_BLINN;
}
RL_FN uint conductorMasking(uint choice) {
  return choice == 0u   ? RL_MASKING_CORRELATED
         : choice == 1u ? RL_MASKING_SMITH
                        : RL_MASKING_V_CAVITIES;
}

RL_FN void conductorLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  uint metal = closureChoice(at, 0u);
  vec3 eta = metal == 0u ? closureColor(at, 1u) : conductorEta(metal);
  vec3 k = metal == 0u ? closureColor(at, 2u) : conductorK(metal);
  vec2 alpha = facetsAlpha(closureNumber(at, 4u), closureNumber(at, 5u));
  uint kinds = facetsKinds(conductorDistribution(closureChoice(at, 6u)),
                           conductorMasking(closureChoice(at, 7u)), RL_FRESNEL_CONDUCTOR);
  b.p0 = vec4(0.0f, 0.0f, 0.0f, alpha.x);
  b.p1 = vec4(closureColor(at, 3u), alpha.y);
  b.p2 = vec4(eta, float(kinds));
  b.p3 = vec4(k, 0.0f);
  facetLayerLoad(b);
}

RL_FN vec3 conductorEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  return facetLayerEval(b, woL, wiL, pdf);
}

RL_FN BsdfSample conductorSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  return facetLayerSample(b, woL, uLobe, u);
}
#endif
