// The surface of the mesh for drawing: normals that are smooth except at creases, and the creases as lines.
import {BufferAttribute, BufferGeometry} from 'three';

const kCreaseCosine = 0.80;  // Facets that turn by more (37 degrees) meet in a crease; the same as in --picture.

/** Unit normals of the triangles, and twice their areas. */
function faceNormals(vertices, triangles) {
  const count = triangles.length / 3;
  const normals = new Float32Array(3 * count);
  const areas = new Float32Array(count);
  for (let t = 0; t < count; ++t) {
    const a = 3 * triangles[3 * t], b = 3 * triangles[3 * t + 1], c = 3 * triangles[3 * t + 2];
    const ux = vertices[b] - vertices[a], uy = vertices[b + 1] - vertices[a + 1], uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a], vy = vertices[c + 1] - vertices[a + 1], vz = vertices[c + 2] - vertices[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const area = Math.hypot(x, y, z);
    const inverse = area > 0 ? 1 / area : 0;
    normals.set([x * inverse, y * inverse, z * inverse], 3 * t);
    areas[t] = area;
  }
  return {normals, areas};
}

/** The triangles of each vertex: those of v are list[start[v]] to list[start[v + 1] - 1]. */
function trianglesOfVertices(vertexCount, triangles) {
  const start = new Uint32Array(vertexCount + 1);
  for (const v of triangles) ++start[v + 1];
  for (let v = 0; v < vertexCount; ++v) start[v + 1] += start[v];
  const next = start.slice();
  const list = new Uint32Array(triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) list[next[triangles[corner]]++] = Math.floor(corner / 3);
  return {start, list};
}

/** Positions and normals of all corners, three to a triangle: the normal of a corner is the mean, weighted by area, of
 * the triangles at its vertex that do not turn away by a crease. */
function cornerGeometry(vertices, triangles) {
  const {normals, areas} = faceNormals(vertices, triangles);
  const {start, list} = trianglesOfVertices(vertices.length / 3, triangles);
  const positions = new Float32Array(3 * triangles.length);
  const corners = new Int8Array(4 * triangles.length);  // Normals; four bytes each, the alignment that devices prefer.
  for (let corner = 0; corner < triangles.length; ++corner) {
    const v = triangles[corner];
    const own = 3 * Math.floor(corner / 3);
    const nx = normals[own], ny = normals[own + 1], nz = normals[own + 2];
    let x = 0, y = 0, z = 0;
    for (let i = start[v]; i < start[v + 1]; ++i) {
      const t = list[i];
      const mx = normals[3 * t], my = normals[3 * t + 1], mz = normals[3 * t + 2];
      if (nx * mx + ny * my + nz * mz < kCreaseCosine) continue;
      x += areas[t] * mx;
      y += areas[t] * my;
      z += areas[t] * mz;
    }
    const size = Math.hypot(x, y, z) || 1;
    corners[4 * corner] = Math.round(127 * x / size);
    corners[4 * corner + 1] = Math.round(127 * y / size);
    corners[4 * corner + 2] = Math.round(127 * z / size);
    for (let i = 0; i < 3; ++i) positions[3 * corner + i] = vertices[3 * v + i];
  }
  return {positions, normals: corners};
}

/** Calls `visit` with each edge: its ends, and its corners, from which a triangle leaves along it. */
function forEdges(vertexCount, triangles, visit) {
  // An edge as one number, independent of its direction; after sorting, the triangles of an edge are consecutive.
  const edges = new Float64Array(triangles.length);
  const order = new Uint32Array(triangles.length);
  for (let corner = 0; corner < triangles.length; ++corner) {
    const a = triangles[corner], b = triangles[nextCorner(corner)];
    edges[corner] = Math.min(a, b) * vertexCount + Math.max(a, b);
    order[corner] = corner;
  }
  order.sort((i, j) => edges[i] - edges[j]);
  for (let i = 0; i < order.length;) {
    let end = i + 1;
    while (end < order.length && edges[order[end]] === edges[order[i]]) ++end;
    visit(Math.floor(edges[order[i]] / vertexCount), edges[order[i]] % vertexCount, order.subarray(i, end));
    i = end;
  }
}

/** The next corner of the same triangle. */
export const nextCorner = (corner) => (corner % 3 === 2 ? corner - 2 : corner + 1);

/** Calls `crease` with both ends of every edge where the surface bends sharply, ends or branches, and `smooth` with both
 * corners of every other edge. */
export function divideEdges(vertices, triangles, crease, smooth = () => {}) {
  const {normals} = faceNormals(vertices, triangles);
  const bends = (i, j) => {
    const s = 3 * Math.floor(i / 3), t = 3 * Math.floor(j / 3);
    return normals[s] * normals[t] + normals[s + 1] * normals[t + 1] + normals[s + 2] * normals[t + 2] < kCreaseCosine;
  };
  forEdges(vertices.length / 3, triangles, (a, b, corners) => {
    if (corners.length !== 2 || bends(...corners)) crease(a, b); else smooth(...corners);
  });
}

/** Both ends of every edge where the surface bends sharply, ends or branches. */
function creaseLines(vertices, triangles) {
  const lines = [];
  divideEdges(vertices, triangles, (a, b) => {
    for (let k = 0; k < 3; ++k) lines.push(vertices[3 * a + k]);
    for (let k = 0; k < 3; ++k) lines.push(vertices[3 * b + k]);
  });
  return new Float32Array(lines);
}

/** For MeshLayer; with colours that change (MeshLayer.paint()) if there is a `boundary`. */
export function surfaceGeometry({vertices, triangles, boundary}) {
  const {positions, normals} = cornerGeometry(vertices, triangles);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 4, true));
  if (boundary) geometry.setAttribute('paint', new BufferAttribute(new Uint8Array(4 * triangles.length), 4, true));
  return geometry;
}

/** For MeshLayer.addCreases(). */
export function creaseGeometry({vertices, triangles}) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(creaseLines(vertices, triangles), 3));
  return geometry;
}
