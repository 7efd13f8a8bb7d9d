#!/usr/bin/env python3
"""Writes tests/measured_times.cmake from the times of a run of all tests.

    ctest --preset release --output-junit times.xml; tests/measure_times.py build/release/times.xml

Tests of two seconds and more are listed. Those of LIMIT seconds and more get the label `full`, unless they are the only
ones of their kind: such exceptions are listed in KEPT, with the reason.
"""
