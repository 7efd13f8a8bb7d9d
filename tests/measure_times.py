#!/usr/bin/env python3
"""Writes tests/measured_times.cmake from ctest's report of a run of all tests, or of those that scripts/test runs: the
tests in tests/tiers.cmake then keep their times.

    ctest --preset release --output-junit times.xml
    tests/measure_times.py build/release/times.xml [FACTOR]

Tests of a second and more are listed. FACTOR: a factor for the times, if the machine had other load.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree

folder = pathlib.Path(__file__).parent
written = folder / "measured_times.cmake"
report, factor = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1.0
cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
times = {case.get("name"): round(float(case.get("time")) * factor) for case in cases}
full = set((folder / "tiers.cmake").read_text().split())
for name, seconds in re.findall(r'  "(.*)" (\d+)', written.read_text()):
    if name in full:
        times.setdefault(name, int(seconds))
lines = [f'  "{name}" {seconds}' for name, seconds in sorted(times.items(), key=lambda item: (-item[1], item[0])) if seconds]
text = """# Written by tests/measure_times.py, read by ctest: the seconds of the slowest tests. Those that cost most start first.
set(times
%s)
while(times)
  list(POP_FRONT times name seconds)
  set_tests_properties("${name}" PROPERTIES COST ${seconds})
endwhile()
"""
written.write_text(text % "\n".join(lines))
