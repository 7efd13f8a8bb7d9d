# Read by ctest when all tests are known: assigns the label `full` to those that scripts/test leaves to scripts/test
# --full. Each takes long and covers the same ground as shorter tests that remain (docs/testing.md).
set(full
  # Boundaries of four and sixteen times fewer triangles stay.
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/torus_16x
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/capsule_16x
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/pear_16x
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/oblate_16x
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/prolate_16x
  analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/triaxial_16x
  # The other runs of Kills write more kinds of files; the other tests of goals cover them one by one.
  cli.Kills.LeaveWholeFilesOrNone/Spheres
  cli.SpheresCommand.CoversAndBalancedSetsMeetGoals
  # Other seeds of the same mutations remain, as do levels and smaller covers, and the contacts that a foam holds.
  property.Mutations.AreRefusedOrCertifiedAndAgreeWithTheReference/2
  property.Mutations.AreRefusedOrCertifiedAndAgreeWithTheReference/3
  property.SphereCover.CoversEverySolidWithAnyNumber
  property.SphereCover.MoreBallsAreNeverWorse
  property.Foam.BoundsWidthAndDepth
  # Hundreds of thousands of triangles, in LoopBudget, remain.
  regression.LargeMesh.TheCircleInATorusOfHalfAMillionTriangles
  regression.LargeMesh.DistancesToATorusOfFiveMillionTriangles)
# Left out of the tests under ASan that scripts/test --asan-host runs; tests/CMakeLists.txt has those of unit.
set_tests_properties(faults.PoorDevice.WithNoMoreThanWhatIsRequiredGivesTheSameAnswers PROPERTIES
  LABELS "faults;sanitized_full")
foreach(name ${full})
  string(REGEX REPLACE "[.].*" "" folder "${name}")
  set_tests_properties("${name}" PROPERTIES LABELS "${folder};full")
endforeach()
