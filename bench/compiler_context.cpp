// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

// Figures mean nothing without them; every program tells them before its first line and in its JSON.
namespace {

#ifdef NDEBUG
constexpr const char* kAssertions = "off";
#else
constexpr const char* kAssertions = "ON: these figures are of a debug build";
#endif

#ifdef __clang__
constexpr const char* kCompiler = "Clang " __clang_version__;
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif

[[maybe_unused]] const bool told = [] {
  benchmark::AddCustomContext("compiler", kCompiler);
  benchmark::AddCustomContext("flags", BEACONLESS_CXX_FLAGS);
  benchmark::AddCustomContext("assertions", kAssertions);
  return true;
}();

}  // namespace
