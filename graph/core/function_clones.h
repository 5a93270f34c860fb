#pragma once

// A function marked PLACEGRAPH_CLONES is compiled for several instruction sets, one of which is
// chosen at run time (PLACEGRAPH_COUNTS_BITS: by the instruction that counts bits). Functions that
// it calls must be PLACEGRAPH_INLINE to be compiled with it. The choice depends on the instruction
// set, not on the model of the processor: arch=haswell would be chosen on that model alone, not on
// later ones. Sanitizers do not support the dispatch.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PLACEGRAPH_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#define PLACEGRAPH_COUNTS_BITS __attribute__((target_clones("popcnt", "default")))
#define PLACEGRAPH_COUNTS_MANY_BITS __attribute__((target("avx512vpopcntdq,popcnt")))
#define PLACEGRAPH_INLINE __attribute__((always_inline)) inline
#else
#define PLACEGRAPH_CLONES
#define PLACEGRAPH_COUNTS_BITS
#define PLACEGRAPH_INLINE inline
#endif
