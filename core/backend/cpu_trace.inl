// traceRay() on Embree; included inside Ctx<features>, so that it is specialised with the kernel.

// Embree hands the context back to the alpha filters; the kernel context follows Embree's.
struct TraceContext {
  KernelTraceContext query;
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

// Returns whether the filter of a query has a say about hits on an instance.
static bool shapeAsksFilter(const Ctx* self, const Instance& inst) {
  const bool mayPass = RL_HAS(RL_FEATURE_ALPHA) && (inst.flags & RL_INSTANCE_ALPHA) != 0u;
  return mayPass || (RL_HAS(RL_FEATURE_VOLUME) && self->gScene.bodiesMeet != 0u &&
                     inst.flags >> RL_INSTANCE_RANK_SHIFT != 0u);
}

// Finds the first point of a shape on a ray that the filter of the query accepts.
template <class Arguments>
static bool shapeMeets(const Arguments& args, const RTCRay& embreeRay, Hit& hit) {
  const auto* context = reinterpret_cast<const TraceContext*>(args.context);
  Ctx* self = context->self;
  hit.instance = args.geomID;
  const Instance inst = self->recordInstance(hit.instance);
  const Geometry geometry = self->recordGeometry(inst.geometry);
  Ray ray{vec3(embreeRay.org_x, embreeRay.org_y, embreeRay.org_z), embreeRay.tnear,
          vec3(embreeRay.dir_x, embreeRay.dir_y, embreeRay.dir_z), embreeRay.tfar};
  while (self->shapeTrace(inst, geometry, ray, hit)) {
    if (!shapeAsksFilter(self, inst)) return true;
    RTCHit met{};
    met.u = hit.bary.x;
    met.v = hit.bary.y;
    met.primID = hit.primitive;
    met.geomID = args.geomID;
    met.instID[0] = RTC_INVALID_GEOMETRY_ID;
    int valid = -1;
    RTCFilterFunctionNArguments filter{};
    filter.valid = &valid;
    filter.context = args.context;
    filter.hit = reinterpret_cast<RTCHitN*>(&met);
    filter.N = 1;
    context->query.filter(&filter);
    if (valid != 0) return true;
    ray.tMin = hit.t;
  }
  return false;
}

static void shapeIntersectCallback(const RTCIntersectFunctionNArguments* args) {
  auto* r = reinterpret_cast<RTCRayHit*>(args->rayhit);
  Hit hit;
  if (args->valid[0] == 0 || !shapeMeets(*args, r->ray, hit)) return;
  r->ray.tfar = hit.t;
  r->hit.u = hit.bary.x;
  r->hit.v = hit.bary.y;
  r->hit.primID = hit.primitive;
  r->hit.geomID = args->geomID;
  r->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

static void shapeOccludedCallback(const RTCOccludedFunctionNArguments* args) {
  auto* r = reinterpret_cast<RTCRay*>(args->ray);
  Hit hit;
  if (args->valid[0] == 0 || !shapeMeets(*args, *r, hit)) return;
  r->tfar = -std::numeric_limits<float>::infinity();
}

RL_FN float traceRay(const Ray& ray, uint mode, uint key, Hit& hit) {
  TraceContext context;
  embreeInitContext(context.query.embree);
  if (RL_HAS_SHAPES) {
    context.self = this;
    context.query.intersectShape = shapeIntersectCallback;
    context.query.occludedByShape = shapeOccludedCallback;
  }
  if (RL_HAS(RL_FEATURE_ALPHA | RL_FEATURE_VOLUME)) {
    context.self = this;
    context.key = key;
    context.passed = traceAlphaNone();
    context.query.filter = mode == RL_RAY_PATH ? alphaFilterPath : alphaFilterShadow;
    if (RL_HAS(RL_FEATURE_VOLUME) && mode == RL_RAY_BODIES) {
      context.body = traceNoHit();
      context.query.filter = bodyFilter;
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
    embreeOccluded(embreeScene, context.query.embree, r);
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
  embreeIntersect(embreeScene, context.query.embree, r);
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
