// One point per finest voxel: of the lines that find a point at a level, the one with the largest turn, and of equal
// ones the first. The result does not depend on the order of the atomics. Include after declaring `winners`.
#ifndef MEDIAL_VK_ELECT_GLSL
#define MEDIAL_VK_ELECT_GLSL

void elect(uint line, uint voxel, float cosine_of_turn) {
  uint rank = uint(clamp(0.5 + 0.5 * cosine_of_turn, 0.0, 1.0) * 1023.0);
  atomicMin(winners[voxel], rank << kRankShift | line);
}

#endif
