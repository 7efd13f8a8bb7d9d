// Cutting the cell of power_cell.glsl, which is included before.
#ifndef MEDIAL_VK_CLIP_POWER_CELL_GLSL
#define MEDIAL_VK_CLIP_POWER_CELL_GLSL

// Least and greatest height of a corner over the plane.
vec2 find_heights(vec4 by) {
  vec2 range = vec2(3e38, -3e38);
  for (uint c = 0u; c < corner_count; ++c) {
    float height = dot(by.xyz, corner[c].xyz) - by.w;
    corner[c].w = height;
    range = vec2(min(range.x, height), max(range.y, height));
  }
  spent += corner_count;
  return range;
}

// Where the edge between a kept and a cut corner, at the latter opposite its plane `slot`, meets the new plane.
void add_corner(uint cut, uint kept, uint slot) {
  if (corner_count == kMostCorners) {
    cell_failed = true;
    return;
  }
  float share = clamp(corner[kept].w / (corner[kept].w - corner[cut].w), 0.0, 1.0);
  precise vec3 along = corner[cut].xyz - corner[kept].xyz;
  precise vec3 place = corner[kept].xyz + share * along;
  uint generation = max(corner_planes[cut] >> 24, corner_planes[kept] >> 24) + 1u;
  generations = max(generations, generation);
  uint name = corner_count++;
  corner[name] = vec4(place, 0.0);
  corner_planes[name] = with_byte(with_byte(corner_planes[cut], slot, plane_count), 3u, generation);
  corner_links[name] = with_byte(0u, slot, kept);
  corner_links[kept] = with_name(corner_links[kept], cut, name);
}

void add_corners() {
  uint old = corner_count;
  for (uint c = 0u; c < old; ++c) {
    if (corner[c].w <= kTie) continue;
    for (uint slot = 0u; slot < 3u; ++slot) {
      uint kept = byte_of(corner_links[c], slot);
      if (kept < old && corner[kept].w <= kTie) add_corner(c, kept, slot);
    }
    spent += 3u;
  }
  spent += old;
}

uint slot_of_cut(uint c) {
  uint planes = corner_planes[c];
  return byte_of(planes, 0u) == plane_count ? 0u : byte_of(planes, 1u) == plane_count ? 1u : 2u;
}

// Around the new face: in each old face that it cuts, one new corner leaves and one arrives. A face that is cut twice
// shows that rounding made heights that no plane has.
void link_new_corners(uint first) {
  for (uint c = first; c < corner_count; ++c) {
    uint slot = slot_of_cut(c);
    uint next = byte_of(corner_planes[c], (slot + 1u) % 3u), after = byte_of(corner_planes[c], (slot + 2u) % 3u);
    uint stamp = plane_count << 16;
    uint edges = (plane_edges[next] & 0xff0000u) == stamp ? plane_edges[next] : stamp | 0xffffu;
    cell_failed = cell_failed || (edges & 255u) != 255u;
    plane_edges[next] = with_byte(edges, 0u, c);
    edges = (plane_edges[after] & 0xff0000u) == stamp ? plane_edges[after] : stamp | 0xffffu;
    cell_failed = cell_failed || (edges >> 8 & 255u) != 255u;
    plane_edges[after] = with_byte(edges, 1u, c);
  }
  for (uint c = first; c < corner_count; ++c) {
    uint slot = slot_of_cut(c), next = (slot + 1u) % 3u, after = (slot + 2u) % 3u;
    uint leaving = byte_of(plane_edges[byte_of(corner_planes[c], after)], 0u);
    uint arriving = byte_of(plane_edges[byte_of(corner_planes[c], next)], 1u);
    cell_failed = cell_failed || leaving == 255u || arriving == 255u;
    corner_links[c] = with_byte(with_byte(corner_links[c], next, leaving), after, arriving);
  }
  spent += 2u * (corner_count - first);
}

// Closes the gaps with the last corners.
void remove_cut_corners(uint old) {
  spent += old;
  for (uint k = old; k > 0u; --k) {
    uint gap = k - 1u;
    if (corner[gap].w <= kTie) continue;
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

// `error`: how far rounding may have moved the plane within the ball.
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
  if (plane_count == kMostPlanes) {
    cell_failed = true;
    return;
  }
  plane[plane_count] = by;
  plane_edges[plane_count] = 0u;
  uint old = corner_count;
  add_corners();
  if (cell_failed) return;
  link_new_corners(old);
  if (cell_failed) return;
  ++plane_count;
  remove_cut_corners(old);
}

#endif
