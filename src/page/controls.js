// The form beside the canvas, the keys, and the selection.
import {vertexValues} from './boundary.js';
import {kAttributes, kSheetColours, kViridisCss, sheetColour} from './colours.js';
import {refreshCut} from './cut.js';
import {brief, grouped, lengthFormat} from './format.js';
import {barOf, swatchesOf} from './legend.js';
import {bindDialogs, bindFold, bindKeys, byId, followTheme, onClick, rows} from './page_parts.js';
import {kStrokesNote} from './strokes.js';
import {kLayers} from './viewer.js';

const kStep = Math.PI / 36;      // One press of an arrow key.
const kFirstBalls = 400;         // Drawn at first: enough to fill a shape, few enough to distinguish.

const kSides = ['inside', 'outside'];

function rangeOf(numbers) {
  let least = Infinity, greatest = -Infinity;
  for (const x of numbers) {
    if (x < least) least = x;
    if (x > greatest) greatest = x;
  }
  return numbers.length ? [least, greatest] : [0, 0];
}

export class Controls {
  constructor(viewer, scene, report) {
    this.viewer = viewer;
    this.scene = scene;
    this.report = report;
    this.pickedPoint = -1;
  }

  describeRun() {
    const {input, mesh, points} = this.report;
    byId('name').textContent = input === '-' ? 'standard input' : input.split('/').pop();
    byId('facts').textContent = `${grouped(points.written)} medial points, ${grouped(mesh.triangles)} triangles`;
  }

  start() {
    const {scene} = this;
    this.length = lengthFormat(scene.scale);
    this.ranges = {
      angle: rangeOf(scene.angles),
      radius: rangeOf(scene.radii),
      flux: rangeOf(scene.fluxes),
      sheet: rangeOf(scene.sheets),
      side: [0, 1],
    };
    // Angles are shown between the threshold and the greatest value, as in --picture.
    this.colourRanges = {...this.ranges, angle: [Math.min(this.report.parameters.object_angle, this.ranges.angle[0]),
      Math.PI / 2]};
    this.describeRun();
    this.bind();
    bindKeys(this.keys(), (...of) => this.ownsKey(...of));
    this.bindCanvas();
    bindDialogs(['report', 'help']);
    followTheme(this.viewer);
    for (const name of kLayers) this.viewer.showLayer(name, byId(`layer-${name}`).checked);
    byId('ball-count').value = scene.points > 1
      ? Math.round(1000 * Math.log(Math.min(kFirstBalls, scene.points)) / Math.log(scene.points)) : 1000;
    byId('picked-number').max = Math.max(scene.points - 1, 0);
    this.viewer.onRest = () => this.sayBalls();
    // On a narrow screen the legend is a strip across the picture.
    this.viewer.stripBelow = () => (byId('legend').offsetWidth === byId('stage').clientWidth ? byId('legend').offsetHeight : 0);
    byId('offer-side').hidden = scene.inside_points === null;
    byId('colour-side').hidden = scene.inside_points === null;
    this.offerColours();
    this.refresh();
    byId('up').value = scene.up;
    this.viewer.setUp(scene.up);
  }

  bind() {
    for (const name of kLayers) {
      byId(`layer-${name}`).addEventListener('change', (event) => this.viewer.showLayer(name, event.target.checked));
    }
    for (const id of ['opacity', 'ball-count', 'colour-by', 'side', 'least-angle', 'least-radius', 'cut', 'cut-axis',
      'cut-flip', 'cut-offset']) {
      byId(id).addEventListener('input', () => this.refresh());
    }
    byId('mesh-colour').addEventListener('input', () => this.paintMesh());
    byId('strokes').addEventListener('change', (event) => {
      this.viewer.showStrokes(event.target.checked);
      this.refreshColour();
    });
    byId('up').addEventListener('change', (event) => this.viewer.setUp(event.target.value));
    byId('reset').addEventListener('click', () => this.viewer.resetView());
    byId('clear-picked').addEventListener('click', () => this.choose(-1));
    byId('picked-number').addEventListener('change', (event) => {
      const number = event.target.value === '' ? -1 : Math.trunc(Number(event.target.value));
      this.choose(number >= 0 && number < this.scene.points ? number : -1);
    });
    byId('controls').addEventListener('submit', (event) => event.preventDefault());
    bindFold();
  }

  /** Applies the form to the picture; this is cheap, so all of it is applied each time. */
  refresh() {
    this.refreshOpacity();
    this.refreshBalls();
    this.refreshColour();
    this.refreshCut();
    this.refreshFilter();
  }

