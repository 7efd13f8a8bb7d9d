# Read by ctest after all tests are known. Seconds of the slowest tests on one core, measured, so that they start first
# (CTEST's COST), with the share of them that is left to scripts/test --full behind a second label, `full`.
# tests/measure_times.py writes the two lists from a report of ctest.
