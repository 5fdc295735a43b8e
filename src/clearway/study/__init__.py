"""Experiments and benchmarks: sets of instances, a row each."""
