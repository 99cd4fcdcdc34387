// All types and constants of the dialect, at namespace scope, before any function.
#ifndef RL_ORDER_H
#define RL_ORDER_H
#include "core/dialect/dialect.h"
#include "core/dialect/features.h"
#include "core/dialect/lanes.h"
#include "core/dialect/types.h"
#include "core/dialect/math.h"
#include "core/dialect/sampling.h"
#include "core/shading/bsdf.h"
#include "core/geometry/surface.h"
#include "core/geometry/shape.h"
#include "core/geometry/field/field.h"
#include "core/geometry/material_point.h"
#include "core/shading/light.h"
#include "core/geometry/trace_bvh.h"
#include "core/gbuffer/gbuffer.h"
#endif
