// Clusters in a uniform texel buffer: loads with per-lane addresses become gathers. The number of clusters
// (DeviceMesh::kMostClusters) is small enough for every device to allow the view.
// Before including, define CLUSTER_TEXEL_BINDING.
#ifndef MEDIAL_VK_CLUSTER_TEXELS_GLSL
#define MEDIAL_VK_CLUSTER_TEXELS_GLSL

layout(set = 0, binding = CLUSTER_TEXEL_BINDING) uniform samplerBuffer cluster_texels;

// The vec4 of a Cluster.
const uint kClusterLower = 0u, kClusterUpper = 1u, kClusterCentre = 2u, kClusterAxis = 3u, kClusterPoint = 4u,
           kClusterRest = 5u;
const uint kTexelsPerCluster = 6u;

vec4 cluster_texel(uint cluster, uint which) {
  return texelFetch(cluster_texels, int(kTexelsPerCluster * cluster + which));
}

#endif
