// traceRay() on Embree; included inside Ctx<features>, so that it is specialised with the kernel.

// Embree hands the context back to the alpha filters; the kernel context follows Embree's.
struct TraceContext {
  AlphaTraceContext alpha;
  Ctx* self;
  uint key;
  AlphaPassed passed;
  Hit body;  // RL_RAY_BODIES: best hit so far
};

// Shared meshes are Embree instances; meshes used once lie in the top scene under their own number.
static uint instanceOf(uint geomID, uint instID) {
  return instID != RTC_INVALID_GEOMETRY_ID ? instID : geomID;
}

static void alphaFilterPath(const RTCFilterFunctionNArguments* args) {
  auto* context = reinterpret_cast<TraceContext*>(args->context);
  const auto* embreeHit = reinterpret_cast<const RTCHit*>(args->hit);
  Hit hit;
  hit.instance = instanceOf(embreeHit->geomID, embreeHit->instID[0]);
  hit.primitive = embreeHit->primID;
  hit.bary = vec2(embreeHit->u, embreeHit->v);
  hit.t = 0.0f;
  float alpha = context->self->surfaceAlpha(hit);
  if (context->self->traceAlphaAccepts(context->key, hit, alpha)) return;
  args->valid[0] = 0;
  context->self->traceAlphaPass(context->passed, hit, alpha);
}

static void alphaFilterShadow(const RTCFilterFunctionNArguments* args) {
  auto* context = reinterpret_cast<TraceContext*>(args->context);
  const auto* embreeHit = reinterpret_cast<const RTCHit*>(args->hit);
  Hit hit;
  hit.instance = instanceOf(embreeHit->geomID, embreeHit->instID[0]);
  hit.primitive = embreeHit->primID;
  hit.bary = vec2(embreeHit->u, embreeHit->v);
  hit.t = 0.0f;
  if (RL_HAS(RL_FEATURE_VOLUME) && context->self->mediaPasses(context->key, hit)) {
    args->valid[0] = 0;
    return;
  }
  context->self->traceAlphaPass(context->passed, hit, context->self->surfaceAlpha(hit));
  if (context->passed.transmittance > 0.0f) args->valid[0] = 0;
}

static void bodyFilter(const RTCFilterFunctionNArguments* args) {
  auto* context = reinterpret_cast<TraceContext*>(args->context);
  const auto* embreeHit = reinterpret_cast<const RTCHit*>(args->hit);
  args->valid[0] = 0;
  Hit hit;
  hit.instance = instanceOf(embreeHit->geomID, embreeHit->instID[0]);
  hit.primitive = embreeHit->primID;
  hit.bary = vec2(embreeHit->u, embreeHit->v);
  hit.t = 0.0f;
  if (context->self->traceIsNextBody(context->body, hit, context->key)) context->body = hit;
}

RL_FN float traceRay(const Ray& ray, uint mode, uint key, Hit& hit) {
  TraceContext context;
  embreeInitContext(context.alpha.embree);
  if (RL_HAS(RL_FEATURE_ALPHA | RL_FEATURE_VOLUME)) {
    context.self = this;
    context.key = key;
    context.passed = traceAlphaNone();
    context.alpha.filter = mode == RL_RAY_PATH ? alphaFilterPath : alphaFilterShadow;
    if (RL_HAS(RL_FEATURE_VOLUME) && mode == RL_RAY_BODIES) {
      context.body = traceNoHit();
      context.alpha.filter = bodyFilter;
    }
  }
  RL_COUNT_RAY(mode);
  if (mode == RL_RAY_SHADOW) {
    RTCRay r;
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.tnear = ray.tMin;
    r.dir_x = ray.dir.x;
    r.dir_y = ray.dir.y;
    r.dir_z = ray.dir.z;
    r.time = 0.0f;
    r.tfar = ray.tMax;
    r.mask = 0xffffffffu;
    r.id = 0u;
    r.flags = 0u;
    embreeOccluded(embreeScene, context.alpha.embree, r);
    if (r.tfar < 0.0f) return 0.0f;
    if (RL_HAS(RL_FEATURE_ALPHA)) return context.passed.transmittance;
    return 1.0f;
  }
  RTCRayHit r;
  r.ray.org_x = ray.origin.x;
  r.ray.org_y = ray.origin.y;
  r.ray.org_z = ray.origin.z;
  r.ray.tnear = ray.tMin;
  r.ray.dir_x = ray.dir.x;
  r.ray.dir_y = ray.dir.y;
  r.ray.dir_z = ray.dir.z;
  r.ray.time = 0.0f;
  r.ray.tfar = ray.tMax;
  r.ray.mask = 0xffffffffu;
  r.ray.id = 0u;
  r.ray.flags = 0u;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embreeIntersect(embreeScene, context.alpha.embree, r);
  if (RL_HAS(RL_FEATURE_VOLUME) && mode == RL_RAY_BODIES) {
    hit = context.body;
    return 1.0f;
  }
  hit.instance = RL_INVALID;
  float passed = 1.0f;
  if (RL_HAS(RL_FEATURE_ALPHA)) passed = context.passed.transmittance;
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return passed;
  hit.instance = instanceOf(r.hit.geomID, r.hit.instID[0]);
  hit.primitive = r.hit.primID;
  hit.bary = vec2(r.hit.u, r.hit.v);
  hit.t = r.ray.tfar;
  return passed;
}
