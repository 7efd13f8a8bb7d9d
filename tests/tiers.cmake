# Read by ctest when all tests are known: assigns the labels `slow`, of tests that scripts/test leaves to scripts/test --slow
# and to .ci/run, and `full`, of those that both leave to scripts/test --full. A test labelled `full` covers the same ground
# as shorter tests that remain (docs/testing.md). Tests of page, package and second_driver have theirs where they are added.
set(slow
  # Certified extractions, copies that are late, and smaller pictures and fits fail in the same ways.
  faults.HostMemory.RunsOutInThesisExtraction
  faults.PictureFaults.OfMemory
  faults.TwoQueueFaults.OfManyChunks/CopiesAreLate
  faults.TwoQueueFaults.OfManyChunks/KernelsAreLate
  faults.VulkanFaults.OfThesisExtraction
  counts.WorkCounts.AFitOfPartsBuildsOneTreeAndUploadsOncePerPart
  # Meshes that are read through storage buffers remain, and the limits by themselves.
  faults.PoorDevice.WithNoMoreThanWhatIsRequiredGivesTheSameAnswers
  # One rounding of three remains.
  unit.OtherSpecialsTest.AnOpenMesh/low
  unit.OtherSpecialsTest.AnOpenMesh/zero
  # Blocks of a top cell remain.
  property.Determinism.AVoxelThatDoesNotFitIsDividedLess
  # Smaller solids and meshes remain.
  property.Dismissal.AtFinsAndFansLosesNoSalientSample
  unit.ReferenceDismissal.DismissedBoxesHoldNoSalientPoint
  regression.LoopBudget.ClustersAreExpandedInRounds
  regression.LoopBudget.MoreTrianglesThanEightBudgets
  property.Solids/DismissalOfSolids.LosesNoSalientSample/capsule
  property.Solids/DismissalOfSolids.LosesNoSalientSample/prolate
  property.Solids/DismissalOfSolids.LosesNoSalientSample/torus
  unit.ReferenceDismissal.UntrustedTrianglesFromEitherSide
  unit.ReferenceUndecided.HiddenPointsAreAsTheirVoxelSays
  unit.SceneTest.MeshesTooLargeForTheDeviceAreRefusedBeforeAnythingIsBuilt
  # Shorter lists of open edges, smaller polygons, fewer contexts and balls remain, as do other foams and seeds.
  gpu_vs_cpu.CertifiedOpen.MoreOpenEdgesThanAreListed
  unit.ReadLimits.AHundredThousandFacesThatAreAllClose
  embedding.Contexts.AThousandOfThemLeaveNothingBehind
  unit.FitParts.StopsAtAnyQuery
  counts.WorkCounts.AFitOfSpheresBuildsOneTreeAndUploadsOnce
  property.Foam.HoldsTheContactsOfEveryMedialPointOfTheHull
  property.Mutations.AreRefusedOrCertifiedAndAgreeWithTheReference/1
  # Calls of the host that fail one by one in shorter sequences remain.
  faults.HostCallbacks.RunOut
  faults.RecordedJobFaults.OfASequenceThatIsRecordedAgain)
set(full
  # The other runs of Kills write more kinds of files; the other tests of goals cover them one by one.
  cli.Kills.LeaveWholeFilesOrNone/Spheres
  cli.SpheresCommand.CoversAndBalancedSetsMeetGoals
  # Other seeds of the same mutations remain, as do levels and smaller covers, and the contacts that a foam holds.
  property.Mutations.AreRefusedOrCertifiedAndAgreeWithTheReference/2
  property.Mutations.AreRefusedOrCertifiedAndAgreeWithTheReference/3
  property.SphereCover.CoversEverySolidWithAnyNumber
  property.SphereCover.MoreBallsAreNeverWorse
  property.Foam.BoundsWidthAndDepth
  # Smaller figures remain.
  regression.Assembly.OfHalfAMillionTrianglesExtracts
  # Hundreds of thousands of triangles, in LoopBudget, remain.
  regression.LargeMesh.TheCircleInATorusOfHalfAMillionTriangles
  regression.LargeMesh.DistancesToATorusOfFiveMillionTriangles
  regression.LargeMesh.TheCircleInATorusOfFiveMillionTriangles)
# Boundaries of four and sixteen times as many triangles; the coarsest remain.
foreach(solid torus capsule pear oblate prolate triaxial)
  list(APPEND slow analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/${solid}_4x)
  list(APPEND full analytic.Smooth/Tessellation.MedialSurfaceIsThatOfTheSmoothSolid/${solid}_16x)
endforeach()
foreach(name ${full})
  string(REGEX REPLACE "[.].*" "" folder "${name}")
  set_tests_properties("${name}" PROPERTIES LABELS "${folder};full")
endforeach()
# Left out of the tests under ASan that scripts/test --asan-host runs, too; tests/CMakeLists.txt has those of unit. A
# process that is killed reports nothing to the sanitizers; smaller meshes, pictures and fits remain, and batches that go on.
set(sanitized_full
  cli.BatchKills.LoseTheMeshAtWorkAtMost
  cli.BatchMerge.KillsLeaveLinesThatAreTrue
  cli.BatchOtherOptions.NoKillMixesTwoRuns
  cli.Kills.LeaveWholeFilesOrNone/AllFiles
  cli.Kills.LeaveWholeFilesOrNone/Points
  cli.SpheresCommand.BestGivesTheSameBytesOnAnyNumberOfThreads
  faults.PictureFaults.OfMemory
  faults.PoorDevice.ReadsALargeMeshThroughStorageBuffers
  faults.PoorDevice.RefusesAMeshThatItCanReadNeitherWay
  faults.PoorDevice.WithNoMoreThanWhatIsRequiredGivesTheSameAnswers)
foreach(name ${sanitized_full})
  string(REGEX REPLACE "[.].*" "" folder "${name}")
  set_tests_properties("${name}" PROPERTIES LABELS "${folder};sanitized_full")
endforeach()
# One of three has the same label slow_N, for scripts/test --slow-part N; the tests on a second driver have theirs where
# they are added. (ctest's scripts have no operator IN_LIST.)
set(number 0)
foreach(name ${slow})
  string(REGEX REPLACE "[.].*" "" folder "${name}")
  math(EXPR third "${number} % 3")
  math(EXPR number "${number} + 1")
  set(labels "${folder};slow;slow_${third}")
  if("|${sanitized_full}|" MATCHES "[|;]${name}[|;]")
    list(APPEND labels sanitized_full)
  endif()
  set_tests_properties("${name}" PROPERTIES LABELS "${labels}")
endforeach()
# Left out of every build under a sanitizer or with counters, where this test would take an hour and more.
set_tests_properties(regression.LargeMesh.TheCircleInATorusOfFiveMillionTriangles PROPERTIES
  LABELS "regression;full;release_only")
