// Mathematical constants of the dialect.
#ifndef RL_MATH_H
#define RL_MATH_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

const float RL_PI = 3.14159265358979f;
const float RL_INV_PI = 0.318309886183791f;
// Relative rounding error bound of a reconstructed hit point plus a ray-triangle test against it:
// 32 units in the last place of the largest coordinate involved.
const float RL_HIT_ERROR = 1.9073486328125e-6f;

RL_NAMESPACE_END

#endif
