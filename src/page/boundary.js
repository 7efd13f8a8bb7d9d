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
