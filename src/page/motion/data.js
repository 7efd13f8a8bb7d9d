// The motion that medial-vk has written into the page.
import {block, json} from '../data.js';

/** The frames that FrameCoder (src/output/motion_page/motion_geometry.h) has written, each of `size` numbers. */
export function decodeFrames(bytes, frames, size) {
  const numbers = new Uint16Array(frames * size);
  let at = 0;
  for (let frame = 0; frame < frames; ++frame) {
    const from = bytes[at++];
    const begin = frame * size;
    for (let i = begin; i < begin + size; ++i) {
      if (from === 0) {
        numbers[i] = bytes[at] | bytes[at + 1] << 8;
        at += 2;
        continue;
      }
      let rest = 0, shift = 0;
      while (bytes[at] >= 128) {
        rest |= (bytes[at++] & 127) << shift;
        shift += 7;
      }
      rest |= bytes[at++] << shift;
      const before = numbers[i - size];
      const prediction = from === 1 ? before : 2 * before - numbers[i - 2 * size];
      numbers[i] = prediction + (rest & 1 ? -1 - (rest >> 1) : rest >> 1);
    }
  }
  return numbers;
}

/** The numbers of the frames without their geometry. */
export const readMotion = () => json('motion');

/** Of the frames `motion.shown`, in this order; lengths and positions are in the units of the page. */
export function readGeometry(motion) {
  return {
    triangles: block('triangles', Uint32Array),
    places: decodeFrames(block('vertices', Uint8Array), motion.shown.length, 3 * motion.vertices),
    balls: block('balls', Float32Array),
    states: block('states', Uint8Array),
  };
}