  /** The colours of the boundary, if it was measured. */
  offerColours() {
    const {boundary} = this.scene;
    byId('boundary').hidden = !boundary;
    byId('offer-strokes').hidden = !boundary?.directions.length;
    for (const {name, label} of boundary?.colours ?? []) byId('mesh-colour').append(new Option(label, name));
  }

  /** A coloured mesh is opaque at first, as its colours could not be read through one another. */
  paintMesh() {
    const name = byId('mesh-colour').value;
    if (name && !this.viewer.isPainted) byId('opacity').value = 100;
    this.viewer.paintMesh(name || null);
    if (!name) this.chooseVertex(-1);
    this.refreshOpacity();
    this.refreshColour();
  }

  chooseVertex(v) {
    byId('vertex-none').hidden = v >= 0;
    byId('vertex-values').hidden = v < 0;
    if (v >= 0) rows(byId('vertex-values'), vertexValues(this.scene.boundary, v));
  }

  refreshOpacity() {
    const percent = Number(byId('opacity').value);
    byId('opacity-value').textContent = `${percent} %`;
    this.viewer.setOpacity(percent / 100);
  }

  refreshBalls() {
    const count = Math.round(this.scene.points ** (byId('ball-count').value / 1000));
    const balls = Math.min(count, this.scene.points);
    this.viewer.setBallCount(balls);
    this.sayBalls();
  }

  /** Shows the number of balls and, if the device is too slow for them, the number drawn. */
  sayBalls() {
    const {ballCount, drawnBalls, shown} = this.viewer;
    byId('ball-count-value').textContent = grouped(ballCount);
    byId('balls-drawn').textContent = shown.balls && drawnBalls < ballCount ? `${grouped(drawnBalls)} of them drawn` : '';
  }

  refreshColour() {
    const attribute = byId('colour-by').value;
    const [least, greatest] = this.colourRanges[attribute];
    this.viewer.setColour(attribute, least, greatest);
    const scale = attribute === 'radius' ? this.scene.scale : 1;
    const legend = byId('legend');
    const title = document.createElement('p');
    title.textContent = kAttributes[attribute].label;
    legend.replaceChildren(...this.legendOfMesh(), title,
      ...(attribute === 'sheet' ? this.swatches() : attribute === 'side' ? [swatchesOf(kSides.map((side, i) => [sheetColour(i), side]))]
        : this.bar(scale * least, scale * greatest)));
  }

  legendOfMesh() {
    const note = byId('strokes').checked ? [Object.assign(document.createElement('p'), {textContent: kStrokesNote})] : [];
    return [...this.legendOfMeshColour(), ...note];
  }

  legendOfMeshColour() {
    const colour = this.scene.boundary?.colours.find(({name}) => name === byId('mesh-colour').value);
    if (!colour) return [];
    const title = Object.assign(document.createElement('p'), {textContent: colour.title});
    if (colour.bar.length > 0) return [title, ...barOf(colour.bar, [colour.least, colour.greatest])];
    return [title, swatchesOf(colour.swatches)];
  }

  bar(least, greatest) {
    return barOf(kViridisCss, [least, (least + greatest) / 2, greatest].map(brief));
  }

  /** Sheets by number; if they outnumber the colours, the colours repeat. */
  swatches() {
    const numbers = [...new Set(this.scene.sheets)].sort((a, b) => a - b);
    const rows = numbers.slice(0, kSheetColours + 1)
      .map((sheet) => [sheetColour(sheet), sheet < 0 ? 'none (sheets not grown)' : String(sheet)]);
    const more = numbers.length - rows.length;
    return [swatchesOf(more > 0 ? [...rows, [null, `and ${grouped(more)} more`]] : rows)];
  }

  refreshCut() { refreshCut(this.scene, this.length, this.viewer); }

  /** The smallest value of a slider lets everything pass, for any rounding. */
  leastOf(id, range) {
    const share = byId(id).value / 1000;
    return share === 0 ? -Infinity : Math.fround(range[0] + share * (range[1] - range[0]));
  }

  refreshFilter() {
    const angle = this.leastOf('least-angle', this.ranges.angle);
    const radius = this.leastOf('least-radius', this.ranges.radius);
    byId('least-angle-value').textContent = `${Math.max(angle, this.ranges.angle[0]).toFixed(3)} rad`;
    byId('least-radius-value').textContent = brief(Math.max(radius, this.ranges.radius[0]) * this.scene.scale);
    this.viewer.setLeast(angle, radius);
    if (this.scene.inside_points !== null) this.viewer.setSide(byId('side').value);
    byId('count').textContent = `${grouped(this.viewer.countVisible())} of ${grouped(this.scene.points)} points shown`;
  }

