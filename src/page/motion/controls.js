// The form beside the picture, the time below it, and the keys.
import {sheetColour, kSheetColours, viridisGradient} from '../colours.js';
import {brief, grouped, plain} from '../format.js';
import {bindDialogs, bindFold, bindKeys, byId, element, followTheme, rows, tableOf} from '../page_parts.js';
import {isCover, statesOf} from './balls.js';
import {Curve} from './curve.js';
import {kEnds, Player} from './player.js';

const kStep = Math.PI / 36;  // One press of a key.
const kSpeeds = [0.25, 0.5, 1, 2, 4];
const kUsualRate = 24;       // Frames a second, if the record has none.
const kLayers = ['mesh', 'balls'];
// Milliseconds between two texts while the motion plays: more often they could not be read, and where the CPU draws,
// they take as long as the picture.
const kBetweenWords = 125;

const percent = (x) => (x === null ? 'not known' : `${plain(Number(x.toPrecision(5)))} %`);
const seconds = (x) => (x === null ? 'not known' : `${x.toFixed(3)} s`);
const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;

/** What the curve shows: its name, which is also that of the numbers in the file, and a sentence. */
const errorOf = (motion) => (isCover(motion)
  ? {name: 'added', sentence: "The volume of the balls outside of the solid, over that of the solid, by frame."}
  : {name: 'uncovered', sentence: "The share of the solid's volume that no ball holds, by frame."});

const columnsOfCover = [
  ['added', true, (frame) => percent(frame.added)],
  ['reach out, at most', true, (frame) => (frame.reach_out === null ? 'not measured' : brief(frame.reach_out))],
  ['covered', false, (frame) => (frame.solid ? 'the solid' : 'the surface')],
];

function columnsOfInside(motion) {
  const gap = (frame) => (frame.gap === null ? 'not measured' : frame.gap.map((x) => brief(x)).join(' to '));
  return [
    ['uncovered', true, (frame) => percent(frame.uncovered)],
    ...(motion.rule === 'published' ? [['outside, at most', true, (frame) => percent(frame.outside)]] : []),
    ['greatest gap', true, gap],
  ];
}

/** The columns of the table of frames and the rows of the present one: a name, whether it is a number, and its text. */
function columnsOf(motion) {
  return [
    ['frame', true, (frame, i) => String(i)],
    ['name', false, (frame) => frame.name],
    ['time', true, (frame) => seconds(frame.time)],
    ...(isCover(motion) ? columnsOfCover : columnsOfInside(motion)),
    ...statesOf(motion).map(({name}) => [name, true, (frame) => grouped(frame[name])]),
    ...(motion.frames[0].renewed === undefined ? [] : [['chosen anew', true, (frame) => grouped(frame.renewed)]]),
  ];
}

/** What is proved in each frame. */
function proofOf(motion) {
  if (motion.rule === 'published') return 'By the published rule: a ball may reach out of the mesh by a given distance';
  if (!isCover(motion)) return 'Each ball is proved to lie inside the mesh of its frame';
  if (motion.frames.every(({solid}) => solid)) return 'The balls are proved to cover the solid of each frame';
  return 'The balls are proved to cover the surface of each frame, and the solid where the numbers say so';
}

/** Numbers, and what is said about them, without a drawing. */
export class MotionText {
  constructor(motion) {
    this.motion = motion;
    this.columns = columnsOf(motion);
  }

  describe() {
    const {name, balls, triangles, frames, closed} = this.motion;
    byId('name').textContent = name;
    byId('facts').textContent = `${grouped(balls)} balls, ${grouped(triangles)} triangles, ${grouped(frames.length)} frames`;
    byId('proof').textContent = `${proofOf(this.motion)}; nothing between two frames is certified, so balls jump from frame `
      + 'to frame.';
    const {name: error, sentence} = errorOf(this.motion);
    byId('curve-meaning').textContent = sentence;
    byId('no-volume').textContent = `The mesh is not closed, or its faces cross, so the ${error} volume is not known.`;
    byId('no-volume').hidden = closed;
    rows(byId('states'), statesOf(this.motion).map(({name: state, what}) => [state, what]));
  }

  /** Fills the table; of long motions this takes a while. */
  makeTable() {
    if (this.hasTable) return;
    this.hasTable = true;
    const {frames, version, rule} = this.motion;
    const distance = isCover(this.motion)
      ? 'The balls reach out of the solid by no more than the distance given, in units of the mesh.'
      : 'The gap is the greatest distance from a point of the surface to the balls, in units of the mesh.';
    byId('frames-body').append(
      element('p', `Made by medial-vk ${version}, rule ${rule}. ${distance}`),
      tableOf(this.columns.map(([name, number]) => ({name, number})),
        frames.map((frame, i) => this.columns.map(([, , text]) => text(frame, i)))));
  }

