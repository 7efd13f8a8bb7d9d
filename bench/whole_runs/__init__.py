"""The shared parts of bench/run and bench/compare: meshes, timed runs, tables and plots, by the standard library alone."""
