# How the cost grows up to 100,000 poses. GROWTH_POSES names other sizes.
export OPENBLAS_NUM_THREADS=1
cmake --preset release -DPLACEGRAPH_BENCH=ON > "$out/configure.log"
cmake --build --preset release -j2 --target bench_graph_growth
cmake --preset release -DPLACEGRAPH_BENCH=OFF > "$out/configure.log"
heading "Growth: grid worlds in space"
command_line "OPENBLAS_NUM_THREADS=1 build/release/tests/bench/bench_graph_growth docs/images/graph_growth.png ${GROWTH_POSES:-}"
echo >> "$rows"
say "growth"
build/release/tests/bench/bench_graph_growth "$out/growth.png" ${GROWTH_POSES:-1000 3000 10000 30000 100000} >> "$rows"
cp "$out/growth.png" docs/images/graph_growth.png
printf '\n![CPU and memory over the number of poses](images/graph_growth.png)\n' >> "$rows"
