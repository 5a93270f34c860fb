#pragma once

// A function marked PLACEGRAPH_CLONES is compiled for the instructions of several processors, and
// the one at hand chosen at run time (PLACEGRAPH_COUNTS_BITS: by how it counts bits); what it calls
// must be PLACEGRAPH_INLINE to be compiled along. Asked for is what the instructions are, not whose
// processor it is: arch=haswell would be chosen on that one alone, and not on what came after it.
// Sanitizers do not know the dispatch.
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
