// The form beside the picture, its legend, the keys, and the picked face.
import {kViridisCss, sheetColour} from '../colours.js';
import {refreshCut} from '../cut.js';
import {brief, grouped, lengthFormat, plain} from '../format.js';
import {barOf, swatchesOf} from '../legend.js';
import {bindDialogs, bindFold, bindKeys, byId, element, followTheme, onClick, rows} from '../page_parts.js';

const kStep = Math.PI / 36;  // One press of an arrow key.
const kMostListed = 40;      // Pairs, those with the largest areas.
const kMostInLegend = 6;
const kLayers = ['sites', 'surface', 'roadmap', 'path'];

/** Numbers of pairs by descending area. */
const byArea = (pairs) => pairs.map((_, i) => i).sort((a, b) => pairs[b].area - pairs[a].area || a - b);

/** What is said about the surface, without a drawing. */
export class SurfaceText {
  constructor(numbers) {
    this.numbers = numbers;
    this.order = byArea(numbers.pairs);
  }

  nameOf(site) { return this.numbers.sites[site].name; }
  nameOfPair(pair) { return this.numbers.pairs[pair].sites.map((site) => this.nameOf(site)).join(' and '); }

  describe() {
    const {sites, pairs, faces, numbers, assumptions, path, path_was_sought: wasSought} = this.numbers;
    byId('name').textContent = sites.length > 3 ? `${sites.length} sites` : sites.map(({name}) => name).join(', ');
    byId('facts').textContent = `${grouped(sites.length)} sites, ${grouped(pairs.length)} pairs, ${grouped(faces)} faces`;
    rows(byId('numbers'), numbers.map(([name, value]) => [name, plain(value)]));
    byId('notes').replaceChildren(...assumptions.map((text) => element('p', text)));
    byId('path-part').hidden = !wasSought;
    byId('no-path').hidden = Boolean(path);
    if (path) rows(byId('path-values'), [['width', plain(path.width)], ['length', plain(path.length)]]);
  }
}

export class SurfaceControls {
  constructor(viewer, numbers, text) {
    this.viewer = viewer;
    this.numbers = numbers;
    this.text = text;
    this.length = lengthFormat(numbers.scale);
    this.picked = null;
  }

  start() {
    const {viewer, numbers} = this;
    this.listPairs();
    for (const name of ['roadmap', 'path']) byId(`offer-${name}`).hidden = viewer.layers[name].length === 0;
    this.bind();
    bindKeys(this.keys(), (...of) => this.ownsKey(...of));
    bindDialogs(['help']);
    followTheme(viewer);
    // On a narrow screen the legend is a strip across the picture.
    viewer.stripBelow = () => (byId('legend').offsetWidth === byId('stage').clientWidth ? byId('legend').offsetHeight : 0);
    for (const name of kLayers) viewer.showLayer(name, byId(`layer-${name}`).checked);
    this.refresh();
    byId('up').value = numbers.up;
    viewer.setUp(numbers.up);
  }

  /** The legend of pairs, each with a box that shows or hides its faces. */
  listPairs() {
    const {pairs} = this.numbers;
    const listed = this.text.order.slice(0, kMostListed), rest = this.text.order.slice(kMostListed);
    this.boxes = [];
    const row = (which, colour, name, values) => {
      const box = Object.assign(element('input'), {type: 'checkbox', checked: true});
      this.boxes.push({box, which});
      const label = element('label', null, box);
      if (colour) {
        const swatch = element('i');
        swatch.style.background = colour;
        label.append(swatch);
      }
      label.append(element('span', name));
      label.className = 'check';
      const cell = (text) => Object.assign(element('td', text), {className: 'number'});
      return element('tr', null, element('td', null, label), ...values.map(cell));
    };
    byId('pairs').replaceChildren(
      ...listed.map((i) => row([i], sheetColour(i), this.text.nameOfPair(i), [brief(pairs[i].area), brief(pairs[i].least)])),
      ...(rest.length > 0 ? [row(rest, null, `${grouped(rest.length)} more`, ['', ''])] : []));
    byId('no-pairs').hidden = pairs.length > 0;
  }

  shownPairs() {
    const shown = this.numbers.pairs.map(() => false);
    for (const {box, which} of this.boxes) for (const i of which) shown[i] = box.checked;
    return shown;
  }

  bind() {
    const {viewer} = this;
    for (const name of kLayers) {
      byId(`layer-${name}`).addEventListener('change', (event) => {
        viewer.showLayer(name, event.target.checked);
        this.refreshLegend();
      });
    }
    for (const id of ['opacity', 'surface-opacity']) byId(id).addEventListener('input', () => this.refreshOpacity());
    for (const id of ['cut', 'cut-axis', 'cut-flip', 'cut-offset']) byId(id).addEventListener('input', () => this.refreshCut());
    byId('colour-by').addEventListener('input', () => this.repaint());
    byId('pairs').addEventListener('change', () => this.repaint());
    byId('all-pairs').addEventListener('click', () => this.checkAll(true));
    byId('no-pair').addEventListener('click', () => this.checkAll(false));
    byId('up').addEventListener('change', (event) => viewer.setUp(event.target.value));
    byId('reset').addEventListener('click', () => viewer.resetView());
    byId('clear-picked').addEventListener('click', () => this.choose(null));
    byId('controls').addEventListener('submit', (event) => event.preventDefault());
    onClick(viewer.canvas, (x, y) => this.choose(viewer.pickAt(x, y)));
    bindFold();
  }

