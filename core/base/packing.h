// Packing and unpacking functions of the dialect (core/dialect/pack.glsl), for the host.
#pragma once

#include "core/dialect/order.h"

namespace rl {

struct Packing {
#include "core/dialect/math.glsl"
#include "core/dialect/pack.glsl"
};

}  // namespace rl
