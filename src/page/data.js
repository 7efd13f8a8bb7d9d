// The data that medial-vk has written into the page.
import {readBoundary} from './boundary.js';

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** The numbers of an element; the element is emptied, as its text takes more memory than the numbers. */
export function block(name, Type) {
  const element = document.getElementById(`data-${name}`);
  const bytes = bytesOf(element.textContent);
  element.remove();
  return new Type(bytes.buffer, bytes.byteOffset, bytes.byteLength / Type.BYTES_PER_ELEMENT);
}

export function json(name) {
  return JSON.parse(document.getElementById(name).textContent);
}

export const readReport = () => json('report');

/** Lengths and positions are in the units of the page: `origin` and `scale` lead back to the units of the mesh. */
export function readScene() {
  const scene = json('scene');
  return {
    ...scene,
    boundary: readBoundary(scene.boundary),
    vertices: block('vertices', Float32Array),
    triangles: block('triangles', Uint32Array),
    centres: block('centres', Float32Array),
    radii: block('radii', Float32Array),
    spokes: block('spokes', Int16Array),
    angles: block('angles', Float32Array),
    fluxes: block('fluxes', Float32Array),
    sheets: block('sheets', Int32Array),
    voxels: block('voxels', Uint16Array),
  };
}
