// The order in which balls are drawn when only some of them are: any number from the front covers the solid as well as
// possible.

/** Points in cells of a grid, found by position. */
class Cells {
  constructor(centres, side) {
    this.centres = centres;
    this.side = side;
    this.cells = new Map();
    for (let i = 0; i < centres.length / 3; ++i) {
      const key = this.key(...[0, 1, 2].map((k) => Math.floor(centres[3 * i + k] / side)));
      const cell = this.cells.get(key);
      if (cell) cell.push(i); else this.cells.set(key, [i]);
    }
  }

  key(x, y, z) { return (x * 4096 + y) * 4096 + z; }  // The model has size 1: fewer cells than that along each side.

  /** Calls `found` with every point closer than `radius` to point i. */
  around(i, radius, found) {
    const {centres, side} = this;
    const x = centres[3 * i], y = centres[3 * i + 1], z = centres[3 * i + 2];
    const from = [x, y, z].map((c) => Math.floor((c - radius) / side));
    const to = [x, y, z].map((c) => Math.floor((c + radius) / side));
    for (let a = from[0]; a <= to[0]; ++a) {
      for (let b = from[1]; b <= to[1]; ++b) {
        for (let c = from[2]; c <= to[2]; ++c) {
          for (const j of this.cells.get(this.key(a, b, c)) ?? []) {
            const square = (centres[3 * j] - x) ** 2 + (centres[3 * j + 1] - y) ** 2 + (centres[3 * j + 2] - z) ** 2;
            if (square < radius * radius) found(j);
          }
        }
      }
    }
  }
}

/** Largest first, without those whose centre lies well inside an earlier one; then again with a smaller margin for
 * "well inside"; then the rest. */
export function coverOrder(centres, radii, voxelSize) {
  const count = radii.length;
  const bySize = new Uint32Array(count).map((_, i) => i).sort((i, j) => radii[j] - radii[i] || i - j);
  const cells = new Cells(centres, Math.max(4 * voxelSize, 1 / 1024));
  const order = new Uint32Array(count);
  const taken = new Uint8Array(count);
  let used = 0;
  for (const share of [0.8, 0.4, 0.2, 0.1]) {
    const covered = new Uint8Array(count);
    const cover = (i) => cells.around(i, share * radii[i], (j) => { covered[j] = 1; });
    for (let k = 0; k < used; ++k) cover(order[k]);
    for (const i of bySize) {
      if (taken[i] || covered[i]) continue;
      taken[i] = 1;
      order[used++] = i;
      cover(i);
    }
  }
  for (const i of bySize) if (!taken[i]) order[used++] = i;
  return order;
}
