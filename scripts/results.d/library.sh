# What a program that embeds the library meets: headers, libraries at start, symbols, and the time it compiles.
# The shared library is that of build/shared (scripts/test.d/packages_test).
title="The library in a program: headers, start, symbols, compile time"
heading "$title"
command_line "cmake --install build/release --prefix PREFIX"
command_line "placegraph --version; g++ -O2 -c tests/install/optimize_only.cpp (headers of PREFIX)"
prefix=$out/library
rm -rf "$prefix"
cmake --install build/release --prefix "$prefix" > "$out/library.log" || cat "$out/library.log" >&2
include=$prefix/include
# started PROGRAM ARGUMENT...: median of 11 starts, [ms of wall clock, MB resident at most]
started() {
  python3 - "$@" << 'PY'
import resource, subprocess, sys, time
spans = []
for _ in range(11):
    begin = time.perf_counter()
    subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
    spans.append(time.perf_counter() - begin)
print(f"{1e3 * sorted(spans)[5]:.1f} {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.1f}")
PY
}
behind=$(g++ -std=c++20 -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1 -I"$include" -I/usr/include/eigen3 -I/usr/include/opencv4 -M \
  "$include/placegraph/pipeline/slam.h" | tr ' ' '\n' | grep -c "$include/placegraph/")
compiled=$(for k in 1 2 3 4 5; do
  python3 - "$include" << 'PY'
import resource, subprocess, sys
subprocess.run(["g++", "-std=c++20", "-O2", "-DEIGEN_MAX_ALIGN_BYTES=16",
                "-DEIGEN_MALLOC_ALREADY_ALIGNED=1", f"-I{sys.argv[1]}", "-isystem", "/usr/include/eigen3",
                "-c", "tests/install/optimize_only.cpp", "-o", "/dev/null"], check=True)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(usage.ru_utime + usage.ru_stime)
PY
done | median)
start=$(started "$placegraph" --version)
columns figure target measured met
count=$(find "$include" -name '*.h' | wc -l)
cells "installed headers" "<= 150" "$count" "$(verdict "$count" "<=" 150)"
cells "headers of the project behind pipeline/slam.h" "<= 40" "$((behind - 1))" "$(verdict "$((behind - 1))" "<=" 40)"
cells "libraries mapped by placegraph at start" "" "$(ldd "$placegraph" | wc -l)" ""
cells "placegraph --version [ms], median of 11" "<= 40" "${start% *}" "$(verdict "${start% *}" "<=" 40)"
cells "placegraph --version [MB]" "<= 40" "${start#* }" "$(verdict "${start#* }" "<=" 40)"
shared=$(find build/shared/lib -name 'libplacegraph.so.*.*.*' 2> /dev/null | head -n 1)
if [ -n "$shared" ]; then
  cells "symbols that the shared library exports, of namespace placegraph" "" \
    "$(nm -DC --defined-only "$shared" | wc -l), $(nm -DC --defined-only "$shared" | grep -c ' placegraph::')" ""
fi
cells "a program of 30 lines with the optimizer alone, compiled [s of CPU], median of 5" "" "$(digits "$compiled" 2)" ""
