// Embree 3 and 4 alike: no other file names a version of Embree. Version 3 takes the context of a
// query itself, version 4 takes arguments that point to it.
#pragma once

#if RESTLAB_EMBREE_MAJOR == 4  // cmake/dependencies.cmake says which was found
#include <embree4/rtcore.h>
#elif RESTLAB_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#error "RESTLAB_EMBREE_MAJOR is neither 3 nor 4"
#endif

namespace rl {

#if RESTLAB_EMBREE_MAJOR == 4
// Context of a query; filters get it back as `context` of their arguments.
using EmbreeContext = RTCRayQueryContext;

inline void embreeInitContext(EmbreeContext& context) { rtcInitRayQueryContext(&context); }

// Finds the closest hit; geomID stays RTC_INVALID_GEOMETRY_ID where there is none.
inline void embreeIntersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}

// Asks for any hit; tfar is below 0 afterwards where there is one.
inline void embreeOccluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using EmbreeContext = RTCIntersectContext;

inline void embreeInitContext(EmbreeContext& context) { rtcInitIntersectContext(&context); }

inline void embreeIntersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}

inline void embreeOccluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace rl
