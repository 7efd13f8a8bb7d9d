// The canvas: camera, layers, cut, filter and picking. Draws only when something has changed.
import {Group, MathUtils, Matrix4, PerspectiveCamera, Plane, Scene, Spherical, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

import {kAttributes, kThemes} from './colours.js';
import {kCornersOfABall, makeUniforms, MeshLayer, PickedLayer, PointLayers} from './layers.js';
import {pick} from './pick.js';

export const kLayers = ['mesh', 'balls', 'points', 'spokes', 'sheets'];

const kFieldOfView = 32;  // Degrees, of the shorter side.
const kFrom = new Vector3(0.62, 0.48, 1).normalize();  // From the right, above and the front, as --picture.
// Rotations that bring an axis up, about x, y and z: those of --picture (src/common/up_axis.h).
const kTurns = {
  y: [0, 0, 0], '-y': [Math.PI, 0, 0], z: [-Math.PI / 2, 0, 0], '-z': [Math.PI / 2, 0, 0], x: [0, 0, Math.PI / 2],
  '-x': [0, 0, -Math.PI / 2],
};
const kFilled = 0.88;  // The share of the picture that the model fills at first.
// The time limit of the balls in milliseconds, so that the page stays responsive.
const kTurningTime = 40, kRestingTime = 700;
const kFirstPace = 3e4, kLeastPace = 3e3;  // Pixels of balls per millisecond: first of a slow device, then measured.

export class Viewer {
  /** `context`: of WebGL 2, without antialiasing. */
  constructor(canvas, context, scene) {
    this.canvas = canvas;
    this.scene = scene;
    this.renderer = new WebGLRenderer({canvas, context});
    this.renderer.setClearColor(0, 0);
    this.renderer.outputColorSpace = 'srgb-linear';  // Colours are given as displayed.
    this.root = new Scene();
    this.model = new Group();
    this.root.add(this.model);
    this.uniforms = makeUniforms(scene);
    this.mesh = new MeshLayer(scene, this.uniforms);
    this.points = new PointLayers(scene, this.uniforms, this.renderer.capabilities.maxTextureSize);
    this.picked = new PickedLayer(this.uniforms);
    this.model.add(...this.mesh.objects, ...this.picked.objects);
    this.shown = {mesh: true, balls: false, points: false, spokes: false, sheets: false};
    this.plane = [0, 0, 0, 1];
    this.least = {angle: -Infinity, radius: -Infinity};
    this.ballCount = 0;
    this.drawnBalls = 0;  // The first of those, as many as the device can draw in time.
    this.pace = kFirstPace;
    this.otherTime = [0, 0];  // Milliseconds of a frame without balls, in motion and at rest.
    this.frame = 0;
    this.stripBelow = () => 0;  // CSS pixels of the picture that other elements cover.
    this.setUpCamera();
  }

  setUpCamera() {
    this.half = [0, 1, 2].map((k) => (this.scene.upper[k] - this.scene.lower[k]) / 2 / this.scene.scale);
    this.size = Math.hypot(...this.half) || 1;
    this.camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 10);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 0.02;
    this.controls.maxDistance = 40;
    this.controls.addEventListener('start', () => { this.chosen = true; });
    this.controls.addEventListener('change', () => this.draw());
    this.resize();
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // The field of view is that of the shorter side.
    const half = Math.tan(MathUtils.degToRad(kFieldOfView / 2)) / Math.min(this.camera.aspect, 1);
    this.camera.fov = 2 * MathUtils.radToDeg(Math.atan(half));
    this.camera.updateProjectionMatrix();
    this.unitsPerPixel = 2 * half / height;
    this.uniforms.viewport.value.set(width, height);
    this.refit();
    this.draw();
  }

  /** Fits the model into the picture again, unless the user has chosen a view. */
  refit() {
    if (!this.chosen) this.resetView();
  }

  /** At rest, doubles the resolution of a screen with large pixels in both directions, against jagged edges. */
  setSharpness(atRest) {
    const screen = Math.min(window.devicePixelRatio, 2);
    const ratio = atRest && screen < 2 ? 2 * screen : screen;
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
    this.uniforms.pixelRatio.value = ratio;
    this.uniforms.pixelsPerUnit.value = ratio / this.unitsPerPixel;
  }

  /** Calls `visit` with the vertices in the initial view. A sample of some thousand suffices. */
  forVerticesInView(visit) {
    const {vertices} = this.scene;
    const toView = new Matrix4().lookAt(kFrom, new Vector3(), this.camera.up).invert().multiply(this.model.matrixWorld);
    const place = new Vector3();
    const stride = 3 * Math.ceil(vertices.length / 3 / 5000);
    for (let i = 0; i < vertices.length; i += stride) visit(place.fromArray(vertices, i).applyMatrix4(toView));
  }

  /** A distance from which every vertex is visible in the initial view: the middle of the model's box is in the middle
   * of the picture. */
  safeDistance() {
    const up = Math.tan(MathUtils.degToRad(this.camera.fov / 2)), right = up * this.camera.aspect;
    let distance = 0.1 * this.size;
    this.forVerticesInView(({x, y, z}) => { distance = Math.max(distance, z + Math.abs(x) / right, z + Math.abs(y) / up); });
    return distance;
  }

  /** The part of the picture that the model covers from a distance: the middle and half the size, 1 being half the
   * picture. */
  covered(distance) {
    const up = Math.tan(MathUtils.degToRad(this.camera.fov / 2)), right = up * this.camera.aspect;
    const least = [Infinity, Infinity], greatest = [-Infinity, -Infinity];
    this.forVerticesInView(({x, y, z}) => {
      [x / right, y / up].forEach((value, k) => {
        least[k] = Math.min(least[k], value / (distance - z));
        greatest[k] = Math.max(greatest[k], value / (distance - z));
      });
    });
    if (least[0] > greatest[0]) return {left: 0, top: 0, width: 0, height: 0};  // No vertices.
    const [left, top] = least.map((value, k) => (value + greatest[k]) / 2);
    const [width, height] = least.map((value, k) => (greatest[k] - value) / 2);
    return {left, top, width, height};
  }

  /** Centres the visible part of the model in the picture, or in the part that the legend leaves free. */
  resetView() {
    this.chosen = false;
    this.model.updateMatrixWorld();
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    const taken = height > 0 ? Math.min(this.stripBelow() / height, 0.5) : 0;
    const safe = this.safeDistance();
    let distance = safe / kFilled;
    for (let i = 0; i < 4; ++i) {
      const seen = this.covered(distance);
      distance = Math.max(distance * Math.max(seen.width, seen.height / (1 - taken)) / kFilled, 0.6 * safe);
    }
    const {left, top} = this.covered(distance);
    this.camera.setViewOffset(width, height, left * width / 2, (taken - top) * height / 2, width, height);
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(kFrom).multiplyScalar(distance);
    this.controls.update();
    this.draw();
  }

  /** Turns about the target, in radians, and moves `nearer` times as close. */
  turn(right, up, nearer = 1) {
    this.chosen = true;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const spherical = new Spherical().setFromVector3(offset);
    spherical.theta += right;
    spherical.phi = MathUtils.clamp(spherical.phi + up, 0.01, Math.PI - 0.01);
    spherical.radius = MathUtils.clamp(spherical.radius / nearer, this.controls.minDistance, this.controls.maxDistance);
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(spherical));
    this.controls.update();
    this.draw();
  }

  setUp(axis) {
    this.model.rotation.set(...kTurns[axis]);
    this.resetView();
  }

  showLayer(name, visible) {
    this.shown[name] = visible;
    if (name === 'mesh') {
      for (const object of this.mesh.objects) object.visible = visible;
    } else if (visible || this.points.made[name]) {
      const object = this.points.get(name);
      if (!object.parent) this.model.add(object);
      object.visible = visible && this.scene.points > 0;
    }
    this.draw();
  }

  addCreases() {
    const lines = this.mesh.addCreases();
    lines.visible = this.shown.mesh;
    this.model.add(lines);
    this.draw();
  }

  setTheme(name) {
    const theme = kThemes[name];
    this.uniforms.glass.value.set(...theme.glass);
    this.uniforms.crease.value.set(...theme.crease);
    for (const part of ['picked', 'spokeA', 'spokeB']) this.picked.colours[part].set(...theme[part]);
    this.draw();
  }

  /** 0: invisible, 0.5: glass, 1: opaque. */
  setOpacity(share) {
    this.uniforms.density.value = share < 1 ? share / (1 - share) : 1e4;
    this.draw();
  }

  setColour(attribute, least, greatest) {
    this.uniforms.colourBy.value = kAttributes[attribute].component;
    this.uniforms.colourRange.value.set(least, greatest);
    this.draw();
  }

  setLeast(angle, radius) {
    this.least = {angle, radius};
    this.uniforms.leastAngleRadius.value.set(angle, radius);
    this.draw();
  }

  /** The side where dot(plane, p) + plane[3] >= 0 is kept, in the model. */
  setPlane(plane) {
    this.plane = plane;
    this.draw();
  }

  setBallCount(count) {
    this.ballCount = count;
    this.draw();
  }

  passesFilter(i) {
    return this.scene.angles[i] >= this.least.angle && this.scene.radii[i] >= this.least.radius;
  }

  centre(i) { return Array.from(this.scene.centres.subarray(3 * i, 3 * i + 3)); }

  isVisible(i) {
    const [x, y, z] = this.centre(i);
    const p = this.plane;
    return this.passesFilter(i) && p[0] * x + p[1] * y + p[2] * z + p[3] >= 0;
  }

  countVisible() {
    const {centres, angles, radii, points} = this.scene;
    const [x, y, z, w] = this.plane;
    let count = 0;
    for (let i = 0; i < points; ++i) {
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

  /** The point or ball at a position of the canvas, in CSS pixels; -1: none. */
  pickAt(x, y) {
    const {clientWidth, clientHeight} = this.canvas;
    this.root.updateMatrixWorld();
    const inverse = new Matrix4().copy(this.model.matrixWorld).invert();
    const origin = this.camera.position.clone();
    const direction = new Vector3(2 * x / clientWidth - 1, 1 - 2 * y / clientHeight, 0.5).unproject(this.camera)
      .sub(origin).transformDirection(inverse);
    const marks = this.shown.points || this.shown.sheets || this.shown.spokes;
    const radius = this.shown.sheets ? this.uniforms.discRadius.value : this.uniforms.pointRadius.value;
    return pick(this.scene, {
      ray: {origin: origin.applyMatrix4(inverse).toArray(), direction: direction.toArray()},
      plane: this.plane,
      visible: (i) => this.passesFilter(i),
      order: this.shown.balls ? this.points.order : [],
      ballCount: this.shown.balls ? this.drawnBalls : 0,
      points: marks ? {radius} : null,
      unitsPerPixel: this.unitsPerPixel,
    });
  }

  /** Draws at the next opportunity: quickly, and once more at full quality when nothing has changed for a while. */
  draw() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.drawNow(true), 250);
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.drawNow(false);
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

  /** Measures the speed of the device from a frame, without waiting for it; at rest, more balls may follow. */
  learnPace(atRest) {
    const gl = this.renderer.getContext();
    const pixels = this.shown.balls ? this.pixelsOfBalls(this.drawnBalls) : 0, begin = performance.now(), frame = this.frame;
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (gl.isContextLost()) return;
      if (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) {
        setTimeout(look, 4);
        return;
      }
      gl.deleteSync(sync);
      const time = performance.now() - begin;
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
    };
    setTimeout(look, 4);
  }

  drawNow(atRest) {
    const {camera} = this;
    this.setSharpness(atRest);
    const away = camera.position.length();
    const reach = 1.5 * this.size;
    camera.near = Math.max(away - reach, 0.002 * this.size);
    camera.far = away + reach;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.model.updateMatrixWorld();
    this.updatePlane();
    this.frame += 1;
    if (this.shown.balls) {
      this.drawnBalls = this.ballsWithin(atRest ? kRestingTime : kTurningTime);
      this.points.get('balls').geometry.setDrawRange(0, kCornersOfABall * this.drawnBalls);
    }
    this.renderer.render(this.root, camera);
    this.learnPace(atRest);
    if (atRest) this.onRest?.();
  }

  updatePlane() {
    const [x, y, z, w] = this.plane;
    if (x === 0 && y === 0 && z === 0) {
      this.uniforms.cutPlane.value.set(0, 0, 0, 1);
      return;
    }
    const toView = new Matrix4().multiplyMatrices(this.camera.matrixWorldInverse, this.model.matrixWorld);
    const plane = new Plane(new Vector3(x, y, z), w).applyMatrix4(toView);
    this.uniforms.cutPlane.value.set(plane.normal.x, plane.normal.y, plane.normal.z, plane.constant);
  }

  /** Waits for the device: the frame is complete when this returns. */
  finish() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
