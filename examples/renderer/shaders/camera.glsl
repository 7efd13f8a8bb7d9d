// The inputs of both pipelines for a frame (128 bytes at most).
layout(push_constant) uniform Push {
  mat4 to_clip;     // from the units of the mesh
  vec4 eye;         // in the same units
  vec4 placement;   // origin and scale of the job's unit box
};

vec3 shade(vec3 colour, vec3 normal, vec3 to_eye) {
  vec3 light = normalize(vec3(0.4, -0.6, 0.9));
  float sky = 0.5 + 0.5 * normal.z, sun = max(dot(normal, light), 0.0);
  float rim = pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0);
  return colour * (0.35 * sky + 0.65 * sun) + 0.15 * rim;
}
