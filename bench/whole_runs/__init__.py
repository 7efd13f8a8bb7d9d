"""What bench/run and bench/compare share: meshes, timed runs, tables and plots. Python's standard library only."""
