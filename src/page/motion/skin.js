// The surface of a mesh whose vertices move. Creases are those of the first frame: there each vertex is split into one
// corner for each smooth part of the surface around it, and the normals of the other frames follow from these corners.
import {BufferAttribute, BufferGeometry, DynamicDrawUsage} from 'three';

import {divideEdges, nextCorner} from '../surface.js';

/** Corners joined across smooth edges at the same vertex: for each corner of the triangles its number, and the vertex of
 * each number; and both numbers of every crease. */
function splitVertices(vertices, triangles) {
  const parent = new Uint32Array(triangles.length).map((_, i) => i);
  const rootOf = (i) => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const join = (i, j) => { parent[rootOf(i)] = rootOf(j); };
  const creases = [];
  divideEdges(vertices, triangles, (a, b) => creases.push(a, b), (i, j) => {
    // Neighbours traverse their edge in opposite directions, unless one of them is turned over.
    const k = nextCorner(i), l = nextCorner(j);
    if (triangles[i] === triangles[j]) {
      join(i, j);
      join(k, l);
    } else {
      join(i, l);
      join(k, j);
    }
  });
  const number = new Int32Array(triangles.length).fill(-1);
  const corners = new Uint32Array(triangles.length);
  const vertexOf = [], cornerOf = new Map();
  for (let i = 0; i < triangles.length; ++i) {
    const root = rootOf(i);
    if (number[root] < 0) {
      number[root] = vertexOf.length;
      cornerOf.set(triangles[i], vertexOf.length);
      vertexOf.push(triangles[i]);
    }
    corners[i] = number[root];
  }
  return {corners, vertexOf: Uint32Array.from(vertexOf), creases: Uint32Array.from(creases, (v) => cornerOf.get(v))};
}

export class Skin {
  /** `lower` and `step`: a coordinate in the units of the page is lower + step * place. `places`: of the first frame. */
  constructor({triangles, lower, step}, places) {
    this.lower = lower;
    this.step = step;
    const vertices = Float32Array.from(places, (place, i) => lower[i % 3] + step[i % 3] * place);
    const {corners, vertexOf, creases} = splitVertices(vertices, triangles);
    this.corners = corners;
    this.vertexOf = vertexOf;
    this.sums = new Float32Array(3 * vertexOf.length);
    const moving = (array, size, normalised) => new BufferAttribute(array, size, normalised).setUsage(DynamicDrawUsage);
    this.position = moving(new Float32Array(3 * vertexOf.length), 3, false);
    this.normal = moving(new Int8Array(4 * vertexOf.length), 4, true);
    this.surface = new BufferGeometry();
    this.surface.setAttribute('position', this.position);
    this.surface.setAttribute('normal', this.normal);
    this.surface.setIndex(new BufferAttribute(corners, 1));
    this.creases = new BufferGeometry();
    this.creases.setAttribute('position', this.position);
    this.creases.setIndex(new BufferAttribute(creases, 1));
    this.move(places);
  }

  /** `places`: of all vertices in another frame. */
  move(places) {
    const {vertexOf, lower, step} = this;
    const positions = this.position.array;
    for (let i = 0; i < vertexOf.length; ++i) {
      const v = 3 * vertexOf[i];
      positions[3 * i] = lower[0] + step[0] * places[v];
      positions[3 * i + 1] = lower[1] + step[1] * places[v + 1];
      positions[3 * i + 2] = lower[2] + step[2] * places[v + 2];
    }
    this.updateNormals();
    this.position.needsUpdate = true;
    this.normal.needsUpdate = true;
  }

  /** Means of the triangles at each corner, weighted by area. */
  updateNormals() {
    const {corners, sums} = this;
    const p = this.position.array, packed = this.normal.array;
    sums.fill(0);
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      sums[a] += x; sums[a + 1] += y; sums[a + 2] += z;
      sums[b] += x; sums[b + 1] += y; sums[b + 2] += z;
      sums[c] += x; sums[c + 1] += y; sums[c + 2] += z;
    }
    for (let i = 0; 3 * i < sums.length; ++i) {
      const x = sums[3 * i], y = sums[3 * i + 1], z = sums[3 * i + 2];
      const scale = 127 / (Math.sqrt(x * x + y * y + z * z) || 1);
      packed[4 * i] = Math.round(x * scale);
      packed[4 * i + 1] = Math.round(y * scale);
      packed[4 * i + 2] = Math.round(z * scale);
    }
  }
}
