// Steps of the tests of the page of a motion.
import assert from 'node:assert/strict';

import {numbersIn} from './steps.mjs';

/** Makes a page and opens it; the result has the page, and the numbers in its file. */
export async function openMotion({workshop, browser}, options = [], size = {}) {
  workshop.run('page.html', 'frames=12', 'balls=30', ...options);
  const text = workshop.read('page.html').toString();
  const motion = JSON.parse(text.match(/id="motion">(.*?)<\/script>/s)[1]);
  const page = await browser.open(size);
  await page.load(workshop.url('page.html'));
  return {page, motion};
}

export const frameOf = (page) => page.evaluate('medialVk.player.frame');
export const isPlaying = (page) => page.evaluate('medialVk.player.playing');

/** The numbers of the present frame, by name. */
export const numbersShown = (page) => page.evaluate(`Object.fromEntries([...document.querySelectorAll('#numbers dt')].map((dt) =>
  [dt.textContent, dt.nextSibling.textContent]))`);

export const moveSlider = (page, value) => page.evaluate(`{ const e = document.getElementById('time'); e.value = ${value};
  e.dispatchEvent(new Event('input', {bubbles: true})); }`);

/** Asserts that the panel shows the numbers of the file. */
export async function assertNumbers(page, motion, number) {
  const shown = await numbersShown(page), frame = motion.frames[number];
  assert.equal(shown.frame, String(number));
  assert.equal(shown.name, frame.name);
  assert.ok(Math.abs(numbersIn(shown.time)[0] - frame.time) <= 5e-4, shown.time);
  assert.ok(Math.abs(numbersIn(shown.uncovered)[0] - frame.uncovered) <= 1e-4 * frame.uncovered, shown.uncovered);
  for (const state of ['medial', 'flat', 'shrunk', 'lost']) assert.equal(shown[state], String(frame[state]), state);
  return shown;
}

export const tableRows = (page) => page.evaluate(`[...document.querySelectorAll('#frames-body tbody tr')].map((row) =>
  [...row.cells].map((cell) => cell.textContent))`);
