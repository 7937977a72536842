// The main function of a program of benchmarks.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>

#include "irk/misuse.h"

namespace irk {

/// Runs the benchmarks that `add_all` registers. Returns the exit status: 2 for bad arguments and Misuse.
inline int runBenchmarks(int argc, char** argv, const char* program, void (*add_all)()) {
  try {
    add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const Misuse& misuse) {
    std::fprintf(stderr, "%s: %s\n", program, misuse.what());
    return 2;
  }
  return 0;
}

}  // namespace irk
