#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// find_closest_points.comp for groups of points near each other: push.items groups (or as many as the counter says) of
// push.items_multiplier queries each. A team answers up to kPerLane times its width of them.
#include "tree/tree_packet_main.glsl"
