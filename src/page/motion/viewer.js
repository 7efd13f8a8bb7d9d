// The canvas of the page of a motion: the mesh of a frame as glass, and its balls.
import {commonUniforms, MeshLayer} from '../kernels.js';
import {View} from '../view.js';
import {BallLayer} from './balls.js';
import {Skin} from './skin.js';

// Pixels of the picture for one of the screen while frames follow each other: the device takes the first for which a
// picture takes no longer than kFrameTime. With the last one, only the near side of the glass is drawn.
const kRatios = [1, 0.75, 0.5];
const kFrameTime = 28, kShortTime = 10;  // Milliseconds: less for a while, and the picture becomes finer again.
const kFramesToTrust = 20;

/** A sample of the vertices of all frames, for the first view. */
function sampleOf(places, {lower, step}) {
  const stride = 3 * Math.ceil(places.length / 3 / 5000);
  const sample = [];
  for (let i = 0; i < places.length; i += stride) {
    for (let k = 0; k < 3; ++k) sample.push(lower[k] + step[k] * places[i + k]);
  }
  return Float32Array.from(sample);
}

export class MotionViewer extends View {
  constructor(canvas, context, motion, geometry) {
    const sides = [0, 1, 2].map((k) => (motion.upper[k] - motion.lower[k]) / motion.scale);
    const grid = {lower: sides.map((side) => -side / 2), step: sides.map((side) => side / 65535)};
    super(canvas, context, commonUniforms(), {vertices: sampleOf(geometry.places, grid), half: sides.map((s) => s / 2)});
    this.size3 = 3 * motion.vertices;
    this.places = geometry.places;
    this.skin = new Skin({triangles: geometry.triangles, ...grid}, this.placesOf(0));
    this.mesh = new MeshLayer(this.skin.surface, this.uniforms);
    this.mesh.addCreases(this.skin.creases);
    this.balls = new BallLayer(geometry, motion, this.uniforms, this.renderer.capabilities.maxTextureSize);
    this.model.add(...this.mesh.objects, this.balls.object);
    this.shown = {mesh: true, balls: true};
    this.ratio = 0;  // Of kRatios.
    this.short = 0;  // Frames in succession that took a short time.
  }

  /** Whether the device takes the coarsest picture. */
  get isSlow() { return this.ratio + 1 === kRatios.length; }

  placesOf(frame) { return this.places.subarray(this.size3 * frame, this.size3 * (frame + 1)); }

  /** `frame`: among those with geometry. */
  showFrame(frame) {
    this.skin.move(this.placesOf(frame));
    this.balls.show(frame);
    this.draw();
  }

  showLayer(name, visible) {
    this.shown[name] = visible;
    this.draw();
  }

  setColour(by) {
    this.balls.setColour(by);
    this.draw();
  }

  setBallOpacity(share) {
    this.balls.setOpacity(share);
    this.draw();
  }

  /** Whether frames follow each other: then the picture may be coarser than the screen. */
  setMoving(moving) {
    this.moving = moving;
    this.draw();
  }

  ratioOf(atRest) {
    return super.ratioOf(atRest) * (this.moving && !atRest ? kRatios[this.ratio] : 1);
  }

  prepare(atRest) {
    const coarse = this.moving && !atRest && this.isSlow;
    const [back, depth, ...others] = this.mesh.objects;
    for (const object of others) object.visible = this.shown.mesh;
    back.visible = depth.visible = this.shown.mesh && !coarse;
    this.balls.object.visible = this.shown.balls;
    const {clientWidth, clientHeight} = this.canvas;
    this.balls.prepare(this.camera, this.model, clientWidth, clientHeight, atRest);
  }

  drawn(atRest) {
    if (!this.moving || atRest) return;
    this.timeDevice((time) => this.learn(time));
  }

  learn(time) {
    this.short = time < kShortTime ? this.short + 1 : 0;
    if (time > kFrameTime && this.ratio + 1 < kRatios.length) {
      this.ratio += 1;
    } else if (this.short >= kFramesToTrust && this.ratio > 0) {
      this.ratio -= 1;
      this.short = 0;
    }
  }
}
