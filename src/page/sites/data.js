// The surface between sites that medial-vk has written into the page.
import {block, json} from '../data.js';

export const kNoSite = 0xffffffff;
export const kSitesOfPoint = 4;

/** The numbers of the surface without its geometry. */
export const readNumbers = () => json('surface');

/** Lengths and positions are in the units of the page: `origin` and `scale` lead back to those of the sites. */
export function readGeometry({has_roadmap: hasRoadmap, path}) {
  return {
    shapes: {vertices: block('vertices', Float32Array), triangles: block('triangles', Uint32Array)},
    surface: {vertices: block('points', Float32Array), triangles: block('faces', Uint32Array)},
    distances: block('distances', Float32Array),
    sitesOfPoints: block('sites-of-points', Uint32Array),
    directions: block('directions', Int16Array),
    pairOfTriangle: block('pairs-of-faces', Uint32Array),
    pieceOfTriangle: block('pieces-of-faces', Uint32Array),
    links: hasRoadmap ? {ends: block('links', Uint32Array), widths: block('widths', Float32Array)} : null,
    path: path ? block('path', Float32Array) : null,
  };
}