  /** Selects point i; -1: none. */
  choose(i) {
    this.pickedPoint = i;
    this.viewer.highlight(i);
    byId('picked-none').hidden = i >= 0;
    byId('picked-values').hidden = i < 0;
    byId('picked-number').value = i < 0 ? '' : i;
    byId('clear-picked').disabled = i < 0;
    if (i >= 0) rows(byId('picked-values'), this.valuesOf(i));
  }

  valuesOf(i) {
    const {scene} = this;
    const place = (k) => this.length(scene.origin[k] + scene.scale * scene.centres[3 * i + k]);
    const spoke = (from) => [0, 1, 2].map((k) => (scene.spokes[6 * i + from + k] / 32767).toFixed(4)).join(', ');
    const angle = scene.angles[i];
    return [
      ['point', String(i)],
      ...(scene.inside_points === null ? [] : [['side', kSides[Number(i >= scene.inside_points)]]]),
      ['centre', [place(0), place(1), place(2)].join(', ')],
      ['radius', this.length(scene.scale * scene.radii[i])],
      ['object angle', `${angle.toFixed(6)} rad (${(angle * 180 / Math.PI).toFixed(1)}°)`],
      ['flux', scene.fluxes[i].toFixed(6)],
      ['sheet', scene.sheets[i] < 0 ? `${scene.sheets[i]} (not grown)` : String(scene.sheets[i])],
      ['voxel', Array.from(scene.voxels.subarray(3 * i, 3 * i + 3)).join(', ')],
      ['spoke a', spoke(0)],
      ['spoke b', spoke(3)],
    ];
  }

  /** Selects the next or previous visible point. */
  step(by) {
    const count = this.scene.points;
    for (let k = 1; k <= count; ++k) {
      const i = ((this.pickedPoint < 0 && by < 0 ? 0 : this.pickedPoint) + by * k + count * 2) % count;
      if (this.viewer.isVisible(i)) return this.choose(i);
    }
  }

  bindCanvas() {
    onClick(this.viewer.canvas, (...place) => {
      const isOpaque = this.viewer.isPainted && Number(byId('opacity').value) === 100;
      if (!isOpaque) this.choose(this.viewer.pickAt(...place));
      if (isOpaque || this.pickedPoint < 0) this.chooseVertex(this.viewer.vertexAt(...place));
    });
  }

  pickMiddle() {
    const {clientWidth, clientHeight} = this.viewer.canvas;
    this.choose(this.viewer.pickAt(clientWidth / 2, clientHeight / 2));
  }

  /** Keys, their names, and their actions. */
  keys() {
    const click = (id) => () => byId(id).click();
    const turn = (right, up) => () => this.viewer.turn(right * kStep, up * kStep);
    return [
      [['ArrowLeft'], 'Arrows', 'turn', turn(-1, 0)],
      [['ArrowRight'], null, null, turn(1, 0)],
      [['ArrowUp'], null, null, turn(0, -1)],
      [['ArrowDown'], null, null, turn(0, 1)],
      [['+', '='], '+ and -', 'zoom', () => this.viewer.turn(0, 0, 1.15)],
      [['-', '_'], null, null, () => this.viewer.turn(0, 0, 1 / 1.15)],
      [['0', 'r', 'R'], '0 or R', 'reset the view', () => this.viewer.resetView()],
      ...kLayers.map((name, i) => [[String(i + 1)], i === 0 ? '1 to 5' : null,
        'show or hide mesh, balls, medial points, spokes, sheets', click(`layer-${name}`)]),
      [['c', 'C'], 'C', 'cut by a plane', click('cut')],
      [['f', 'F'], 'F', 'keep the other side of the cut', click('cut-flip')],
      [['Enter'], 'Enter', 'pick what is in the middle of the picture (keyboard on the picture)', () => this.pickMiddle(), true],
      [['['], '[ and ]', 'pick the point before or after', () => this.step(-1)],
      [[']'], null, null, () => this.step(1)],
      [['Escape'], 'Escape', 'pick nothing; close what is open', () => this.choose(-1)],
      [['h', 'H', '?'], 'H', 'this help', click('open-help')],
    ];
  }

  /** Keys that an element of the form handles itself. */
  ownsKey(target, key, onPictureOnly) {
    if (key === 'Escape') return false;
    if (onPictureOnly) return target !== this.viewer.canvas && target !== document.body;
    if (target.matches('select, input[type=number]')) return true;
    return target.matches('input[type=range]') && (key.startsWith('Arrow') || key === '+' || key === '-');
  }
}
