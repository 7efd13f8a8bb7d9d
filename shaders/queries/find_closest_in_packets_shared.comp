#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// find_closest_in_packets.comp for devices whose subgroups cannot shuffle.
#define PACKET_THROUGH_SHARED_MEMORY
#include "tree/tree_packet_main.glsl"
