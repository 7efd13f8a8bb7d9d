// A canvas with a camera that turns about the model: what all pages draw with. It draws only when something has changed.
import {Group, MathUtils, Matrix4, PerspectiveCamera, Plane, Scene, Spherical, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

import {kThemes} from './colours.js';

const kFieldOfView = 32;  // Degrees, of the shorter side.
const kFrom = new Vector3(0.62, 0.48, 1).normalize();  // From the right, above and the front, as --picture.
// Rotations that bring an axis up, about x, y and z: those of --picture (src/common/up_axis.h).
const kTurns = {
  y: [0, 0, 0], '-y': [Math.PI, 0, 0], z: [-Math.PI / 2, 0, 0], '-z': [Math.PI / 2, 0, 0], x: [0, 0, Math.PI / 2],
  '-x': [0, 0, -Math.PI / 2],
};
const kFilled = 0.88;  // The share of the picture that the model fills at first.

export class View {
  /** `context`: of WebGL 2, without antialiasing. `uniforms`: commonUniforms(). `vertices`: positions that the first view
   * holds; `half`: half the sides of the box around all that is drawn. */
  constructor(canvas, context, uniforms, {vertices, half}) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, context});
    this.renderer.setClearColor(0, 0);
    this.renderer.outputColorSpace = 'srgb-linear';  // Colours are given as displayed.
    this.root = new Scene();
    this.model = new Group();
    this.root.add(this.model);
    this.uniforms = uniforms;
    this.vertices = vertices;
    this.half = half;
    this.size = Math.hypot(...half) || 1;
    this.frame = 0;
    this.moving = false;
    this.plane = [0, 0, 0, 1];  // Of the cut; nothing is cut away.
    this.stripBelow = () => 0;  // CSS pixels of the picture that other elements cover.
    this.setUpCamera();
  }

  setUpCamera() {
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

  /** Pixels of the picture for one of the page, in each direction. At rest, doubles those of a screen with large pixels,
   * against jagged edges. */
  ratioOf(atRest) {
    const screen = Math.min(window.devicePixelRatio, 2);
    return atRest && screen < 2 ? 2 * screen : screen;
  }

  setSharpness(atRest) {
    const ratio = this.ratioOf(atRest);
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
    this.uniforms.pixelRatio.value = ratio;
    this.uniforms.pixelsPerUnit.value = ratio / this.unitsPerPixel;
  }

  /** Calls `visit` with the vertices in the initial view. A sample of some thousand suffices. */
  forVerticesInView(visit) {
    const {vertices} = this;
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

  setTheme(name) {
    const theme = kThemes[name];
    this.uniforms.glass.value.set(...theme.glass);
    this.uniforms.crease.value.set(...theme.crease);
    this.draw();
  }

  /** 0: invisible, 0.5: glass, 1: opaque. */
  setOpacity(share) {
    this.uniforms.density.value = share < 1 ? share / (1 - share) : 1e4;
    this.draw();
  }

  /** The side where dot(plane, p) + plane[3] >= 0 is kept, in the model. */
  setPlane(plane) {
    this.plane = plane;
    this.draw();
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

  /** The ray through a position of the canvas, in CSS pixels, in the model. */
  rayAt(x, y) {
    const {clientWidth, clientHeight} = this.canvas;
    this.root.updateMatrixWorld();
    const inverse = new Matrix4().copy(this.model.matrixWorld).invert();
    const origin = this.camera.position.clone();
    const direction = new Vector3(2 * x / clientWidth - 1, 1 - 2 * y / clientHeight, 0.5).unproject(this.camera)
      .sub(origin).transformDirection(inverse);
    return {origin: origin.applyMatrix4(inverse).toArray(), direction: direction.toArray()};
  }

  /** Draws at the next opportunity: quickly, and once more at full quality when nothing has changed for a while. While
   * `moving` the next change is near. */
  draw() {
    clearTimeout(this.rest);
    if (!this.moving) this.rest = setTimeout(() => this.drawNow(true), 250);
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.drawNow(false);
    });
  }

  /** Of a frame, before and after it is drawn: for classes that add layers. */
  prepare(_atRest) {}
  drawn(_atRest) {}

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
    this.frame += 1;
    this.prepare(atRest);
    this.renderer.render(this.root, camera);
    this.drawn(atRest);
  }

  /** Calls `then` with the milliseconds until the device has drawn all that it was given, without waiting for it. */
  timeDevice(then) {
    const gl = this.renderer.getContext();
    const begin = performance.now();
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (gl.isContextLost()) return;
      if (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) {
        setTimeout(look, 4);
        return;
      }
      gl.deleteSync(sync);
      then(performance.now() - begin);
    };
    setTimeout(look, 4);
  }

  /** Waits for the device: the frame is complete when this returns. */
  finish() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
