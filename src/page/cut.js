// The plane that cuts the picture: its controls, and the plane that they choose.
import {byId} from './page_parts.js';

/** Applies the controls. `scene`: the box of the page; `length`: a length as text. */
export function refreshCut({lower, upper, origin, scale}, length, viewer) {
  const axis = Number(byId('cut-axis').value);
  const share = byId('cut-offset').value / 1000;
  const place = lower[axis] + share * (upper[axis] - lower[axis]);
  const flipped = byId('cut-flip').checked;
  byId('cut-offset-value').textContent = `${'xyz'[axis]} ${flipped ? '≥' : '≤'} ${length(place)}`;
  for (const id of ['cut-axis', 'cut-flip', 'cut-offset']) byId(id).disabled = !byId('cut').checked;
  if (!byId('cut').checked) {
    viewer.setPlane([0, 0, 0, 1]);
    return;
  }
  const sign = flipped ? 1 : -1;
  const plane = [0, 0, 0, -sign * (place - origin[axis]) / scale];
  plane[axis] = sign;
  viewer.setPlane(plane);
}
