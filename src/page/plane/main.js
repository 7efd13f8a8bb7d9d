// The page of `medial-vk plane --html`.
import {viridisGradient} from '../colours.js';
import {brief, grouped, plain} from '../format.js';
import {fewDiscs, nearestOnAxis, widestOf} from './axis.js';
import {readPlane} from './data.js';
import {Drawing} from './drawing.js';

const element = (id) => document.getElementById(id);
const kReach = 40;  // pixels within which the pointer finds the axis

const plane = readPlane();
const drawing = new Drawing(element('view'), plane);
drawing.discs = fewDiscs(plane, 200);
let branch = -1;

function fillList(list, rows) {
  list.replaceChildren(...rows.flatMap(([name, value]) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  }));
}

function show(here) {
  drawing.here = here;
  element('hint').hidden = here !== null;
  fillList(element('here'), here === null ? [] : [
    ['radius', plain(here.radius)], ['object angle', `${here.angle.toFixed(4)} rad`],
    ['x, y', `${plain(here.x)}, ${plain(here.y)}`], ['branch', `${here.branch} of ${plane.lines.length - 1}`]]);
  drawing.request();
}

function setColour(what) {
  drawing.colourBy(what);
  const [least, greatest] = plane.ranges[what];
  element('legend-title').textContent = what === 'radius' ? 'radius (units of the shape)' : 'object angle (rad)';
  element('legend-least').textContent = brief(least);
  element('legend-greatest').textContent = brief(greatest);
  drawing.request();
}

function zoomBy(factor, x = drawing.size().width / 2, y = drawing.size().height / 2) {
  drawing.zoom(factor, x, y);
  drawing.request();
}

function reset() {
  drawing.fit();
  drawing.request();
}

function step(by) {
  const count = plane.lines.length - 1;
  if (count === 0) return;
  branch = (branch + by + count + (branch < 0 && by < 0 ? 1 : 0)) % count;
  show(widestOf(plane, branch));
}

function listenToPointers() {
  const view = element('view'), pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {distance: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2};
  };
  const placeOf = (event) => {
    const box = view.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  view.addEventListener('pointerdown', (event) => {
    view.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
  });
  for (const name of ['pointerup', 'pointercancel']) {
    view.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  view.addEventListener('pointermove', (event) => {
    const place = placeOf(event), before = pointers.get(event.pointerId);
    if (!before) {
      const [x, y] = drawing.toPlane(place.x, place.y);
      show(nearestOnAxis(plane, x, y, kReach / drawing.scale));
      return;
    }
    const old = pointers.size === 2 ? spread() : null;
    pointers.set(event.pointerId, place);
    if (old) {
      const now = spread();
      drawing.move(now.x - old.x, now.y - old.y);
      drawing.zoom(now.distance / Math.max(old.distance, 1), now.x, now.y);
    } else {
      drawing.move(place.x - before.x, place.y - before.y);
    }
    drawing.request();
  });
  view.addEventListener('wheel', (event) => {
    event.preventDefault();
    const {x, y} = placeOf(event);
    zoomBy(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), x, y);
  }, {passive: false});
}

function listenToKeys() {
  const layers = ['shape', 'axis', 'nodes', 'discs'];
  const moves = {ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40]};
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('select')) return;
    const layer = layers[Number(event.key) - 1];
    if (event.key in moves) {
      drawing.move(...moves[event.key]);
      drawing.request();
    } else if (event.key === '+' || event.key === '=') {
      zoomBy(1.25);
    } else if (event.key === '-') {
      zoomBy(0.8);
    } else if (event.key === '0') {
      reset();
    } else if (event.key === 'n' || event.key === 'p') {
      step(event.key === 'n' ? 1 : -1);
    } else if (layer) {
      element(`layer-${layer}`).click();
    } else {
      return;
    }
    event.preventDefault();
  });
  for (const layer of layers) {
    element(`layer-${layer}`).addEventListener('change', (event) => {
      drawing.layers[layer] = event.target.checked;
      drawing.request();
    });
  }
}

function begin() {
  element('name').textContent = plane.name;
  element('facts').textContent = plane.facts;
  fillList(element('numbers'), plane.numbers.map(([name, value]) => [name, typeof value === 'number' ?
    (Number.isInteger(value) ? grouped(value) : plain(value)) : value]));
  document.querySelector('#legend .bar').style.background = viridisGradient();
  element('colour-by').value = plane.colour;
  element('colour-by').addEventListener('change', (event) => setColour(event.target.value));
  element('reset').addEventListener('click', reset);
  element('closer').addEventListener('click', () => zoomBy(1.4));
  element('farther').addEventListener('click', () => zoomBy(1 / 1.4));
  element('fold').addEventListener('click', () => {
    const isOpen = element('panel').classList.toggle('open');
    element('fold').setAttribute('aria-expanded', String(isOpen));
  });
  listenToPointers();
  listenToKeys();
  new ResizeObserver(() => drawing.request()).observe(element('view'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => drawing.request());
  setColour(plane.colour);
  window.medialVk = {plane, drawing, show, step};
  // For tests: the page has been drawn.
  requestAnimationFrame(() => requestAnimationFrame(() => {
    Object.assign(document.documentElement.dataset, {ready: Math.ceil(performance.now()), complete: ''});
  }));
}

begin();
