// The shared kernel language: the words that make one file valid C++20 on GLM and valid GLSL 4.60.
//
// Rules (docs/dialect.md has the reasons): *.h hold types and constants and are included at
// namespace scope before everything else; *.glsl hold functions only and are included inside the
// kernel context; a *.glsl never includes a *.h; literals carry `f` or `u`; one random draw a
// statement; no swizzle but .x .y .z .w; no recursion, no references, no default arguments.
#ifndef RL_DIALECT_H
#define RL_DIALECT_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace rl {

using namespace glm;
using uint = std::uint32_t;

// The resampling algebra is written with `real`: float when rendering, double in the exact tests.
#ifdef RL_REAL_DOUBLE
using real = double;
using real3 = glm::dvec3;
#else
using real = float;
using real3 = glm::vec3;
#endif

}  // namespace rl

#define RL_NAMESPACE_BEGIN namespace rl {
#define RL_NAMESPACE_END }
#define RL_FN inline __attribute__((always_inline))
// For functions with several call sites whose inlining only bloats the caller.
#define RL_FN_OUTLINE inline __attribute__((noinline))
#define RL_IN(T) const T&
#define RL_INOUT(T) T&
#define RL_OUT(T) T&
// Prototypes: GLSL needs a function declared before its use, a C++ class does not allow it twice.
#define RL_PROTO(declaration)
// A typed buffer address; `name.data[i]` reads element i on both machines.
#define RL_REF(Name, T) \
  struct Name {         \
    T* data;            \
  };
// The address of pairs of words: RL_PAIR(name, i) reads two words in one access.
#define RL_PAIR_REF(Name) \
  struct Name {           \
    uvec2* data;          \
  };
#define RL_PAIR(ref, i) ((ref).data[i])
#define RL_STATIC_ASSERT_SIZE(T, bytes) static_assert(sizeof(T) == (bytes), #T " layout changed")

#else  // GLSL 4.60

#define real float
#define real3 vec3
#define RL_NAMESPACE_BEGIN
#define RL_NAMESPACE_END
#define RL_FN
#define RL_FN_OUTLINE
#define RL_IN(T) in T
#define RL_INOUT(T) inout T
#define RL_OUT(T) out T
#define RL_PROTO(declaration) declaration;
#define RL_REF(Name, T) \
  layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Name { T data[]; };
#define RL_PAIR_REF(Name) \
  layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Name { uint64_t data[]; };
#define RL_PAIR(ref, i) unpackUint2x32((ref).data[i])
#define RL_STATIC_ASSERT_SIZE(T, bytes)

#endif

#endif
