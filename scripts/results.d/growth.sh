# Time and memory of pose graphs of up to 100,000 poses. GROWTH_POSES names other sizes.
export OPENBLAS_NUM_THREADS=1
build_bench bench_graph_growth
heading "Time and memory against the number of poses: 3D grid worlds"
command_line "OPENBLAS_NUM_THREADS=1 build/release/tests/bench/bench_graph_growth docs/images/graph_growth.png ${GROWTH_POSES:-}"
gap
say "growth"
build/release/tests/bench/bench_graph_growth "$out/growth.png" ${GROWTH_POSES:-1000 3000 10000 30000 100000} >> "$rows"
cp "$out/growth.png" docs/images/graph_growth.png
picture "CPU and memory over the number of poses" graph_growth.png
