// The layers of the page of a run: one geometry and one kernel per layer.
import {
  DoubleSide, FloatType, LineSegments, Mesh, Points, RedIntegerFormat, RGBAFormat, RGBAIntegerFormat, ShortType,
  UnsignedIntType, Vector3, Vector4,
} from 'three';

import {coverOrder} from './ball_order.js';
import {colourTexels} from './colours.js';
import {
  colourMap, commonUniforms, corners, kCornersOfABall, kOpaque, kOrder, kOver, material, numbers, placed,
} from './kernels.js';
import attributes from './shaders/attributes.glsl';
import ballFragment from './shaders/ball.frag.glsl';
import ballVertex from './shaders/ball.vert.glsl';
import common from './shaders/common.glsl';
import discFragment from './shaders/disc.frag.glsl';
import discVertex from './shaders/disc.vert.glsl';
import flatFragment from './shaders/flat.frag.glsl';
import pointFragment from './shaders/point.frag.glsl';
import pointVertex from './shaders/point.vert.glsl';
import spokeFragment from './shaders/spoke.frag.glsl';
import spokeVertex from './shaders/spoke.vert.glsl';
import wideLineVertex from './shaders/wide_line.vert.glsl';

const kDiscRadius = 0.75;   // In voxels: the discs of neighbouring voxels overlap into a sheet.
const kPointRadius = 0.32;  // In voxels: small enough to distinguish neighbours.

/** Uniforms that all layers share: set once, visible to every kernel. */
export function makeUniforms(scene) {
  const voxel = scene.voxel_size / scene.scale;
  return {
    ...commonUniforms(),
    insidePoints: {value: scene.inside_points ?? scene.points},
    colourMap: {value: colourMap(colourTexels())},
    discRadius: {value: kDiscRadius * voxel},
    pointRadius: {value: kPointRadius * voxel},
    width: {value: 3},
  };
}

/** The textures of the points for the kernels (shaders/attributes.glsl). */
function pointTextures(scene, widest) {
  const places = new Float32Array(4 * scene.points), others = new Float32Array(4 * scene.points);
  const spokes = new Int16Array(8 * scene.points);
  for (let i = 0; i < scene.points; ++i) {
    for (let k = 0; k < 3; ++k) {
      places[4 * i + k] = scene.centres[3 * i + k];
      spokes[8 * i + k] = scene.spokes[6 * i + k];
      spokes[8 * i + 4 + k] = scene.spokes[6 * i + 3 + k];
    }
    places[4 * i + 3] = scene.radii[i];
    others[4 * i] = scene.angles[i];
    others[4 * i + 1] = scene.fluxes[i];
    others[4 * i + 2] = scene.sheets[i];
  }
  return {
    places: {value: numbers(places, 4, RGBAFormat, FloatType, 'RGBA32F', widest)},
    others: {value: numbers(others, 4, RGBAFormat, FloatType, 'RGBA32F', widest)},
    spokes: {value: numbers(spokes, 4, RGBAIntegerFormat, ShortType, 'RGBA16I', widest)},
    order: {value: null},
  };
}

/** The layers of points, each created when it is first shown. */
export class PointLayers {
  /** `widest`: the greatest width of a texture. */
  constructor(scene, uniforms, widest) {
    this.scene = scene;
    this.widest = widest;
    this.uniforms = {...uniforms, ...pointTextures(scene, widest)};
    this.made = {};
  }

  get order() {
    this.ballOrder ??= coverOrder(this.scene.centres, this.scene.radii, this.scene.voxel_size / this.scene.scale);
    return this.ballOrder;
  }

  /** For each number of balls from the front, the sum of the squares of their radii: a measure of the covered part of
   * the screen. */
  get squares() {
    if (!this.sums) {
      this.sums = new Float64Array(this.scene.points + 1);
      this.order.forEach((i, k) => { this.sums[k + 1] = this.sums[k] + this.scene.radii[i] ** 2; });
    }
    return this.sums;
  }

  get(name) {
    return this.made[name] ??= placed(this.make(name), kOrder.content);
  }

  make(name) {
    const {points} = this.scene;
    const kernel = (vertex, fragment, options) =>
      material(common + attributes + vertex, common + fragment, this.uniforms, {...kOpaque, ...options});
    if (name === 'points') return new Points(corners(points), kernel(pointVertex, pointFragment));
    if (name === 'sheets') return new Mesh(corners(3 * points), kernel(discVertex, discFragment, {side: DoubleSide}));
    if (name === 'spokes') return new LineSegments(corners(4 * points), kernel(spokeVertex, spokeFragment));
    this.uniforms.order.value = numbers(this.order, 1, RedIntegerFormat, UnsignedIntType, 'R32UI', this.widest);
    return new Mesh(corners(kCornersOfABall * points), kernel(ballVertex, ballFragment, {defines: {ORDERED: ''}}));
  }
}

/** The selected ball as glass, its two spokes and its contacts. */
export class PickedLayer {
  constructor(uniforms) {
    this.colours = {picked: new Vector3(), spokeA: new Vector3(), spokeB: new Vector3()};
    this.place = new Vector4();
    const seen = {...kOver, depthTest: false};
    const ballUniforms = {...uniforms, picked: {value: this.place}, pickedColour: {value: this.colours.picked}};
    const ball = new Mesh(corners(kCornersOfABall), material(common + attributes + ballVertex, common + ballFragment,
      ballUniforms, {...seen, defines: {PICKED: ''}}));
    this.spokes = ['spokeA', 'spokeB'].map((name) => {
      const own = {...uniforms, from: {value: new Vector3()}, to: {value: new Vector3()},
        colour: {value: this.colours[name]}};
      return new Mesh(corners(6), material(common + wideLineVertex, common + flatFragment, own,
        {...seen, side: DoubleSide}));
    });
    this.objects = [placed(ball, kOrder.picked), ...this.spokes.map((line) => placed(line, kOrder.picked + 1))];
    this.show(false);
  }

  show(visible) {
    for (const object of this.objects) object.visible = visible;
  }

  /** `tips`: the ends of the spokes. */
  set(centre, radius, tips) {
    this.place.set(...centre, radius);
    this.spokes.forEach((line, i) => {
      line.material.uniforms.from.value.set(...centre);
      line.material.uniforms.to.value.set(...tips[i]);
    });
    this.show(true);
  }
}