  showNumbers(number) {
    const {frames} = this.motion;
    const texts = this.columns.map(([, , text]) => text(frames[number], number));
    if (!this.values) {
      rows(byId('numbers'), this.columns.map(([name], i) => [name, texts[i]]));
      this.values = [...byId('numbers').querySelectorAll('dd')];
    }
    // While a motion plays, only what differs is laid out again.
    texts.forEach((text, i) => { if (this.values[i].textContent !== text) this.values[i].textContent = text; });
  }
}

export class MotionControls {
  constructor(viewer, motion, text) {
    this.viewer = viewer;
    this.motion = motion;
    this.text = text;
    this.said = 0;  // When texts were changed last.
  }

  start() {
    const {viewer, motion} = this;
    this.player = new Player(motion.shown, (frame) => this.showFrame(frame), () => this.showState());
    const {name} = errorOf(motion);
    this.curve = new Curve(name, motion.frames.map((frame) => frame[name]), (number) => this.seek(number));
    this.prepareTime();
    this.bind();
    bindKeys(this.keys(), (...of) => this.ownsKey(...of));
    bindDialogs(['frames', 'help'], {frames: () => this.text.makeTable()});
    followTheme(viewer);
    byId('up').value = motion.up;
    viewer.setUp(motion.up);
    if (isCover(motion)) {
      // The balls are around the mesh, which is seen through them.
      byId('opacity').value = 100;
      byId('ball-slider').hidden = false;
    }
    this.refreshOpacity();
    this.refreshColour();
    for (const name of kLayers) viewer.showLayer(name, byId(`layer-${name}`).checked);
    this.player.seek(motion.shown[0]);
    this.showState();
  }

  prepareTime() {
    const {frames, shown, frames_per_second: recorded} = this.motion;
    const rate = recorded > 0 ? recorded : kUsualRate;
    byId('time').max = frames.length - 1;
    byId('speed').replaceChildren(...kSpeeds.map((speed) => {
      const what = speed === 1 && recorded > 0 ? ' (recorded)' : '';
      const option = element('option', `${Number((speed * rate).toPrecision(4))} frames/s${what}`);
      option.value = String(speed * rate);
      option.selected = speed === 1;
      return option;
    }));
    this.player.rate = rate;
    this.player.setEnd(byId('at-end').value);
    for (const id of ['play', 'time', 'previous', 'next', 'speed', 'at-end']) byId(id).disabled = shown.length < 2;
    // The text of the last frame is the widest, so that nothing moves while the motion plays.
    byId('clock').textContent = this.clockText(frames.length - 1);
    byId('clock').style.minWidth = `${Math.ceil(byId('clock').getBoundingClientRect().width)}px`;
  }

  clockText(frame) {
    const {frames} = this.motion;
    return `frame ${frame} of ${frames.length - 1}, ${seconds(frames[frame].time)}`;
  }

  bind() {
    const {viewer, player} = this;
    for (const name of kLayers) {
      byId(`layer-${name}`).addEventListener('change', (event) => viewer.showLayer(name, event.target.checked));
    }
    for (const id of ['opacity', 'ball-opacity']) byId(id).addEventListener('input', () => this.refreshOpacity());
    byId('colour-by').addEventListener('input', () => this.refreshColour());
    byId('up').addEventListener('change', (event) => viewer.setUp(event.target.value));
    byId('reset').addEventListener('click', () => viewer.resetView());
    byId('controls').addEventListener('submit', (event) => event.preventDefault());
    byId('play').addEventListener('click', () => player.toggle());
    byId('previous').addEventListener('click', () => player.step(-1));
    byId('next').addEventListener('click', () => player.step(1));
    byId('time').addEventListener('input', (event) => this.seek(Number(event.target.value)));
    byId('speed').addEventListener('input', (event) => { player.rate = Number(event.target.value); });
    byId('at-end').addEventListener('input', (event) => player.setEnd(event.target.value));
    bindFold();
  }

  /** Shows the frame nearest to a number of all frames. */
  seek(number) {
    const {player} = this;
    const below = player.indexOf(number);
    const above = Math.min(below + 1, player.shown.length - 1);
    player.seek(player.shown[player.shown[above] - number < number - player.shown[below] ? above : below]);
    byId('time').value = player.frame;
  }

  showFrame(frame) {
    this.viewer.showFrame(this.player.indexOf(frame));
    const now = performance.now();
    const due = !this.player.playing || now - this.said > kBetweenWords;
    if (due || !this.viewer.isSlow) this.showPlace(frame);
    if (!due) return;
    this.said = now;
    this.sayFrame(frame);
  }

  /** The slider and the cursor of the curve. */
  showPlace(frame) {
    this.curve.moveTo(frame);
    byId('time').value = frame;
  }

