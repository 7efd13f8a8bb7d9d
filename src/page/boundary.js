// What the run measured on the boundary: colours of the mesh with their legends, and numbers of its vertices.
import {block} from './data.js';
import {brief} from './format.js';

/** Null if nothing was measured. `described`: the colours, with their legends, the fields, by name, and the fields of
 * principal directions, both or none. */
export function readBoundary(described) {
  if (!described) return null;
  return {
    colours: described.colours.map((colour) => ({...colour, ofVertices: block(`colour-${colour.name}`, Uint8Array)})),
    fields: Object.fromEntries(described.fields.map((name) => [name, block(`field-${name}`, Float32Array)])),
    states: described.states,
    kinds: described.kinds,
    directions: described.directions.map((name) => block(`field-${name}`, Int16Array)),
  };
}

/** The colours of all corners, four bytes each. */
export function cornerColours(ofVertices, triangles, colours) {
  for (let corner = 0; corner < triangles.length; ++corner) {
    for (let k = 0; k < 3; ++k) colours[4 * corner + k] = ofVertices[3 * triangles[corner] + k];
  }
}

const number = (x) => (Number.isNaN(x) ? 'unknown' : brief(x));

/** Names and values of a vertex for the panel. */
export function vertexValues({fields, states, kinds}, v) {
  const rows = [['vertex', String(v)]];
  if (fields.thickness_lower) {
    rows.push(['thickness', `${number(fields.thickness_lower[v])} to ${number(fields.thickness_upper[v])}`]);
    rows.push(['kind', kinds[fields.thickness_kind[v]]], ['object angle', `${fields.object_angle[v].toFixed(3)} rad`]);
  }
  if (fields.kappa_1) {
    rows.push(['kappa 1', number(fields.kappa_1[v])], ['kappa 2', number(fields.kappa_2[v])],
      ['error', number(fields.curvature_error[v])], ['state', states[fields.curvature_state[v]]],
      ['sheet', fields.sheet[v] < 0 ? 'none' : String(fields.sheet[v])]);
  }
  return rows;
}

/** The nearest vertex of the first triangle that a ray meets on the kept side of the plane; -1: none. `ray`: origin and
 * direction in the units of the page. All triangles are tested: a million take some ten milliseconds. */
export function vertexOnRay({vertices, triangles}, {origin: o, direction: d}, plane) {
  let nearest = Infinity, hit = -1;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = vertices[b] - vertices[a], uy = vertices[b + 1] - vertices[a + 1], uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a], vy = vertices[c + 1] - vertices[a + 1], vz = vertices[c + 2] - vertices[a + 2];
    const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const x = o[0] - vertices[a], y = o[1] - vertices[a + 1], z = o[2] - vertices[a + 2];
    const first = (x * px + y * py + z * pz) / determinant;
    if (first < 0 || first > 1) continue;
    const qx = y * uz - z * uy, qy = z * ux - x * uz, qz = x * uy - y * ux;
    const second = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
    if (second < 0 || first + second > 1) continue;
    const along = (vx * qx + vy * qy + vz * qz) / determinant;
    if (along <= 0 || along >= nearest) continue;
    const at = o.map((start, k) => start + along * d[k]);
    if (plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3] < 0) continue;
    nearest = along;
    const weights = [1 - first - second, first, second];
    hit = triangles[t + weights.indexOf(Math.max(...weights))];
  }
  return hit;
}
