// The points at which the flux through the sphere around a found voxel is sampled, with the voxel's side as radius, and
// definitions that the kernels of the flux share. Include "step.glsl" before.
#ifndef MEDIAL_VK_FLUX_SAMPLES_GLSL
#define MEDIAL_VK_FLUX_SAMPLES_GLSL

const float kSameDirection = 1.0 - 1e-6;  // cosine; directions are accurate to about 1e-4

vec3 voxel_centre(FoundPoint p) { return (vec3(p.voxel_x, p.voxel_y, p.voxel_z) + 0.5) * step.voxel_size; }

// The source's spiral (its [102]) advances the azimuth by 3.6 / sqrt(N (1 - h^2)), a sum without a closed form; the
// golden angle, 0.381966 turns, spreads the points as evenly. The azimuth is reduced to half a turn to both sides, where
// GLSL's sine and cosine have an error of at most 2^-11; beyond that it is not bounded.
vec3 spiral_direction(uint k) {
  float h = float(k) * (2.0 / float(kFluxSamples)) + (1.0 / float(kFluxSamples) - 1.0);
  float azimuth = 6.2831853 * fract(float(k) * 0.381966 + 0.5) - 3.1415927;
  float r = sqrt(1.0 - h * h);
  return vec3(r * cos(azimuth), r * sin(azimuth), h);
}

// The centre of the voxel and its sample k.
vec3 sample_point(vec3 centre, uint k) { return centre + step.voxel_size * spiral_direction(k); }

// The samples form eight groups of six that lie together, within 42 degrees of their mean: the index of sample i of a
// group. Each group is encoded in bytes, since tables with an index per lane are slow on lavapipe.
const uvec2 kSampleOfGroup[kFluxGroup] = {
    uvec2(0x0d040200u, 0x2118170eu), uvec2(0x10090501u, 0x26201c13u), uvec2(0x150c0703u, 0x29251f16u),
    uvec2(0x1a110a06u, 0x2b28241bu), uvec2(0x1d140f08u, 0x2e2a271eu), uvec2(0x2219120bu, 0x2f2d2c23u)};
const uint kGroupsPerSphere = kFluxSamples / kFluxGroup;

uint sample_of_group(uint group, uint i) {
  uint four = group < 4u ? kSampleOfGroup[i].x : kSampleOfGroup[i].y;
  return four >> (8u * (group & 3u)) & 0xffu;
}

// The contacts that may be nearest to a sample: one mask of the list for each group, stored in the former masks of
// children.
uint sample_mask_begin(Cell cell, uint group) { return 8u * cell.word_begin + group * ((cell.list_count + 31u) / 32u); }

#endif
