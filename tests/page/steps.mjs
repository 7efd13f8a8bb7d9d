// Actions and queries that the tests of the page repeat.
import assert from 'node:assert/strict';

import {lShape} from './fixtures.mjs';
import * as inPage from './in_page.mjs';

export const kLayers = ['mesh', 'balls', 'points', 'spokes', 'sheets'];
export const kSmall = ['--resolution', '30'];

export const evaluateInPage = (page, name) => page.evaluate(`(${inPage[name]})()`);
export const look = (page) => evaluateInPage(page, 'look');
export const grouped = (n) => n.toLocaleString('en-US');

/** Asserts that the page caused no message and no request. */
export function assertQuiet(page) {
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, []);
}

export async function openPart({workshop, browser}, {mesh = lShape(), options = kSmall, ...size} = {}) {
  const points = workshop.make(mesh, options);
  const page = await browser.open(size);
  await page.load(workshop.url('page.html'));
  return {points, page};
}

export const focus = (page, id) => page.evaluate(`document.getElementById('${id}').focus()`);
export const checked = (page, id) => page.evaluate(`document.getElementById('${id}').checked`);

export async function show(page, layers) {
  for (const layer of kLayers) {
    if (await checked(page, `layer-${layer}`) !== layers.includes(layer)) await page.clickElement(`layer-${layer}`);
  }
}

export async function selectOption(page, id, value) {
  await page.evaluate(`{ const e = document.getElementById('${id}'); e.value = '${value}';
    e.dispatchEvent(new Event('input', {bubbles: true})); e.dispatchEvent(new Event('change', {bubbles: true})); }`);
}

/** The values of the picked ball, by name. */
export async function pickedValues(page) {
  return page.evaluate(`(() => { const list = document.getElementById('picked-values'); if (list.hidden) return null;
    return Object.fromEntries([...list.querySelectorAll('dt')].map((dt) => [dt.textContent,
      dt.nextSibling.textContent])); })()`);
}

export const numbersIn = (text) => text.match(/-?\d+(\.\d+)?(e[-+]?\d+)?/g).map(Number);

export function assertNear(actual, expected, tolerance) {
  assert.equal(actual.length, expected.length);
  actual.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) <= tolerance, `${actual} is not ${expected}`));
}

/** Asserts that the panel shows the values of the PLY for a point; lengths to single precision of the model's size. */
export function assertSame(values, point, size) {
  assertNear(numbersIn(values.centre), point.centre, 2e-7 * size + 1e-6);
  assertNear(numbersIn(values.radius), [point.radius], 2e-7 * size + 1e-6);
  assertNear([numbersIn(values['object angle'])[0]], [point.angle], 6e-7);
  assertNear(numbersIn(values.flux), [point.flux], 6e-7);
  assert.equal(numbersIn(values.sheet)[0], point.sheet);
  assert.deepEqual(numbersIn(values.voxel), point.voxel);
  assertNear(numbersIn(values['spoke a']), point.spokes[0], 1e-4);
  assertNear(numbersIn(values['spoke b']), point.spokes[1], 1e-4);
}

/** Positions of some points on the screen. */
export const project = (page, i) => page.evaluate(`(() => { const {left, top} = document.getElementById('view')
  .getBoundingClientRect(); const [x, y] = medialVk.viewer.project(${i}); return [left + x, top + y]; })()`);
