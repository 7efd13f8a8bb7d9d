// The canvas of the page of a surface between sites.
import {kThemes, sheetTexel, viridis} from '../colours.js';
import {commonUniforms, MeshLayer} from '../kernels.js';
import {PickedLayer} from '../layers.js';
import {hitOnRay} from '../ray.js';
import {creaseGeometry, surfaceGeometry} from '../surface.js';
import {View} from '../view.js';
import {kNoSite, kSitesOfPoint} from './data.js';
import {FaceLayer, linkLines, pathLine} from './layers.js';

const kSpokeWidth = 3;  // Half of it, in pixels.

export function rangeOf(numbers) {
  let least = Infinity, greatest = -Infinity;
  for (const x of numbers) {
    if (x < least) least = x;
    if (x > greatest) greatest = x;
  }
  return numbers.length ? [least, greatest] : [0, 0];
}

const shareIn = ([least, greatest], x) => (greatest > least ? (x - least) / (greatest - least) : 0.5);

export class SurfaceViewer extends View {
  /** `numbers` and `geometry`: of data.js. */
  constructor(canvas, context, numbers, geometry) {
    const half = [0, 1, 2].map((k) => (numbers.upper[k] - numbers.lower[k]) / 2 / numbers.scale);
    // All of the surface is in the first view, and all of the sites.
    const {vertices} = geometry.surface, sites = geometry.shapes.vertices;
    const seen = new Float32Array(vertices.length + sites.length);
    seen.set(vertices);
    seen.set(sites, vertices.length);
    super(canvas, context, {...commonUniforms(), colourMap: {value: null}, width: {value: kSpokeWidth}}, {vertices: seen, half});
    this.numbers = numbers;
    this.geometry = geometry;
    this.distanceRange = rangeOf(geometry.distances);
    this.sites = new MeshLayer(surfaceGeometry(geometry.shapes), this.uniforms);
    this.sites.addCreases(creaseGeometry(geometry.shapes));
    this.faces = new FaceLayer(geometry.surface, this.uniforms);
    this.picked = new PickedLayer(this.uniforms);
    this.layers = {sites: this.sites.objects, surface: [this.faces.object], roadmap: [], path: []};
    if (geometry.links) {
      const {widths} = geometry.links;
      this.widthRange = rangeOf(widths);
      this.layers.roadmap = [linkLines(geometry.links, vertices, (i) => viridis(shareIn(this.widthRange, widths[i])), this.uniforms)];
    }
    if (geometry.path) this.layers.path = [pathLine(geometry.path, this.uniforms)];
    this.model.add(...Object.values(this.layers).flat(), ...this.picked.objects);
    this.shownPairs = numbers.pairs.map(() => true);
    this.colourBy = 'pair';
  }

  setTheme(name) {
    for (const part of ['picked', 'spokeA', 'spokeB']) this.picked.colours[part].set(...kThemes[name][part]);
    super.setTheme(name);
  }

  showLayer(name, visible) {
    for (const object of this.layers[name]) object.visible = visible;
    this.draw();
  }

  setSurfaceOpacity(share) {
    this.faces.opacity.value = share;
    this.draw();
  }

  /** `by`: "pair" or "distance". `shownPairs`: by pair. */
  paint(by, shownPairs) {
    this.colourBy = by;
    this.shownPairs = shownPairs;
    const {distances, pairOfTriangle} = this.geometry;
    this.faces.paint((triangle, point) => {
      const pair = pairOfTriangle[triangle];
      if (!shownPairs[pair]) return null;
      return by === 'pair' ? sheetTexel(pair) : viridis(shareIn(this.distanceRange, distances[point]));
    });
    this.draw();
  }

  /** The triangle and the point at a position of the canvas, in CSS pixels; null: none. */
  pickAt(x, y) {
    if (!this.faces.object.visible) return null;
    const {surface, pairOfTriangle} = this.geometry;
    return hitOnRay(surface, this.rayAt(x, y), this.plane, (triangle) => this.shownPairs[pairOfTriangle[triangle]]);
  }

  /** The sites of a point, each with the unit direction to its nearest point. */
  contactsOf(point) {
    const {sitesOfPoints, directions} = this.geometry;
    const contacts = [];
    for (let i = kSitesOfPoint * point; i < kSitesOfPoint * (point + 1); ++i) {
      if (sitesOfPoints[i] === kNoSite) break;
      contacts.push({site: sitesOfPoints[i], direction: [0, 1, 2].map((k) => directions[3 * i + k] / 32767)});
    }
    return contacts;
  }

  /** Shows the ball around a point that touches its first two sites, or those of `pair` if it touches both; -1: none. */
  highlight(point, pair = []) {
    if (point < 0) {
      this.picked.show(false);
    } else {
      const centre = Array.from(this.geometry.surface.vertices.subarray(3 * point, 3 * point + 3));
      const radius = this.geometry.distances[point];
      const contacts = this.contactsOf(point);
      const ofPair = contacts.filter(({site}) => pair.includes(site));
      const shown = ofPair.length === 2 ? ofPair : contacts.slice(0, 2);
      this.picked.set(centre, radius, shown.map(({direction}) => centre.map((c, k) => c + radius * direction[k])));
    }
    this.draw();
  }

  prepare(_atRest) { this.updatePlane(); }
}
