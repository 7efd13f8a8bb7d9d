// Cutting of the cell of power_cell.glsl, which is included before.
#ifndef MEDIAL_VK_CLIP_POWER_CELL_GLSL
#define MEDIAL_VK_CLIP_POWER_CELL_GLSL

uvec2 cut_corners;  // one bit for each corner that the plane cuts

float find_height(vec4 by, uint c) {
  float height = dot(by.xyz, corner[c].xyz) - by.w;
  corner[c].w = height;
  if (height > kTie) cut_corners[c >> 5] |= 1u << (c & 31u);
  return height;
}

// Least and greatest height of a corner over the plane. Corners are taken four at a time, because iterations are
// counted.
vec2 find_heights(vec4 by) {
  vec2 range = vec2(3e38, -3e38);
  uint last = corner_count - 1u;
  cut_corners = uvec2(0u);
  for (uint c = 0u; c <= last; c += 4u) {
    float h0 = find_height(by, c), h1 = find_height(by, min(c + 1u, last));
    float h2 = find_height(by, min(c + 2u, last)), h3 = find_height(by, min(c + 3u, last));
    range = vec2(min(range.x, min(min(h0, h1), min(h2, h3))), max(range.y, max(max(h0, h1), max(h2, h3))));
    ++spent;
  }
  return range;
}

// Adds the intersection of the new plane with the edge between a kept and a cut corner; at the cut corner, the edge is
// opposite plane `slot`.
void add_corner(uint cut, uint kept, uint slot, uint name_of_plane) {
  if (corner_count == kMostCorners) {
    cell_failed = true;
    return;
  }
  float share = clamp(corner[kept].w / (corner[kept].w - corner[cut].w), 0.0, 1.0);
  precise vec3 along = corner[cut].xyz - corner[kept].xyz;
  precise vec3 position = corner[kept].xyz + share * along;
  uint generation = max(corner_planes[cut] >> 24, corner_planes[kept] >> 24) + 1u;
  generations = max(generations, generation);
  uint name = corner_count++;
  corner[name] = vec4(position, 0.0);
  corner_planes[name] = with_byte(with_byte(corner_planes[cut], slot, name_of_plane), 3u, generation);
  corner_links[name] = with_byte(0u, slot, kept);
  corner_links[kept] = with_name(corner_links[kept], cut, name);
}

void add_corners(uint name_of_plane) {
  uint old = corner_count;
  for (uvec2 left = cut_corners; (left.x | left.y) != 0u;) {
    uint c = left.x != 0u ? findLSB(left.x) : 32u + findLSB(left.y);
    left[c >> 5] &= ~(1u << (c & 31u));
    for (uint slot = 0u; slot < 3u; ++slot) {
      uint kept = byte_of(corner_links[c], slot);
      if (kept < old && corner[kept].w <= kTie) add_corner(c, kept, slot, name_of_plane);
    }
    spent += 4u;
  }
}

uint slot_of(uint c, uint p) {
  uint planes = corner_planes[c];
  return byte_of(planes, 0u) == p ? 0u : byte_of(planes, 1u) == p ? 1u : 2u;
}

// Links the corners around the new face: in each old face that it cuts, one new corner leaves and one arrives. A face
// that is cut twice shows that rounding has produced heights that no plane has.
void link_new_corners(uint first, uint name_of_plane) {
  uint stamp = cuts << 16;
  for (uint c = first; c < corner_count; ++c) {
    uint slot = slot_of(c, name_of_plane);
    uint next = byte_of(corner_planes[c], (slot + 1u) % 3u), after = byte_of(corner_planes[c], (slot + 2u) % 3u);
    uint edges = (plane_edges[next] & 0xffff0000u) == stamp ? plane_edges[next] : stamp | 0xffffu;
    cell_failed = cell_failed || (edges & 255u) != 255u;
    plane_edges[next] = with_byte(edges, 0u, c);
    edges = (plane_edges[after] & 0xffff0000u) == stamp ? plane_edges[after] : stamp | 0xffffu;
    cell_failed = cell_failed || (edges >> 8 & 255u) != 255u;
    plane_edges[after] = with_byte(edges, 1u, c);
  }
  for (uint c = first; c < corner_count; ++c) {
    uint slot = slot_of(c, name_of_plane), next = (slot + 1u) % 3u, after = (slot + 2u) % 3u;
    uint leaving = byte_of(plane_edges[byte_of(corner_planes[c], after)], 0u);
    uint arriving = byte_of(plane_edges[byte_of(corner_planes[c], next)], 1u);
    cell_failed = cell_failed || leaving == 255u || arriving == 255u;
    corner_links[c] = with_byte(with_byte(corner_links[c], next, leaving), after, arriving);
  }
  spent += 2u * (corner_count - first);
}

// Closes the gaps with the last corners, beginning with the last gap, so that the last corner is never a cut one.
void remove_cut_corners() {
  for (uvec2 left = cut_corners; (left.x | left.y) != 0u;) {
    uint gap = left.y != 0u ? 32u + findMSB(left.y) : findMSB(left.x);
    left[gap >> 5] &= ~(1u << (gap & 31u));
    ++spent;
    uint last = --corner_count;
    if (gap == last) continue;
    corner[gap] = corner[last];
    corner_planes[gap] = corner_planes[last];
    uint links = corner_links[last];
    corner_links[gap] = links;
    for (uint slot = 0u; slot < 3u; ++slot) {
      uint other = byte_of(links, slot);
      corner_links[other] = with_name(corner_links[other], last, gap);
    }
    spent += 3u;
  }
}

// `error`: bound of the displacement of the plane by rounding, within the ball.
void clip_cell(vec4 by, float error) {
  vec2 range = find_heights(by);
  if (range.y <= -error - kHeightRounding) return;
  plane_error = max(plane_error, error);
  if (range.y <= kTie) return;
  if (range.x > kTie) {
    cell_is_empty = true;
    beyond = range.x;
    return;
  }
  uint name_of_plane = take_plane(), old = corner_count;
  plane[name_of_plane] = by;
  ++cuts;
  add_corners(name_of_plane);
  if (!cell_failed) link_new_corners(old, name_of_plane);
  if (cell_failed) return;
  remove_cut_corners();
}

#endif
