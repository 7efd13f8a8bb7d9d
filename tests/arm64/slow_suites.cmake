# Suites of unit tests whose tests take more than a second of processor time together on amd64, starts of processes not
# counted: hours under qemu-user. scripts/test-arm64 leaves them out unless it is called with --slow.
set(MEDIAL_VK_SLOW_SUITES
  All/CoverInMotion All/FollowerInMotion All/SiteArrangements AnimationErrors AnyBoundary BalancedSpheres BallUnion
  BestMethod BodyPicture BoostVoronoi BothWays/OtherRoundingOfBodies BothWays/OtherRoundingOfFollowed
  BothWays/OtherRoundingTest BoundaryPicture BvhBuild ChooseBalls Collisions ContextTest CoverFollower CoverOfAnyFrame
  Crossings Curvature CurvatureInvariance CurvatureOfExposedTips CurvatureStates DispatchRowsTest Distance
  DistanceBounds DistanceCases DynamicUnion EnvelopeDistance ExactSide ExposedRegions Families/PublishedAxisTest
  Families/RegularTriangulationOf FitParts Foam Follower FollowerJob FollowerJobOfAnyFrame FrozenShadersTest
  IndexedMeshTest JoinComponents KnownAxes Lanes LeastDistance LeastWall MedialMesh MemoryTest MeshLinks MeshSides
  MotionPicture NearTriangles NearestBodies OtherSpecialsOfBodies OtherSpecialsOfFollowed OtherSpecialsTest
  OuterBoundary PacketQueriesTest PairPicture Penetration PictureDraw PictureOfAPlane PlanePicture PlaneRoadmaps
  Prepare ProgramsWatch PublishedAxis PublishedRule ReadBrokenFiles ReadLimits RecorderTest ReferenceCertificate
  ReferenceCommonCorner ReferenceDismissal ReferenceProgress RegionalGrowth Renewal ResumableBounds SceneTest
  SceneUpdate Seeds/ExactAxis SetsForDistances Sheets SiteInputs SiteRoadmaps Solids/LeastWallOf Solids/ThicknessOf
  SourceMethod SphereMeasures SpreadTest Stop StoppedDistances StoppedLeastDistances Thickness ThicknessKinds
  TreeCounts TwoProduct UnionMeasurer VertexCurvature WideTree WindingNumber WorkOrder)
list(TRANSFORM MEDIAL_VK_SLOW_SUITES APPEND ".*")
