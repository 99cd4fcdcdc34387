// The kernel dialect: types and macros that make one file valid C++20 (on GLM) and valid GLSL 4.60.
//
// Rules (docs/dialect.md has the reasons): *.h hold types and constants and are included at
// namespace scope before everything else; *.glsl hold functions only and are included inside the
// kernel context; a *.glsl never includes a *.h; literals carry `f` or `u`; one random draw a
// statement; no swizzle but .x .y .z .w; no recursion, no references, no default arguments.
#ifndef RL_DIALECT_H
#define RL_DIALECT_H

#ifdef __cplusplus

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <glm/glm.hpp>

namespace rl {

using namespace glm;
using uint = std::uint32_t;
// Features and kinds of closures of a scene (core/dialect/features.h).
using FeatureMask = std::uint64_t;

// The resampling algebra is written with `real`: float when rendering, double in the exact tests.
#ifdef RL_REAL_DOUBLE
using real = double;
using real3 = glm::dvec3;
#else
using real = float;
using real3 = glm::vec3;
#endif

inline uint wordAt(const void* from, std::size_t i) {
  uint word;
  std::memcpy(&word, static_cast<const unsigned char*>(from) + 4 * i, sizeof word);
  return word;
}
// Loads word by word, so that the compiler loads only the words that are used.
inline uvec4 uvec4At(const void* from, uint i) {
  const std::size_t at = std::size_t{4} * i;
  return uvec4(wordAt(from, at), wordAt(from, at + 1), wordAt(from, at + 2), wordAt(from, at + 3));
}
inline uvec3 tripleAt(const void* from, uint i) {
  const std::size_t at = std::size_t{3} * i;
  return uvec3(wordAt(from, at), wordAt(from, at + 1), wordAt(from, at + 2));
}
inline void writeUvec4At(void* to, uint i, const uvec4& value) {
  std::memcpy(static_cast<unsigned char*>(to) + std::size_t{16} * i, &value, sizeof value);
}

inline std::atomic_ref<uint> atomicAt(uint* data, std::size_t i) {
  return std::atomic_ref<uint>(data[i]);
}
inline uint atomicCas(uint* data, std::size_t i, uint expected, uint value) {
  atomicAt(data, i).compare_exchange_strong(expected, value, std::memory_order_relaxed);
  return expected;
}
inline uint atomicGreatest(uint* data, std::size_t i, uint value) {
  uint before = atomicAt(data, i).load(std::memory_order_relaxed);
  while (before < value &&
         !atomicAt(data, i).compare_exchange_weak(before, value, std::memory_order_relaxed)) {
  }
  return before;
}
inline void markAt(uint* data, std::size_t i) {
  const std::atomic_ref<uint> mark = atomicAt(data, i);
  if (mark.load(std::memory_order_relaxed) == 0) mark.store(1, std::memory_order_relaxed);
}

}  // namespace rl

#ifdef RL_REAL_DOUBLE
// Types that hold a `real` have another size here: without a name of their own a linker would mix
// what is made of them (std::vector<Shifted>) with that of other files of a program.
#define RL_NAMESPACE_BEGIN \
  namespace rl {           \
  inline namespace of_double {
#define RL_NAMESPACE_END \
  }                      \
  }
#else
#define RL_NAMESPACE_BEGIN namespace rl {
#define RL_NAMESPACE_END }
#endif
#define RL_FN inline
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
#define RL_IS_NULL(ref) ((ref).data == nullptr)
// Minimum and maximum of two numbers that are not NaN. min() and max() also handle NaN, which costs
// three instructions on some devices.
#define RL_LESSER(a, b) ((a) < (b) ? (a) : (b))
#define RL_GREATER(a, b) ((a) > (b) ? (a) : (b))
// Access four words at once, whatever the type behind the address. The i-th uvec4 lies at byte
// offset 16 i.
#define RL_UVEC4(ref, i) ::rl::uvec4At((ref).data, i)
#define RL_WRITE_UVEC4(ref, i, value) ::rl::writeUvec4At((ref).data, i, value)
// Read scene data, which no kernel writes. On some devices these reads go through texels
// (core/backend/glsl_preamble.cpp).
#define RL_SCENE_UVEC4(ref, i) RL_UVEC4(ref, i)
#define RL_SCENE_UINT(ref, i) ((ref).data[i])
#define RL_SCENE_FLOAT(ref, i) ((ref).data[i])
#define RL_SCENE_VEC2(ref, i) ((ref).data[i])
#define RL_SCENE_VEC3(ref, i) ((ref).data[i])
#define RL_SCENE_UVEC3(ref, i) ::rl::tripleAt((ref).data, i)
// Reads data of an earlier pass. Valid only before this pass writes there, never after.
#define RL_EARLIER_UVEC4(ref, i) RL_UVEC4(ref, i)
// Atomic operations on uints of a buffer that several pixels write in one pass. Each returns the
// old value. Results must not depend on execution order: sums and maxima do not. A compare-and-swap
// that claims a slot does, if the slot matters for the result.
#define RL_ATOMIC_ADD(ref, i, value) \
  ::rl::atomicAt((ref).data, i).fetch_add(value, std::memory_order_relaxed)
#define RL_ATOMIC_MAX(ref, i, value) ::rl::atomicGreatest((ref).data, i, value)
#define RL_ATOMIC_CAS(ref, i, expected, value) ::rl::atomicCas((ref).data, i, expected, value)
// Sets a uint to 1 that several pixels may set. CPUs read first: most find it set.
#define RL_MARK(ref, i) ::rl::markAt((ref).data, i)
// Kinds of closures stand above the other features. On the GPU they have a word of their own.
#define RL_HAS_CLOSURES RL_HAS(::rl::RL_FEATURE_CLOSURES)
#define RL_HAS_CLOSURE(kind) \
  RL_HAS(::rl::FeatureMask{1} << (::rl::RL_FEATURE_CLOSURE_SHIFT + (kind)))
// Kinds of shapes, likewise.
#define RL_HAS_SHAPES RL_HAS(::rl::RL_FEATURE_SHAPES)
#define RL_HAS_SHAPE(kind) RL_HAS(::rl::FeatureMask{1} << (::rl::RL_FEATURE_SHAPE_SHIFT + (kind)))
#define RL_STATIC_ASSERT_SIZE(T, bytes) static_assert(sizeof(T) == (bytes), #T " layout changed")

#else  // GLSL 4.60

#define FeatureMask uint
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
#define RL_IS_NULL(ref) (uint64_t(ref) == 0ul)
#define RL_ATOMIC_ADD(ref, i, value) atomicAdd((ref).data[i], value)
#define RL_ATOMIC_MAX(ref, i, value) atomicMax((ref).data[i], value)
#define RL_ATOMIC_CAS(ref, i, expected, value) atomicCompSwap((ref).data[i], expected, value)
#define RL_MARK(ref, i) (ref).data[i] = 1u
#define RL_STATIC_ASSERT_SIZE(T, bytes)

#endif

#endif
