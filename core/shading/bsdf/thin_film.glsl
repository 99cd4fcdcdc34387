// Iridescence (KHR_materials_iridescence): a thin film in place of the Fresnel term, after Belcour
// and Barla ("A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence",
// 2017), as glTF's text simplifies it: Schlick's reflectance of the base, two orders of
// interference, sensitivities of the eye as Gaussians in the phase. Differences from the text:
//   air and film reflect by Fresnel's equations, not by Schlick's formula: a film that has the
//   index of air is none;
//   sensitivities are scaled so that a reflectance without colour has none;
//   colours out of the gamut are moved into it, which keeps each channel from 0 to 1;
//   from inside of a solid the film reflects what it does at the angle outside, so that refraction
//   is reciprocal;
//   the film lies over the mixture of metal and dielectric, not over each.

// Fringes of one order in Rec. 709. opticalPath: metres.
RL_FN vec3 thinFilmFringes(float opticalPath, RL_IN(vec3) shift) {
  float phase = 2.0f * RL_PI * opticalPath;
  float phase2 = phase * phase;
  float x = 0.84620f * cos(1.6810e6f * phase + shift.x) * exp(-4.3278e9f * phase2) +
            0.15380f * cos(2.2399e6f * phase + shift.x) * exp(-4.5282e9f * phase2);
  float y = cos(1.7953e6f * phase + shift.y) * exp(-9.3046e9f * phase2);
  float z = cos(2.2084e6f * phase + shift.z) * exp(-6.6121e9f * phase2);
  // The rows of the matrix from XYZ, each over its sum.
  return vec3(2.689655f * x - 1.275862f * y - 0.413793f * z,
              -1.022108f * x + 1.978286f * y + 0.043822f * z,
              0.061224f * x - 0.224490f * y + 1.163266f * z);
}

RL_FN float thinFilmF0(float eta) {
  float r = (eta - 1.0f) / (eta + 1.0f);
  return r * r;
}
RL_FN float thinFilmSchlick(float f0, float cosI) {
  return f0 + (1.0f - f0) * fresnelSchlickWeight(cosI);
}

// Reflectance in air of a film over a base that reflects f0 without it. thickness: nm.
RL_FN vec3 thinFilmReflectance(RL_IN(vec3) f0, float thickness, float index, float cosI) {
  vec3 one = vec3(1.0f, 1.0f, 1.0f);
  float sin2 = (1.0f - cosI * cosI) / (index * index);
  if (!(sin2 < 1.0f)) return one;
  float cosFilm = sqrt(1.0f - sin2);
  float r12 = fresnelDielectric(cosI, index);
  float passes = 1.0f - r12;
  // The index of the base out of its reflectance. A base that reflects all has none.
  vec3 root = sqrt(min(f0, vec3(0.9999f, 0.9999f, 0.9999f)));
  vec3 base = (one + root) / (one - root);
  vec3 r23 = vec3(thinFilmSchlick(thinFilmF0(base.x / index), cosFilm),
                  thinFilmSchlick(thinFilmF0(base.y / index), cosFilm),
                  thinFilmSchlick(thinFilmF0(base.z / index), cosFilm));
  // A reflection at the denser side turns the phase.
  float inside = index < 1.0f ? 0.0f : RL_PI;
  vec3 shift =
      vec3(inside + (base.x < index ? RL_PI : 0.0f), inside + (base.y < index ? RL_PI : 0.0f),
           inside + (base.z < index ? RL_PI : 0.0f));
  vec3 r123 = min(r12 * r23, vec3(0.9999f, 0.9999f, 0.9999f));
  vec3 amplitude = sqrt(r123);
  vec3 all = r23 * (passes * passes) / (one - r123);
  float opticalPath = 2.0e-9f * index * thickness * cosFilm;
  vec3 sum = vec3(r12, r12, r12) + all;
  vec3 order = all - vec3(passes, passes, passes);
  order = order * amplitude;
  sum += 2.0f * order * thinFilmFringes(opticalPath, shift);
  order = order * amplitude;
  sum += 2.0f * order * thinFilmFringes(2.0f * opticalPath, 2.0f * shift);
  return clamp(sum, vec3(0.0f, 0.0f, 0.0f), one);
}

RL_FN bool thinFilmIs(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_IRIDESCENCE) && (b.lobes & RL_LOBE_FILM) != 0u;
}

// Reflectance with the film: `without` is that of the surface alone.
RL_FN vec3 thinFilmOver(RL_IN(Bsdf) b, RL_IN(vec3) without, float cosVH) {
  float cosI = cosVH;
  if ((b.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u && b.eta < 1.0f) {
    float sin2 = (1.0f - cosVH * cosVH) / (b.eta * b.eta);
    if (!(sin2 < 1.0f)) return without;
    cosI = sqrt(1.0f - sin2);
  }
  float factor = float(b.lobes >> RL_LOBE_FILM_SHIFT) * (1.0f / 65535.0f);
  return without + (thinFilmReflectance(b.f0, b.p2.z, b.p2.w, cosI) - without) * factor;
}

// Reflectance of the layer, with a film where there is one.
RL_FN vec3 fresnelOfBsdf(RL_IN(Bsdf) b, float cosVH) {
  vec3 plain = fresnelPlain(b, cosVH);
  if (dispersionIs(b)) {
    vec3 red = fresnelPlain(dispersionChannel(b, 0u), cosVH);
    vec3 blue = fresnelPlain(dispersionChannel(b, 2u), cosVH);
    plain = vec3(red.x, plain.y, blue.z);
  }
  return thinFilmIs(b) ? thinFilmOver(b, plain, cosVH) : plain;
}
