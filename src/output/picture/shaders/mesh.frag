#version 450
layout(location = 0) in vec3 seen_normal;
layout(location = 0) out vec4 wall;  // normal; w: 1 where a surface is present

void main() { wall = vec4(seen_normal * inversesqrt(max(dot(seen_normal, seen_normal), 1e-20)), 1.0); }
