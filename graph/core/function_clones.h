#pragma once

// A function marked PLACEGRAPH_CLONES is compiled for the instructions of several processors, and
// the one at hand chosen at run time; what it calls must be PLACEGRAPH_INLINE to be compiled along.
// Sanitizers do not know the dispatch.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PLACEGRAPH_CLONES __attribute__((target_clones("arch=haswell", "default")))
#define PLACEGRAPH_INLINE __attribute__((always_inline)) inline
#else
#define PLACEGRAPH_CLONES
#define PLACEGRAPH_INLINE inline
#endif
