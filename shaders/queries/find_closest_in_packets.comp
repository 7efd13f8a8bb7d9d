#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The task of find_closest_points.comp for groups of points near each other: push.items groups (or the number in the
// counter) of push.items_multiplier queries each. A team handles up to kPerLane times its width of them.
#include "tree/tree_packet_main.glsl"
