"""Writes C by CasADi of the dynamics that dyn-gen generates, to measure generated code against (docs/benchmarks.md)."""
