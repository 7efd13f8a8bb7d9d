// Saturating sums of unsigned numbers, which stay at the largest number once they have reached it: a total that does
// not fit in 32 bits is above every limit.
#ifndef MEDIAL_VK_SCAN_GLSL
#define MEDIAL_VK_SCAN_GLSL
#include "gpu_types.h"

uvec4 add(uvec4 a, uvec4 b) { return a + min(b, ~a); }

#endif
