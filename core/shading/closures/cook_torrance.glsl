// f = (1 - s) diffuse / pi + s specular D G F / (4 cos_i cos_o), with any D, G and F.
#ifdef RL_CLOSURE_DECLARED
info.is("(1 - share) diffuse + share of a lobe of facets, any D, G and F",
        "Torrance and Sparrow 1967; Cook and Torrance 1982; Walter et al. 2007");
info.color("diffuse", 0.5, "albedo of the diffuse part");
info.color("specular", 1.0, "factor of the lobe");
info.number("share", 0.5, 0.0, 1.0, "of the lobe");
info.number("alpha", 0.3, 0.0, 1.0, "roughness of the facets; below 0.001: smooth");
info.number("anisotropic", 0.0, 0.0, 1.0,
            "0: the same along both axes; 1: rough along the tangent");
info.choice("d", {"beckmann", "ggx", "blinn"}, "distribution of the facets' normals");
info.choice("g", {"v_cavities", "smith", "correlated"},
            "masking: Cook and Torrance's V-cavities, Smith's without and with heights");
info.choice("f", {"schlick", "dielectric", "conductor"},
            "Fresnel term: of f0, of ior, of eta and k");
info.color("f0", 0.04, "reflectance at normal incidence (f = schlick)");
info.number("ior", 1.5, 1.0, 4.0, "index of refraction (f = dielectric)");
info.color("eta", 0.2, "index of refraction, real part (f = conductor)", 20.0);
info.color("k", 3.9, "index of refraction, imaginary part (f = conductor)", 20.0);
info.looksAtTangent("anisotropic");
info.breaks({"energy"}, "d", "blinn");
#else

RL_FN uint cookTorranceMasking(uint choice) {
  return choice == 0u   ? RL_MASKING_V_CAVITIES
         : choice == 1u ? RL_MASKING_SMITH
                        : RL_MASKING_CORRELATED;
}

RL_FN void cookTorranceLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  float share = closureNumber(at, 2u);
  vec2 alpha = facetsAlpha(closureNumber(at, 3u), closureNumber(at, 4u));
  uint fresnel = closureChoice(at, 7u);
  vec3 index = closureColor(at, 8u);
  if (fresnel == RL_FRESNEL_DIELECTRIC) index = vec3(closureNumber(at, 9u), 1.0f, 1.0f);
  if (fresnel == RL_FRESNEL_CONDUCTOR) index = closureColor(at, 10u);
  uint kinds =
      facetsKinds(closureChoice(at, 5u), cookTorranceMasking(closureChoice(at, 6u)), fresnel);
  b.p0 = vec4(closureColor(at, 0u) * (1.0f - share), alpha.x);
  b.p1 = vec4(closureColor(at, 1u) * share, alpha.y);
  b.p2 = vec4(index, float(kinds));
  b.p3 = vec4(closureColor(at, 11u), 0.0f);
  facetLayerLoad(b);
}

RL_FN vec3 cookTorranceEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  return facetLayerEval(b, woL, wiL, pdf);
}

RL_FN BsdfSample cookTorranceSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  return facetLayerSample(b, woL, uLobe, u);
}
#endif
