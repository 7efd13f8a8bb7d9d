// The faces of the surface, the roadmap and the path.
import {BufferAttribute, BufferGeometry, DoubleSide, LineSegments, Mesh, Vector3} from 'three';

import {kOpaque, kOrder, kOver, material, placed} from '../kernels.js';
import common from '../shaders/common.glsl';
import faceFragment from '../shaders/face.frag.glsl';
import faceVertex from '../shaders/face.vert.glsl';
import flatFragment from '../shaders/flat.frag.glsl';
import linkVertex from '../shaders/link.vert.glsl';
import screen from '../shaders/screen.glsl';
import spokeFragment from '../shaders/spoke.frag.glsl';
import wideLineVertex from '../shaders/wide_line.vert.glsl';
import {surfaceGeometry} from '../surface.js';

const kPathColour = [0.85, 0.1, 0.1];
const kPathWidth = 3;  // Half of it, in pixels.

export class FaceLayer {
  /** `surface`: points and triangles. */
  constructor(surface, uniforms) {
    this.triangles = surface.triangles;
    this.opacity = {value: 1};
    const geometry = surfaceGeometry({...surface, boundary: true});
    this.paints = geometry.getAttribute('paint');
    this.object = placed(new Mesh(geometry, material(common + faceVertex, common + screen + faceFragment,
      {...uniforms, surfaceOpacity: this.opacity}, {...kOpaque, side: DoubleSide})), kOrder.content);
  }

  /** `colourOf(triangle, point)`: red, green and blue from 0 to 255; null: the triangle is not drawn. */
  paint(colourOf) {
    const {array} = this.paints;
    array.fill(0);
    for (let corner = 0; corner < this.triangles.length; ++corner) {
      const colour = colourOf(Math.floor(corner / 3), this.triangles[corner]);
      if (!colour) continue;
      array.set(colour, 4 * corner);
      array[4 * corner + 3] = 255;
    }
    this.paints.needsUpdate = true;
  }
}

/** `colourOf(link)`: red, green and blue from 0 to 255. */
export function linkLines({ends}, points, colourOf, uniforms) {
  const positions = new Float32Array(3 * ends.length), paint = new Uint8Array(4 * ends.length);
  for (let i = 0; i < ends.length; ++i) {
    positions.set(points.subarray(3 * ends[i], 3 * ends[i] + 3), 3 * i);
    paint.set(colourOf(i >> 1), 4 * i);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('paint', new BufferAttribute(paint, 4, true));
  return placed(new LineSegments(geometry, material(common + linkVertex, common + spokeFragment, uniforms, kOpaque)),
    kOrder.content);
}

/** Seen through everything, since it is what was asked for. */
export function pathLine(line, uniforms) {
  const count = Math.max(line.length / 3 - 1, 0);
  const from = new Float32Array(18 * count), to = new Float32Array(18 * count);
  for (let i = 0; i < count; ++i) {
    for (let corner = 0; corner < 6; ++corner) {
      from.set(line.subarray(3 * i, 3 * i + 3), 18 * i + 3 * corner);
      to.set(line.subarray(3 * i + 3, 3 * i + 6), 18 * i + 3 * corner);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('from', new BufferAttribute(from, 3));
  geometry.setAttribute('to', new BufferAttribute(to, 3));
  geometry.setDrawRange(0, 6 * count);
  const own = {...uniforms, width: {value: kPathWidth}, colour: {value: new Vector3(...kPathColour)}};
  return placed(new Mesh(geometry, material(common + wideLineVertex, common + flatFragment, own,
    {...kOver, depthTest: false, side: DoubleSide, defines: {SEVERAL: ''}})), kOrder.picked);
}
