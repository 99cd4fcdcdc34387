// A convex mixture: f is the sum of the f of other materials, each times its share. It evaluates
// other closures, so it stands outside of the switch that they are called by.
//   p0: shares; p1: instance and primitive of the point, 16 bits each; p2: its barycentric
//   coordinates, first parameter; p3: probabilities of drawing from each
#ifdef RL_CLOSURE_DECLARED
info.is("convex mixture of two to four materials that reflect, shares by texture",
        "a sum of BSDFs whose shares add to at most 1");
info.material("first", false, "name of a [[material]]; takes what the others leave");
info.material("second", false, "name of a [[material]]");
info.material("third", true, "name of a [[material]]");
info.material("fourth", true, "name of a [[material]]");
info.number("first_share", 1.0, 0.0, 1.0, "of what the others leave; the rest is absorbed");
info.number("second_share", 0.5, 0.0, 1.0, "share of the second");
info.number("third_share", 0.0, 0.0, 1.0, "share of the third");
info.number("fourth_share", 0.0, 0.0, 1.0, "share of the fourth");
info.convex({"second_share", "third_share", "fourth_share"});
#else
RL_FN bool mixtureIs(RL_IN(Bsdf) b) { return b.closure == RL_CLOSURE_MIXTURE; }

RL_FN float mixtureWord(RL_IN(vec4) v, uint i) {
  return i == 0u ? v.x : i == 1u ? v.y : i == 2u ? v.z : v.w;
}

// The BSDF of one of the materials.
RL_FN_OUTLINE Bsdf mixtureMaterial(RL_IN(Bsdf) b, uint i) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, unpackHalves(vec2(b.p2.z, b.p2.w)) + i);
  Material m = recordMaterial(q.x);
  Bsdf part = bsdfNone();
  if ((m.flags & RL_MATERIAL_BLACK) != 0u) return part;
  Instance inst = recordInstance(unpackHalves(vec2(b.p1.x, b.p1.y)));
  MaterialPoint at;
  at.firstParameter = m.firstParameter;
  at.geometry = recordGeometry(inst.geometry);
  at.bary = vec2(b.p2.x, b.p2.y);
  // A shape is asked for its texture coordinates alone.
  at.corners = uvec3(0u, 0u, 0u);
  if (!RL_HAS_SHAPES || at.geometry.shape == RL_SHAPE_TRIANGLES)
    at.corners = RL_SCENE_UVEC3(gScene.triangles,
                                at.geometry.firstTriangle + unpackHalves(vec2(b.p1.z, b.p1.w)));
  if (m.closure == RL_CLOSURE_GLTF) {
    materialTexture(m, at);
    return materialLobes(m, true, 0.0f);
  }
  part.closure = m.closure;
  part.tangent = b.tangent;
  closureLoad(part, at);
  return part;
}

RL_FN void mixtureLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at, uint instance, uint primitive) {
  vec3 others = vec3(closureNumber(at, 5u), closureNumber(at, 6u), closureNumber(at, 7u));
  float rest = max(1.0f - others.x - others.y - others.z, 0.0f);
  b.p0 = vec4(closureNumber(at, 4u) * rest, others.x, others.y, others.z);
  vec2 ofInstance = packHalves(instance);
  vec2 ofPrimitive = packHalves(primitive);
  b.p1 = vec4(ofInstance.x, ofInstance.y, ofPrimitive.x, ofPrimitive.y);
  vec2 ofParameter = packHalves(at.firstParameter);
  b.p2 = vec4(at.bary.x, at.bary.y, ofParameter.x, ofParameter.y);
  vec4 picks = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  b.f90 = 1.0f;
  for (uint i = 0u; i < RL_MIXTURE_COUNT; i = i + 1u) {
    float share = mixtureWord(b.p0, i);
    if (!(share > 0.0f)) continue;
    Bsdf part = mixtureMaterial(b, i);
    b.lobes = b.lobes | part.lobes;
    b.diffuse += part.diffuse * share;
    b.f0 += part.f0 * share;
    if ((part.lobes & RL_LOBE_ANY_GLOSSY) != 0u) b.alpha = min(b.alpha, part.alpha);
    float pick = part.lobes != 0u ? share * rlLuminance(part.diffuse + part.f0) : 0.0f;
    if (part.lobes != 0u) pick = max(pick, 0.01f * share);
    picks += vec4(i == 0u ? pick : 0.0f, i == 1u ? pick : 0.0f, i == 2u ? pick : 0.0f,
                  i == 3u ? pick : 0.0f);
  }
  float total = picks.x + picks.y + picks.z + picks.w;
  b.p3 = picks * rlSafeDivide(1.0f, total);
}

// The material that uLobe falls to; its place there takes the number's place.
RL_FN uint mixturePick(RL_IN(Bsdf) b, RL_INOUT(float) uLobe) {
  float below = 0.0f;
  uint picked = 0u;
  for (uint i = 0u; i < RL_MIXTURE_COUNT; i = i + 1u) {
    float pick = mixtureWord(b.p3, i);
    if (!(pick > 0.0f)) continue;
    picked = i;
    if (uLobe < below + pick) break;
    below += pick;
  }
  uLobe = clamp((uLobe - below) / mixtureWord(b.p3, picked), 0.0f, 0.99999994f);
  return picked;
}
#endif
