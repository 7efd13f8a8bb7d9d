// The point or ball at a position of the screen: a ray is tested against all of them. A million take some milliseconds,
// so no buffer of indices has to be drawn and read back.

const kTolerance = 6;  // The distance beside a point, in pixels, that still counts.

/** `ray`: origin and unit direction; `plane`: the side where dot(plane, p) + plane[3] >= 0 is kept; all in the units of
 * the page. `ballCount`: balls drawn, from the front of `order`; `points`: whether points can be picked, and their
 * size; `unitsPerPixel`: at distance 1 from the origin. Returns the index of a point, or -1. */
export function pick(scene, {ray, plane, visible, order, ballCount, points, unitsPerPixel}) {
  const {origin: o, direction: d} = ray;
  const kept = (x, y, z) => plane[0] * x + plane[1] * y + plane[2] * z + plane[3] >= 0;
  let best = -1, nearest = Infinity;

  for (let k = 0; k < ballCount; ++k) {
    const i = order[k];
    if (!visible(i)) continue;
    const x = scene.centres[3 * i] - o[0], y = scene.centres[3 * i + 1] - o[1], z = scene.centres[3 * i + 2] - o[2];
    const along = x * d[0] + y * d[1] + z * d[2];
    const half = scene.radii[i] ** 2 - (x * x + y * y + z * z - along * along);
    if (half < 0) continue;
    let t = along - Math.sqrt(half);
    if (t <= 0) continue;
    const at = (s) => [o[0] + s * d[0], o[1] + s * d[1], o[2] + s * d[2]];
    if (!kept(...at(t))) {
      if (!kept(...at(along + Math.sqrt(half)))) continue;
      t = -(plane[0] * o[0] + plane[1] * o[1] + plane[2] * o[2] + plane[3]) /
        (plane[0] * d[0] + plane[1] * d[1] + plane[2] * d[2]);
    }
    if (t < nearest) [best, nearest] = [i, t];
  }
  if (!points) return best;

  let beside = -1, least = kTolerance;
  const ballDistance = nearest;
  for (let i = 0; i < scene.points; ++i) {
    if (!visible(i)) continue;
    const cx = scene.centres[3 * i], cy = scene.centres[3 * i + 1], cz = scene.centres[3 * i + 2];
    const x = cx - o[0], y = cy - o[1], z = cz - o[2];
    const along = x * d[0] + y * d[1] + z * d[2];
    if (along <= 0 || along >= ballDistance || !kept(cx, cy, cz)) continue;
    const distance = Math.sqrt(Math.max(x * x + y * y + z * z - along * along, 0));
    if (distance < points.radius && along < nearest) [best, nearest] = [i, along];
    const pixels = distance / (along * unitsPerPixel);
    if (pixels < least) [beside, least] = [i, pixels];
  }
  return best >= 0 ? best : beside;
}
