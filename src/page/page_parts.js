// What the programs of all pages do with their elements: lists, keys, dialogs, the theme, and the start.

export const byId = (id) => document.getElementById(id);

/** Fills a list with names and values. */
export function rows(list, pairs) {
  list.replaceChildren(...pairs.flatMap(([name, value]) => {
    const dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.textContent = name;
    dd.textContent = value;
    return [dt, dd];
  }));
}

export function element(tag, text, ...children) {
  const made = document.createElement(tag);
  if (text !== undefined && text !== null) made.textContent = text;
  made.append(...children);
  return made;
}

/** A table that scrolls by itself: `columns` have a `name` and `number`, whether they hold numbers; `lines` have a text
 * for each column. */
export function tableOf(columns, lines) {
  const cell = (tag, text, {number}) => Object.assign(element(tag, text), number ? {className: 'number'} : {});
  const head = element('tr', null, ...columns.map((column) => Object.assign(cell('th', column.name, column), {scope: 'col'})));
  const body = lines.map((line) => element('tr', null, ...columns.map((column, i) => cell('td', line[i], column))));
  const wide = element('div', null, element('table', null, element('thead', null, head), element('tbody', null, ...body)));
  wide.className = 'wide';
  wide.tabIndex = 0;
  return wide;
}

/** `keys`: names of keys, their name in the help or null, what they do, the action, and whether only with the keyboard
 * on the picture. `owns(target, key, onPictureOnly)`: keys that an element of the form handles itself. */
export function bindKeys(keys, owns) {
  rows(byId('keys'), keys.filter(([, name]) => name).map(([, name, what]) => [name, what]));
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    const found = keys.find(([names]) => names.includes(event.key));
    if (!found || owns(event.target, event.key, found[4])) return;
    event.preventDefault();
    found[3](event);
  });
}

export function bindDialogs(names, opened = {}) {
  for (const name of names) {
    const dialog = byId(`${name}-dialog`);
    byId(`open-${name}`).addEventListener('click', () => {
      opened[name]?.();
      dialog.showModal();
    });
    dialog.querySelector('[data-close]').addEventListener('click', () => dialog.close());
    // A click outside it.
    dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
  }
}

const kClick = 4;  // Pixels that the mouse may move in a click.

/** Calls `click` with the place of every click on the canvas, in CSS pixels from its corner. */
export function onClick(canvas, click) {
  let down = null;
  canvas.addEventListener('pointerdown', (event) => { down = event.button === 0 ? [event.clientX, event.clientY] : null; });
  canvas.addEventListener('pointerup', (event) => {
    const moved = down ? Math.hypot(event.clientX - down[0], event.clientY - down[1]) : Infinity;
    down = null;
    if (moved > kClick) return;
    const {left, top} = canvas.getBoundingClientRect();
    click(event.clientX - left, event.clientY - top);
  });
}

/** On a narrow screen the controls are folded away. */
export function bindFold() {
  byId('fold').addEventListener('click', () => {
    const open = byId('panel').classList.toggle('open');
    byId('fold').setAttribute('aria-expanded', String(open));
  });
}

export function followTheme(viewer) {
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const follow = () => viewer.setTheme(dark.matches ? 'dark' : 'light');
  dark.addEventListener('change', follow);
  follow();
}

/** The canvas and its context of WebGL 2, or null as context. */
export function openCanvas() {
  const canvas = byId('view');
  const context = canvas.getContext('webgl2', {antialias: false, alpha: true, depth: true});
  canvas.addEventListener('webglcontextlost', () => {
    byId('sentence').textContent = 'The graphics device was lost; the picture comes back when it does.';
    byId('sentence').hidden = false;
  });
  canvas.addEventListener('webglcontextrestored', () => { byId('sentence').hidden = true; });
  return {canvas, context};
}

/** Replaces the drawing by an element, with a sentence that says why. */
export function showInstead(sentence, instead) {
  document.body.classList.add('no-drawing');
  byId('sentence').textContent = sentence;
  byId('sentence').hidden = false;
  byId('stage').append(instead);
  markReady();
  markComplete();
}

/** `data-ready` is the time to the first frame, in milliseconds since the request of the page; `data-complete` is set
 * when nothing remains to be added. */
export function markReady(viewer = null) {
  viewer?.finish();
  document.documentElement.dataset.ready = Math.round(performance.now());
}

export function markComplete() {
  document.documentElement.dataset.complete = '';
}
