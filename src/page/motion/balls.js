// The balls of a frame, coloured by their state, their number or their radius.
import {FloatType, Matrix4, Mesh, RedIntegerFormat, RGBAFormat, UnsignedIntType} from 'three';

import {colourTexels, kSheetColours} from '../colours.js';
import {colourMap, corners, kCornersOfABall, kOpaque, kOrder, material, numbers, placed} from '../kernels.js';
import attributes from '../shaders/attributes.glsl';
import ballFragment from '../shaders/ball.frag.glsl';
import common from '../shaders/common.glsl';
import screen from '../shaders/screen.glsl';
import seenBallVertex from '../shaders/seen_ball.vert.glsl';
import {SeenParts} from './seen_parts.js';

// Readers with any colour vision can distinguish the colours, as they also differ in lightness.
const kBlue = [86, 180, 233], kYellow = [240, 200, 60], kRed = [196, 66, 110];

/** In the order of FollowState, whose last one, lost, has no ball. */
const kOfBallsInside = [
  {name: 'medial', colour: kBlue, what: 'touches the surface in two places that lie apart'},
  {name: 'flat', colour: kYellow, what: 'touches it in two places under a small angle'},
  {name: 'shrunk', colour: kRed, what: 'much smaller than in the rest pose'},
  {name: 'lost', what: 'no ball is known to be inside there in this frame; not drawn'},
];

/** In the order of CoverBallState, whose last one, unused, has no ball. */
const kOfCovers = [
  {name: 'steady', colour: kBlue, what: 'holds its part of the surface with about the radius of the rest pose'},
  {name: 'grown', colour: kRed, what: 'much larger than in the rest pose'},
  {name: 'unused', what: 'the cover of this frame does without it; not drawn'},
];

/** The balls of the motion cover each frame; otherwise they are inside. */
export const isCover = (motion) => motion.rule === 'cover';
export const statesOf = (motion) => (isCover(motion) ? kOfCovers : kOfBallsInside);
const kByRadius = 1, kByTexel = 3;  // Components of the kernels' `values` (shaders/attributes.glsl).
const kMovingCell = 4, kRestingCell = 2;  // Pixels of the page.

/** Row 1 of the map has a colour for each state. */
function stateTexels(motion) {
  const texels = colourTexels();
  statesOf(motion).forEach(({colour}, i) => { if (colour) texels.set(colour, 4 * (256 + i)); });
  return texels;
}

export class BallLayer {
  /** `geometry`: of readGeometry(motion). */
  constructor(geometry, motion, uniforms, widest) {
    const count = motion.balls;
    this.balls = geometry.balls;
    this.states = geometry.states;
    this.count = count;
    const texture = (array) => numbers(array, 4, RGBAFormat, FloatType, 'RGBA32F', widest);
    this.places = texture(new Float32Array(4 * count));
    this.others = texture(new Float32Array(4 * count));
    this.rectangles = texture(new Float32Array(4 * count));
    this.order = numbers(new Uint32Array(count), 1, RedIntegerFormat, UnsignedIntType, 'R32UI', widest);
    this.parts = new SeenParts(count);
    this.maps = {states: colourMap(stateTexels(motion)), numbers: colourMap(colourTexels())};
    this.uniforms = {...uniforms, places: {value: this.places}, others: {value: this.others}, order: {value: this.order},
      rectangles: {value: this.rectangles}, colourMap: {value: null}, ballOpacity: {value: 1}};
    const defines = isCover(motion) ? {ORDERED: '', SCREENED: ''} : {ORDERED: ''};
    this.object = placed(new Mesh(corners(kCornersOfABall * count), material(common + attributes + seenBallVertex,
      common + screen + ballFragment, this.uniforms, {...kOpaque, defines})), kOrder.content);
    let greatest = 0;
    for (let i = 3; i < this.balls.length; i += 4) greatest = Math.max(greatest, this.balls[i]);
    this.greatest = greatest;
    this.frame = 0;
    this.setColour('state');
  }

  /** `by`: state, ball or radius. */
  setColour(by) {
    this.by = by;
    this.uniforms.colourBy.value = by === 'radius' ? kByRadius : kByTexel;
    this.uniforms.colourRange.value.set(0, this.greatest);
    this.uniforms.colourMap.value = by === 'state' ? this.maps.states : this.maps.numbers;
    this.show(this.frame);
  }

  /** 0: invisible, 1: opaque. Of a cover alone, which hides the mesh. */
  setOpacity(share) { this.uniforms.ballOpacity.value = share; }

  /** `frame`: among those with geometry. */
  show(frame) {
    this.frame = frame;
    const {count} = this;
    this.places.image.data.set(this.balls.subarray(4 * count * frame, 4 * count * (frame + 1)));
    const others = this.others.image.data;
    for (let i = 0; i < count; ++i) {
      others[4 * i + 2] = this.by === 'state' ? this.states[count * frame + i] : i % kSheetColours;
    }
    this.places.needsUpdate = true;
    this.others.needsUpdate = true;
  }

  /** Before a picture of `width` x `height` pixels of the page. */
  prepare(camera, model, width, height, atRest) {
    if (!this.object.visible) return;
    const cell = atRest ? kRestingCell : kMovingCell;
    const toView = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, model.matrixWorld);
    const seen = this.parts.find(this.places.image.data.subarray(0, 4 * this.count), toView.elements,
      camera.projectionMatrix.elements, Math.ceil(width / cell), Math.ceil(height / cell));
    this.rectangles.image.data.set(this.parts.rectangles.subarray(0, 4 * seen));
    this.order.image.data.set(this.parts.seen.subarray(0, seen));
    this.rectangles.needsUpdate = true;
    this.order.needsUpdate = true;
    this.object.geometry.setDrawRange(0, kCornersOfABall * seen);
  }
}
