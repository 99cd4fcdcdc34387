// Lambert reflection in local coordinates (z = shading normal). Albedo 1; the caller scales.

RL_FN float lambertEval(RL_IN(vec3) wiL) { return max(wiL.z, 0.0f) * RL_INV_PI; }

RL_FN float lambertPdf(RL_IN(vec3) wiL) { return max(wiL.z, 0.0f) * RL_INV_PI; }

RL_FN vec3 lambertDraw(RL_IN(vec2) u) { return warpCosineHemisphere(u); }
