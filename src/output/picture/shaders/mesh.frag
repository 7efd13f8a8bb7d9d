#version 450
layout(location = 0) in vec3 seen_normal;
layout(location = 0) out vec4 wall;  // normal; w: something is here

void main() { wall = vec4(seen_normal * inversesqrt(max(dot(seen_normal, seen_normal), 1e-20)), 1.0); }
