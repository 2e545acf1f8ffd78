"""Derives the dynamics of six-legged parallel platforms with CasADi and writes them as an expression graph."""
