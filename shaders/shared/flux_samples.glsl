// What the kernels around the flux through the spheres of found voxels share. Include "step.glsl" before.
#ifndef MEDIAL_VK_FLUX_SAMPLES_GLSL
#define MEDIAL_VK_FLUX_SAMPLES_GLSL

const float kSameDirection = 1.0 - 1e-6;  // cosine; directions are good to about 1e-4

vec3 voxel_centre(FoundPoint p) { return (vec3(p.voxel_x, p.voxel_y, p.voxel_z) + 0.5) * step.voxel_size; }

#endif
