// The uncovered or added volume over the frames as a curve, with a cursor at the present frame.
import {byId} from '../page_parts.js';
import {brief} from '../format.js';

/** The least of 1, 2, 5, 10, 20 ... times a power of ten that is not below x. */
export function roundUp(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].map((factor) => factor * power).find((value) => value >= x * (1 - 1e-12));
}

/** Paths of a curve in a box of 1 x 1, y downwards, interrupted where a value is null: the line, and the area below. */
export function pathsOf(values, greatest) {
  const last = Math.max(values.length - 1, 1);
  const round = (x) => Number(x.toFixed(5));
  const at = (i) => `${round(i / last)} ${round(1 - values[i] / greatest)}`;
  let line = '', area = '';
  for (let i = 0; i < values.length;) {
    if (values[i] === null) {
      i += 1;
      continue;
    }
    let end = i + 1;
    while (end < values.length && values[end] !== null) ++end;
    const places = Array.from({length: end - i}, (_, k) => at(i + k)).join('L');
    // A single value is a short line, which the round ends make a dot.
    line += end - i > 1 ? `M${places}` : `M${places}h0`;
    area += `M${round(i / last)} 1L${places}L${round((end - 1) / last)} 1Z`;
    i = end;
  }
  return {line, area};
}

export class Curve {
  /** `name`: of the values, per cent, by frame, null where unknown. `onSeek(number)`: the frame at a place that was
   * chosen. */
  constructor(name, values, onSeek) {
    this.last = Math.max(values.length - 1, 1);
    const known = values.filter((value) => value !== null);
    byId('curve-box').hidden = byId('curve-labels').hidden = known.length === 0;
    if (known.length === 0) return;
    const greatest = roundUp(known.reduce((a, b) => Math.max(a, b)));
    const {line, area} = pathsOf(values, greatest);
    byId('curve-line').setAttribute('d', line);
    byId('curve-area').setAttribute('d', area);
    byId('curve-name').textContent = name;
    byId('curve-top').textContent = `${brief(greatest)} %`;
    const span = [known.reduce((a, b) => Math.min(a, b)), known.reduce((a, b) => Math.max(a, b))].map(brief);
    byId('curve').setAttribute('aria-label', `Volume ${name}, by frame: ${span[0]} to ${span[1]} per cent`);
    this.bind(onSeek);
  }

  bind(onSeek) {
    const box = byId('curve-box');
    const seek = (event) => {
      const {left, width} = box.getBoundingClientRect();
      onSeek(Math.round(Math.min(Math.max((event.clientX - left) / width, 0), 1) * this.last));
    };
    box.addEventListener('pointerdown', (event) => {
      box.setPointerCapture(event.pointerId);
      seek(event);
    });
    box.addEventListener('pointermove', (event) => { if (box.hasPointerCapture(event.pointerId)) seek(event); });
  }

  moveTo(frame) {
    byId('curve-cursor').style.left = `${100 * frame / this.last}%`;
  }
}
