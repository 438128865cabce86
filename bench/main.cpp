// importon_bench: see --help for Google Benchmark's options.
#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
