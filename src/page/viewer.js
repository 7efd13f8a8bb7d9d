// The canvas of the page of a run: layers, cut, filter and picking.
import {Vector3} from 'three';

import {cornerColours} from './boundary.js';
import {kAttributes, kThemes} from './colours.js';
import {kCornersOfABall, MeshLayer} from './kernels.js';
import {makeUniforms, PickedLayer, PointLayers} from './layers.js';
import {pick} from './pick.js';
import {hitOnRay} from './ray.js';
import {makeStrokes} from './strokes.js';
import {creaseGeometry, surfaceGeometry} from './surface.js';
import {View} from './view.js';

export const kLayers = ['mesh', 'balls', 'points', 'spokes', 'sheets'];

// The time limit of the balls in milliseconds, so that the page stays responsive.
const kTurningTime = 40, kRestingTime = 700;
const kFirstPace = 3e4, kLeastPace = 3e3;  // Pixels of balls per millisecond: first of a slow device, then measured.

/** The mesh, and the points where some of them are outside of it. */
function inFirstView({vertices, centres, outside}) {
  if (!outside) return vertices;
  const all = new Float32Array(vertices.length + centres.length);
  all.set(vertices);
  all.set(centres, vertices.length);
  return all;
}

export class Viewer extends View {
  /** `context`: of WebGL 2, without antialiasing. */
  constructor(canvas, context, scene) {
    const half = [0, 1, 2].map((k) => (scene.upper[k] - scene.lower[k]) / 2 / scene.scale);
    const surface = surfaceGeometry(scene);
    super(canvas, context, makeUniforms(scene), {vertices: inFirstView(scene), half});
    this.scene = scene;
    this.mesh = new MeshLayer(surface, this.uniforms);
    this.makeStrokes = () => makeStrokes(scene, surface, this.uniforms, Math.hypot(...half));
    this.points = new PointLayers(scene, this.uniforms, this.renderer.capabilities.maxTextureSize);
    this.picked = new PickedLayer(this.uniforms);
    this.model.add(...this.mesh.objects, ...this.picked.objects);
    this.shown = {mesh: true, balls: false, points: false, spokes: false, sheets: false};
    this.hasStrokes = false;
    this.least = {angle: -Infinity, radius: -Infinity};
    this.range = [0, scene.points];  // Of the points that are shown: those inside of the mesh come first.
    this.ballCount = 0;
    this.drawnBalls = 0;  // The first of those, as many as the device can draw in time.
    this.pace = kFirstPace;
    this.otherTime = [0, 0];  // Milliseconds of a frame without balls, in motion and at rest.
  }

  showLayer(name, visible) {
    this.shown[name] = visible;
    if (name === 'mesh') {
      for (const object of this.mesh.objects) object.visible = visible;
      this.showStrokes(this.hasStrokes);
    } else if (visible || this.points.made[name]) {
      const object = this.points.get(name);
      if (!object.parent) this.model.add(object);
      object.visible = visible && this.scene.points > 0;
    }
    this.draw();
  }

  addCreases() {
    const lines = this.mesh.addCreases(creaseGeometry(this.scene));
    lines.visible = this.shown.mesh;
    this.model.add(lines);
    this.draw();
  }

  setTheme(name) {
    for (const part of ['picked', 'spokeA', 'spokeB']) this.picked.colours[part].set(...kThemes[name][part]);
    super.setTheme(name);
  }

  setColour(attribute, least, greatest) {
    this.uniforms.colourBy.value = kAttributes[attribute].component;
    this.uniforms.colourRange.value.set(least, greatest);
    this.draw();
  }

  /** The name of a colour of the boundary; null: the mesh is glass. */
  paintMesh(name) {
    const colour = this.scene.boundary?.colours.find((each) => each.name === name);
    this.isPainted = Boolean(colour);
    this.mesh.paint(colour ? (array) => cornerColours(colour.ofVertices, this.scene.triangles, array) : null);
    this.draw();
  }

  /** On the mesh, where that is shown; made when they are first shown. */
  showStrokes(visible) {
    this.hasStrokes = visible;
    if (visible && !this.strokes) this.model.add(this.strokes = this.makeStrokes());
    if (this.strokes) this.strokes.visible = visible && this.shown.mesh;
    this.draw();
  }

  setLeast(angle, radius) {
    this.least = {angle, radius};
    this.uniforms.leastAngleRadius.value.set(angle, radius);
    this.draw();
  }

  /** `side`: "inside", "outside" or "both". */
  setSide(side) {
    const {inside_points: inside, points} = this.scene;
    this.range = [side === 'outside' ? inside : 0, side === 'inside' ? inside : points];
    this.uniforms.shownPoints.value.set(...this.range);
    this.draw();
  }

