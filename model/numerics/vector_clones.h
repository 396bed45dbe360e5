// HOWL_VECTOR_CLONES before a function: one copy for each width of vectors, of which the machine
// takes the widest that it has. All give the same bits, as such a source is compiled without fused
// products (-ffp-contract=off in its library's CMakeLists.txt).
#ifndef HOWL_MODEL_NUMERICS_VECTOR_CLONES_H_
#define HOWL_MODEL_NUMERICS_VECTOR_CLONES_H_

// Which copy is taken is asked before the thread sanitizer has begun: it would fail in the
// question.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define HOWL_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HOWL_VECTOR_CLONES
#endif
// Into each copy, what it calls.
#define HOWL_IN_CLONES [[gnu::always_inline]] inline

#endif  // HOWL_MODEL_NUMERICS_VECTOR_CLONES_H_
