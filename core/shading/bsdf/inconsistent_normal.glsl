// Interpolated and mapped normals: facets that the mesh does not have. Two cases have no meaning
// for such normals and would make glossy surfaces black:
//   a facet that turns its back to wo is seen as its mirror image at the plane across wo;
//   light that a microfacet sends through the face (refracted: back to this side) is mirrored at
//   the face, which it meets next: a direction u becomes u - 2 nGeo (nGeo . u).
// Two directions of a lobe may therefore end in one. The values of both add up, and a lobe returns
// what it returns under a normal of that angle. Everything is a function of the two normals and the
// directions, so that it can be evaluated for any wo. Directions that are sampled by the cosine
// (Lambert, and the compensation of multiple scattering) and go below the face are absorbed, as on
// surfaces without gloss: adding them up would double the step where light passes the horizon.

RL_FN bool inconsistentNormalCanTurn(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_SMOOTH_NORMALS | RL_FEATURE_NORMAL_MAPS) &&
         (b.lobes & RL_LOBE_ANY_GLOSSY) != 0u;
}

// Reflection must stay on the geometric side of wo, transmission must leave it: no light leaks
// through a face because of the interpolated normal. sideW: nGeo . w of a direction w.
RL_FN bool sidesAgree(float sideW, float wLocalZ) {
  return wLocalZ > 0.0f ? sideW > 0.0f : sideW < 0.0f;
}

// The shading normal that wo sees; cosO: nShade . wo.
RL_FN vec3 consistentNormal(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                            float cosO) {
  // Leave a wo behind the face itself (rounding at a grazing angle) unrepaired.
  bool turns = cosO < 0.0f && inconsistentNormalCanTurn(b) && dot(nGeo, wo) > 0.0f;
  return turns ? nShade - wo * (2.0f * cosO) : nShade;
}

// The direction, local to the normal n, that is mirrored into wi; (0, 0, 0) where there is none.
// wiL: wi local to n.
RL_FN vec3 consistentNormalMirror(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) n, RL_IN(vec3) wi,
                                  RL_IN(vec3) wiL) {
  vec3 none = vec3(0.0f, 0.0f, 0.0f);
  if (!inconsistentNormalCanTurn(b)) return none;
  float side = dot(nGeo, wi);
  if (!sidesAgree(side, wiL.z - 2.0f * side * dot(n, nGeo))) return none;
  vec3 originL = frameToLocal(n, wi - nGeo * (2.0f * side));
  return sidesAgree(side, originL.z) ? originL : none;
}
