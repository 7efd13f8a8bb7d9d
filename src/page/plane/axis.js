// Questions about the axis: the nearest point of its polylines, and discs that overlap little.

export const kX = 0, kY = 1, kRadius = 2, kAngle = 3, kNumbers = 4;  // of a sample

/** The nearest point within `reach`, as {branch, index, x, y, radius, angle}, or null. */
export function nearestOnAxis({samples, lines}, x, y, reach) {
  let best = null, least = reach * reach;
  for (let branch = 0; branch + 1 < lines.length; ++branch) {
    for (let i = lines[branch]; i + 1 < lines[branch + 1]; ++i) {
      const a = kNumbers * i, b = a + kNumbers;
      const dx = samples[b] - samples[a], dy = samples[b + 1] - samples[a + 1];
      const square = dx * dx + dy * dy;
      const along = ((x - samples[a]) * dx + (y - samples[a + 1]) * dy) / square;
      const share = square > 0 ? Math.min(1, Math.max(0, along)) : 0;
      const ex = x - samples[a] - share * dx, ey = y - samples[a + 1] - share * dy;
      const distance = ex * ex + ey * ey;
      if (distance > least) continue;
      least = distance;
      best = {branch, index: i, share};
    }
  }
  return best && pointAt(samples, best);
}

function pointAt(samples, {branch, index, share}) {
  const value = (k) => {
    const a = samples[kNumbers * index + k], b = samples[kNumbers * (index + 1) + k];
    return a + share * (b - a);
  };
  return {branch, index, x: value(kX), y: value(kY), radius: value(kRadius), angle: value(kAngle)};
}

/** The sample of the greatest radius of a branch. */
export function widestOf({samples, lines}, branch) {
  let best = lines[branch];
  for (let i = best; i < lines[branch + 1]; ++i) {
    if (samples[kNumbers * i + kRadius] > samples[kNumbers * best + kRadius]) best = i;
  }
  const index = Math.min(best, lines[branch + 1] - 2);
  return pointAt(samples, {branch, index, share: best - index});
}

/** Samples whose discs overlap little, the largest first, at most `most` of them. */
export function fewDiscs({samples}, most) {
  const order = Array.from({length: samples.length / kNumbers}, (_, i) => i);
  order.sort((a, b) => samples[kNumbers * b + kRadius] - samples[kNumbers * a + kRadius]);
  const chosen = [];
  for (const i of order) {
    if (chosen.length === most) break;
    const [x, y, radius] = samples.subarray(kNumbers * i, kNumbers * i + 3);
    const overlaps = ([u, v, other]) => Math.hypot(x - u, y - v) < 0.75 * (radius + other);
    if (radius > 0 && !chosen.some(overlaps)) chosen.push([x, y, radius]);
  }
  return chosen;
}
