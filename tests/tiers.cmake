# Read by ctest when all tests are known: those that get the label `full`, which scripts/test leaves to scripts/test --full.
# Each takes long and goes over the same ground as shorter ones that stay (docs/testing.md).
set(full)
foreach(name ${full})
  string(REGEX REPLACE "[.].*" "" folder "${name}")
  set_tests_properties("${name}" PROPERTIES LABELS "${folder};full")
endforeach()
