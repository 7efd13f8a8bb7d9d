// Strokes along the principal directions of the boundary, as in --picture --strokes: a long one along that of kappa 1
// and a short one along that of kappa 2, in the tangent plane, each within a margin of white that shows it on every
// colour.
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh} from 'three';

import {kOpaque, kOrder, material, placed} from './kernels.js';
import common from './shaders/common.glsl';
import spokeFragment from './shaders/spoke.frag.glsl';
import strokeVertex from './shaders/stroke.vert.glsl';

// In radii of the shape, as in --picture.
const kSpacing = 0.055, kLong = 0.046, kShort = 0.022, kWidth = 0.005, kMargin = 0.0025;
// How far they lie before the surface: it bends away below them.
const kMarginLift = 0.004, kInkLift = 0.005;

export const kStrokesNote = 'strokes: long along kappa 1, short along kappa 2';

/** Of places, those that are at least a spacing from all that were taken before. */
class Spaced {
  constructor(spacing) {
    this.spacing = spacing;
    this.ofCell = new Map();
  }

  take(at) {
    const cell = at.map((x) => Math.floor(x / this.spacing));
    for (let i = 0; i < 27; ++i) {
      const key = [cell[0] + i % 3 - 1, cell[1] + Math.floor(i / 3) % 3 - 1, cell[2] + Math.floor(i / 9) - 1].join();
      const isNear = (other) => Math.hypot(...other.map((x, k) => x - at[k])) < this.spacing;
      if (this.ofCell.get(key)?.some(isNear)) return false;
    }
    const key = cell.join();
    if (!this.ofCell.has(key)) this.ofCell.set(key, []);
    this.ofCell.get(key).push(at);
    return true;
  }
}

/** The direction within the tangent plane, of length 1; null if it is not known. */
function tangent(directions, vertex, normal) {
  const direction = [0, 1, 2].map((k) => directions[3 * vertex + k] / 32767);
  const along = direction.reduce((sum, x, k) => sum + x * normal[k], 0);
  const flat = direction.map((x, k) => x - along * normal[k]);
  const size = Math.hypot(...flat);
  return size > 0.1 ? flat.map((x) => x / size) : null;
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Two triangles around `middle`, lifted along the normal. */
function addRectangle(positions, middle, normal, direction, {length, width, lift}) {
  const side = cross(normal, direction);
  const corner = (along, across) => middle.map((x, k) =>
    x + lift * normal[k] + 0.5 * (along * length * direction[k] + across * width * side[k]));
  const [a, b, c, d] = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  positions.push(...a, ...b, ...c, ...a, ...c, ...d);
}

/** Positions of triangles of strokes and of their margins. `surface`: the geometry of the mesh, by corner. */
export function strokeTriangles({triangles, boundary}, surface, radius) {
  const places = surface.getAttribute('position').array, normals = surface.getAttribute('normal').array;
  const spaced = new Spaced(kSpacing * radius), ink = [], margin = [];
  for (let corner = 0; corner < triangles.length; ++corner) {
    const normal = [0, 1, 2].map((k) => normals[4 * corner + k] / 127);
    const [along, across] = boundary.directions.map((each) => tangent(each, triangles[corner], normal));
    if (!along && !across) continue;
    const at = Array.from(places.subarray(3 * corner, 3 * corner + 3));
    if (!spaced.take(at)) continue;
    for (const [direction, length] of [[along, kLong], [across, kShort]]) {
      if (!direction) continue;
      addRectangle(ink, at, normal, direction, {length: length * radius, width: kWidth * radius, lift: kInkLift * radius});
      addRectangle(margin, at, normal, direction, {length: (length + 2 * kMargin) * radius,
        width: (kWidth + 2 * kMargin) * radius, lift: kMarginLift * radius});
    }
  }
  return {ink, margin};
}

/** One object, hidden at first. */
export function makeStrokes(scene, surface, uniforms, radius) {
  const {ink, margin} = strokeTriangles(scene, surface, radius);
  const geometry = new BufferGeometry(), isInk = new Uint8Array((ink.length + margin.length) / 3);
  isInk.fill(255, margin.length / 3);
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([...margin, ...ink]), 3));
  geometry.setAttribute('inked', new BufferAttribute(isInk, 1, true));
  const object = new Mesh(geometry, material(common + strokeVertex, common + spokeFragment, uniforms,
    {...kOpaque, side: DoubleSide}));
  object.visible = false;
  return placed(object, kOrder.crease);
}
