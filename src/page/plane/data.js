// The shape and the axis that medial-vk has written into the page.
import {block, json} from '../data.js';

/** Numbers in rows of different lengths: `starts` has one more than there are rows. */
function rowsOf(counts) {
  const starts = new Uint32Array(counts.length + 1);
  counts.forEach((count, i) => { starts[i + 1] = starts[i] + count; });
  return starts;
}

export function readPlane() {
  const boundary = block('boundary', Float64Array), rings = rowsOf(block('rings', Uint32Array));
  const samples = block('samples', Float64Array), lines = rowsOf(block('lines', Uint32Array));
  return {...json('plane'), boundary, rings, samples, lines, nodes: block('nodes', Float64Array), path: block('path', Float64Array)};
}
