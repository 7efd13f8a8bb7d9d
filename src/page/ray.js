// What a ray through the picture meets.

/** The first triangle that a ray meets on the kept side of the plane, and its nearest vertex; null: none. `ray`: origin
 * and direction in the units of the page; `isShown(i)`: whether triangle i is. All triangles are tested: a million take
 * some ten milliseconds. */
export function hitOnRay({vertices, triangles}, {origin: o, direction: d}, plane, isShown = () => true) {
  let nearest = Infinity, hit = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = vertices[b] - vertices[a], uy = vertices[b + 1] - vertices[a + 1], uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a], vy = vertices[c + 1] - vertices[a + 1], vz = vertices[c + 2] - vertices[a + 2];
    const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const x = o[0] - vertices[a], y = o[1] - vertices[a + 1], z = o[2] - vertices[a + 2];
    const first = (x * px + y * py + z * pz) / determinant;
    if (first < 0 || first > 1) continue;
    const qx = y * uz - z * uy, qy = z * ux - x * uz, qz = x * uy - y * ux;
    const second = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
    if (second < 0 || first + second > 1) continue;
    const along = (vx * qx + vy * qy + vz * qz) / determinant;
    if (along <= 0 || along >= nearest || !isShown(t / 3)) continue;
    const at = o.map((start, k) => start + along * d[k]);
    if (plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3] < 0) continue;
    nearest = along;
    const weights = [1 - first - second, first, second];
    hit = {triangle: t / 3, vertex: triangles[t + weights.indexOf(Math.max(...weights))]};
  }
  return hit;
}