  sayFrame(frame) {
    const {frames, shown} = this.motion;
    this.text.showNumbers(frame);
    byId('time').setAttribute('aria-valuetext', `frame ${frame}, ${seconds(frames[frame].time)}`);
    byId('clock').textContent = this.clockText(frame);
    byId('previous').disabled = frame === shown[0];
    byId('next').disabled = frame === shown[shown.length - 1];
  }

  showState() {
    const {playing} = this.player;
    byId('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
    byId('icon-play').toggleAttribute('hidden', playing);
    byId('icon-pause').toggleAttribute('hidden', !playing);
    this.viewer.setMoving(playing);
    if (playing) return;
    this.showPlace(this.player.frame);
    this.sayFrame(this.player.frame);
  }

  refreshOpacity() {
    const share = Number(byId('opacity').value);
    byId('opacity-value').textContent = `${share} %`;
    this.viewer.setOpacity(share / 100);
    if (!isCover(this.motion)) return;
    const ofBalls = Number(byId('ball-opacity').value);
    byId('ball-opacity-value').textContent = `${ofBalls} %`;
    this.viewer.setBallOpacity(ofBalls / 100);
  }

  refreshColour() {
    const by = byId('colour-by').value;
    this.viewer.setColour(by);
    const title = {state: 'state of the ball', ball: 'number of the ball', radius: 'radius (units of the mesh)'}[by];
    byId('legend').replaceChildren(element('p', title), ...(by === 'radius' ? this.bar() : this.swatches(by)));
  }

  bar() {
    const greatest = this.viewer.balls.greatest * this.motion.scale;
    const bar = element('div'), ends = element('div', null, element('span', '0'), element('span', brief(greatest)));
    bar.className = 'bar';
    bar.style.background = viridisGradient();
    ends.className = 'ends';
    return [bar, ends];
  }

  swatches(by) {
    const item = (colour, name) => {
      const swatch = element('i');
      swatch.style.background = colour;
      return element('li', null, swatch, name);
    };
    if (by === 'state') return [element('ul', null, ...statesOf(this.motion).filter(({colour}) => colour).map(({name, colour}) => item(css(colour), name)))];
    const count = Math.min(this.motion.balls, kSheetColours);
    const more = this.motion.balls > count ? [element('li', 'and so on')] : [];
    return [element('ul', null, ...Array.from({length: count}, (_, i) => item(sheetColour(i), String(i))), ...more)];
  }

  /** Keys, their names, and their actions. */
  keys() {
    const {viewer, player} = this;
    const click = (id) => () => byId(id).click();
    const turn = (right, up) => viewer.turn(right * kStep, up * kStep);
    return [
      [[' '], 'Space', 'play or pause', () => player.toggle()],
      [['ArrowLeft'], 'Left, right', 'the frame before or after',
        (event) => { if (event.shiftKey) turn(-1, 0); else player.step(-1); }],
      [['ArrowRight'], null, null, (event) => { if (event.shiftKey) turn(1, 0); else player.step(1); }],
      [['Home'], 'Home, End', 'the first or last frame', () => player.seek(player.first)],
      [['End'], null, null, () => player.seek(player.last)],
      [['ArrowUp'], 'Up, down', 'turn', () => turn(0, -1)],
      [['ArrowDown'], null, null, () => turn(0, 1)],
      [[], 'Shift + left, right', 'turn'],
      [['+', '='], '+ and -', 'zoom', () => viewer.turn(0, 0, 1.15)],
      [['-', '_'], null, null, () => viewer.turn(0, 0, 1 / 1.15)],
      [['0', 'r', 'R'], '0 or R', 'reset the view', () => viewer.resetView()],
      ...kLayers.map((name, i) => [[String(i + 1)], i === 0 ? '1, 2' : null, 'show or hide mesh, balls', click(`layer-${name}`)]),
      [['l', 'L'], 'L', 'at the end: start again, go back, or stop', () => this.nextEnd()],
      [['Escape'], 'Escape', 'close what is open', () => {}],
      [['h', 'H', '?'], 'H', 'this help', click('open-help')],
    ];
  }

  nextEnd() {
    const ends = byId('at-end');
    ends.value = kEnds[(kEnds.indexOf(ends.value) + 1) % kEnds.length];
    this.player.setEnd(ends.value);
  }

  /** Keys that an element of the form handles itself. */
  ownsKey(target, key) {
    if (key === 'Escape') return false;
    if (target.matches('select')) return true;
    if (key === ' ') return target.matches('button, input[type=checkbox]');
    if (!target.matches('input[type=range]') || target === byId('time')) return false;
    return key.startsWith('Arrow') || key === 'Home' || key === 'End' || key === '+' || key === '-';
  }
}