  setBallCount(count) {
    this.ballCount = count;
    this.draw();
  }

  passesFilter(i) {
    const {angles, radii} = this.scene;
    return angles[i] >= this.least.angle && radii[i] >= this.least.radius && i >= this.range[0] && i < this.range[1];
  }

  centre(i) { return Array.from(this.scene.centres.subarray(3 * i, 3 * i + 3)); }

  isVisible(i) {
    const [x, y, z] = this.centre(i);
    const p = this.plane;
    return this.passesFilter(i) && p[0] * x + p[1] * y + p[2] * z + p[3] >= 0;
  }

  countVisible() {
    const {centres, angles, radii} = this.scene;
    const [x, y, z, w] = this.plane;
    let count = 0;
    for (let i = this.range[0]; i < this.range[1]; ++i) {
      const kept = x * centres[3 * i] + y * centres[3 * i + 1] + z * centres[3 * i + 2] + w >= 0;
      if (kept && angles[i] >= this.least.angle && radii[i] >= this.least.radius) ++count;
    }
    return count;
  }

  /** Shows point i as selected; -1: none. */
  highlight(i) {
    if (i < 0) {
      this.picked.show(false);
    } else {
      const centre = this.centre(i), radius = this.scene.radii[i];
      const tip = (from) => centre.map((c, k) => c + radius * this.scene.spokes[6 * i + from + k] / 32767);
      this.picked.set(centre, radius, [tip(0), tip(3)]);
    }
    this.draw();
  }

  /** The position of point i on the canvas, in CSS pixels. */
  project(i) {
    const place = this.model.localToWorld(new Vector3(...this.centre(i))).project(this.camera);
    const {clientWidth, clientHeight} = this.canvas;
    return [(place.x + 1) / 2 * clientWidth, (1 - place.y) / 2 * clientHeight];
  }

  /** The vertex at a position of the canvas, if the mesh is painted; -1: none. */
  vertexAt(x, y) {
    if (!this.isPainted || !this.shown.mesh) return -1;
    return hitOnRay(this.scene, this.rayAt(x, y), this.plane)?.vertex ?? -1;
  }

  /** The point or ball at a position of the canvas, in CSS pixels; -1: none. */
  pickAt(x, y) {
    const marks = this.shown.points || this.shown.sheets || this.shown.spokes;
    const radius = this.shown.sheets ? this.uniforms.discRadius.value : this.uniforms.pointRadius.value;
    return pick(this.scene, {
      ray: this.rayAt(x, y),
      plane: this.plane,
      visible: (i) => this.passesFilter(i),
      order: this.shown.balls ? this.points.order : [],
      ballCount: this.shown.balls ? this.drawnBalls : 0,
      points: marks ? {radius} : null,
      unitsPerPixel: this.unitsPerPixel,
    });
  }

  /** Pixels of the squares around the first balls, for a model at the distance of its middle. */
  pixelsOfBalls(count) {
    const scale = 2 * this.uniforms.pixelsPerUnit.value / Math.max(this.camera.position.length(), 0.3);
    return this.points.squares[count] * scale * scale;
  }

  /** The number of balls that can be drawn in the time; those left out are mostly hidden behind those drawn. */
  ballsWithin(milliseconds) {
    let least = Math.min(20, this.ballCount), most = this.ballCount;
    while (least < most) {
      const middle = Math.ceil((least + most) / 2);
      if (this.pixelsOfBalls(middle) <= this.pace * milliseconds) least = middle; else most = middle - 1;
    }
    return least;
  }

  /** Measures the speed of the device from a frame; at rest, more balls may follow. */
  learnPace(atRest) {
    const pixels = this.shown.balls ? this.pixelsOfBalls(this.drawnBalls) : 0, frame = this.frame;
    this.timeDevice((time) => {
      if (pixels === 0) {
        this.otherTime[Number(atRest)] = time;
        return;
      }
      // At least half of the time is attributed to the balls: other layers may have been shown when theirs was
      // measured.
      const pace = pixels / Math.max(time - Math.min(this.otherTime[Number(atRest)], time / 2), 1);
      this.pace = Math.min(Math.max(pace, kLeastPace), 8 * this.pace);
      const more = this.ballsWithin(kRestingTime) > 1.25 * this.drawnBalls;
      if (atRest && frame === this.frame && more) this.drawNow(true);
    });
  }

  prepare(atRest) {
    this.updatePlane();
    if (!this.shown.balls) return;
    this.drawnBalls = this.ballsWithin(atRest ? kRestingTime : kTurningTime);
    this.points.get('balls').geometry.setDrawRange(0, kCornersOfABall * this.drawnBalls);
  }

  drawn(atRest) {
    this.learnPace(atRest);
    if (atRest) this.onRest?.();
  }
}