  checkAll(checked) {
    for (const {box} of this.boxes) box.checked = checked;
    this.repaint();
  }

  refresh() {
    this.refreshOpacity();
    this.refreshCut();
    this.repaint();
  }

  refreshOpacity() {
    const {viewer} = this;
    const shareOf = (id) => {
      const percent = Number(byId(id).value);
      byId(`${id}-value`).textContent = `${percent} %`;
      return percent / 100;
    };
    viewer.setOpacity(shareOf('opacity'));
    viewer.setSurfaceOpacity(shareOf('surface-opacity'));
  }

  refreshCut() { refreshCut(this.numbers, this.length, this.viewer); }

  repaint() {
    this.viewer.paint(byId('colour-by').value, this.shownPairs());
    this.refreshLegend();
  }

  refreshLegend() {
    byId('legend').replaceChildren(...this.legendOfSurface(), ...this.legendOfRoadmap());
  }

  bar([least, greatest]) {
    const {scale} = this.numbers;
    return barOf(kViridisCss, [least, (least + greatest) / 2, greatest].map((x) => brief(scale * x)));
  }

  legendOfSurface() {
    if (!byId('layer-surface').checked) return [];
    if (byId('colour-by').value === 'distance') {
      return [element('p', 'distance to the nearest site'), ...this.bar(this.viewer.distanceRange)];
    }
    const shown = this.text.order.filter((i) => this.viewer.shownPairs[i]);
    const lines = shown.slice(0, kMostInLegend).map((i) => [sheetColour(i), this.text.nameOfPair(i)]);
    if (shown.length > lines.length) lines.push([null, `and ${grouped(shown.length - lines.length)} more`]);
    return [element('p', 'faces between'), swatchesOf(lines)];
  }

  legendOfRoadmap() {
    if (!this.viewer.widthRange || !byId('layer-roadmap').checked) return [];
    return [element('p', 'width of a link'), ...this.bar(this.viewer.widthRange)];
  }

  /** `hit`: a triangle and a point; null: nothing. */
  choose(hit) {
    const {pairOfTriangle} = this.viewer.geometry;
    this.picked = hit;
    const pair = hit ? pairOfTriangle[hit.triangle] : -1;
    this.viewer.highlight(hit ? hit.vertex : -1, hit ? this.numbers.pairs[pair].sites : []);
    byId('picked-none').hidden = hit !== null;
    byId('picked-values').hidden = hit === null;
    byId('clear-picked').disabled = hit === null;
    if (hit) rows(byId('picked-values'), this.valuesOf(hit, pair));
  }

  valuesOf({triangle, vertex}, pair) {
    const {geometry} = this.viewer, {origin, scale} = this.numbers;
    const place = [0, 1, 2].map((k) => this.length(origin[k] + scale * geometry.surface.vertices[3 * vertex + k]));
    return [
      ['pair', this.text.nameOfPair(pair)],
      ['piece', String(geometry.pieceOfTriangle[triangle])],
      ['point', String(vertex)],
      ['place', place.join(', ')],
      ['distance', this.length(scale * geometry.distances[vertex])],
      ...this.viewer.contactsOf(vertex).map(({site, direction}) =>
        [`towards ${this.text.nameOf(site)}`, direction.map((x) => x.toFixed(4)).join(', ')]),
    ];
  }

  /** Keys, their names, and their actions. */
  keys() {
    const {viewer} = this;
    const click = (id) => () => byId(id).click();
    const turn = (right, up) => () => viewer.turn(right * kStep, up * kStep);
    return [
      [['ArrowLeft'], 'Arrows', 'turn', turn(-1, 0)],
      [['ArrowRight'], null, null, turn(1, 0)],
      [['ArrowUp'], null, null, turn(0, -1)],
      [['ArrowDown'], null, null, turn(0, 1)],
      [['+', '='], '+ and -', 'zoom', () => viewer.turn(0, 0, 1.15)],
      [['-', '_'], null, null, () => viewer.turn(0, 0, 1 / 1.15)],
      [['0', 'r', 'R'], '0 or R', 'reset the view', () => viewer.resetView()],
      ...kLayers.map((name, i) => [[String(i + 1)], i === 0 ? '1 to 4' : null, 'show or hide sites, surface, roadmap, path',
        click(`layer-${name}`)]),
      [['c', 'C'], 'C', 'cut by a plane', click('cut')],
      [['f', 'F'], 'F', 'keep the other side of the cut', click('cut-flip')],
      [['Enter'], 'Enter', 'pick the face in the middle of the picture (keyboard on the picture)', () => {
        const {clientWidth, clientHeight} = viewer.canvas;
        this.choose(viewer.pickAt(clientWidth / 2, clientHeight / 2));
      }, true],
      [['Escape'], 'Escape', 'pick nothing; close what is open', () => this.choose(null)],
      [['h', 'H', '?'], 'H', 'this help', click('open-help')],
    ];
  }

  /** Keys that an element of the form handles itself. */
  ownsKey(target, key, onPictureOnly) {
    if (key === 'Escape') return false;
    if (onPictureOnly) return target !== this.viewer.canvas && target !== document.body;
    if (target.matches('select')) return true;
    return target.matches('input[type=range]') && (key.startsWith('Arrow') || key === '+' || key === '-');
  }
}
