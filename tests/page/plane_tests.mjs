// The properties of the page of a shape in the plane, each as a test: run.mjs runs one of them, as plane_NAME.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';

import {assertQuiet, selectOption} from './steps.mjs';

/** A plate of 3 x 1.5 with its corner at (10, 20), and its page. */
async function openPlate({workshop, browser}, {name = 'plate.csv', options = [], ...size} = {}) {
  workshop.write(name, 'x,y\n10,20\n13,20\n13,21.5\n10,21.5\n');
  const run = spawnSync(workshop.tool, ['plane', name, '-q', '-o', 'axis.json', '--html', 'page.html', ...options],
    {cwd: workshop.folder, encoding: 'utf8'});
  if (run.status !== 0) throw new Error(run.stderr);
  const page = await browser.open(size);
  await page.load(workshop.url('page.html'));
  return page;
}

/** Where a point of the plane lies in the window. */
const placeOf = (page, x, y) => page.evaluate(`(() => { const {drawing} = medialVk, {width, height} = drawing.size();
  const box = drawing.canvas.getBoundingClientRect();
  return [box.left + width / 2 + (${x} - drawing.middle[0]) * drawing.scale,
    box.top + height / 2 + drawing.flip * (${y} - drawing.middle[1]) * drawing.scale]; })()`);

const shown = (page) => page.evaluate(`Object.fromEntries([...document.querySelectorAll('#here dt')].map((e) =>
  [e.textContent, e.nextElementSibling.textContent]))`);

async function pointAt(page, x, y) {
  await page.mouse('mouseMoved', ...await placeOf(page, x, y));
  return shown(page);
}

export const planeTests = {
  async pointer(context) {
    const page = await openPlate(context);
    assert.equal(await page.text('name'), 'plate.csv');
    assert.equal(await page.evaluate('document.title'), 'plate.csv - medial axis');
    assert.match(await page.text('facts'), /^4 segments, CSV$/);
    // In the middle the radius is 0.75 everywhere; towards a corner it falls, from 0.75 to 0 at (10, 20).
    const middle = await pointAt(page, 11.6, 20.8);
    assert.ok(Math.abs(Number(middle.radius) - 0.75) < 1e-6, middle.radius);
    assert.match(middle['object angle'], /^1\.5708 rad$/);
    const corner = await pointAt(page, 10.3, 20.3);
    assert.ok(Math.abs(Number(corner.radius) - 0.3) < 0.01, corner.radius);
    assert.match(corner['object angle'], /^0\.7854 rad$/);
    // Far from the axis, nothing.
    assert.deepEqual(await pointAt(page, 11.5, 20.05), {});
    assertQuiet(page);
  },

  async moves_and_zooms(context) {
    const page = await openPlate(context);
    const at = (await placeOf(page, 11, 20.5)).map(Math.round);  // events have whole pixels
    const inPlane = () => page.evaluate(`(() => { const box = medialVk.drawing.canvas.getBoundingClientRect();
      return medialVk.drawing.toPlane(${at[0]} - box.left, ${at[1]} - box.top); })()`);
    const before = await inPlane();
    const scale = await page.evaluate('medialVk.drawing.scale');
    await page.evaluate(`medialVk.drawing.canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -400, clientX: ${at[0]},
      clientY: ${at[1]}, cancelable: true}))`);
    assert.ok(await page.evaluate('medialVk.drawing.scale') > 1.5 * scale);
    const after = await inPlane();
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 1e-9, `${before} ${after}`);
    await page.clickElement('reset');
    assert.equal(await page.evaluate('medialVk.drawing.scale'), scale);
    await page.clickElement('closer');
    assert.ok(await page.evaluate('medialVk.drawing.scale') > scale);
    assertQuiet(page);
  },

  async colours_and_layers(context) {
    const page = await openPlate(context, {options: ['--colour', 'angle']});
    assert.match(await page.text('legend-title'), /^object angle/);
    assert.equal(await page.text('legend-least'), '0.6');
    await selectOption(page, 'colour-by', 'radius');
    assert.match(await page.text('legend-title'), /^radius/);
    assert.equal(await page.text('legend-greatest'), '0.75');
    // The pixel in the middle is a colour of the axis; without it, the glass.
    const pixel = async () => {
      const [x, y] = await placeOf(page, 11.5, 20.75);
      return page.evaluate(`(() => { const {drawing} = medialVk, box = drawing.canvas.getBoundingClientRect(), ratio = devicePixelRatio;
        drawing.draw(); const copy = new OffscreenCanvas(drawing.canvas.width, drawing.canvas.height);
        const context = copy.getContext('2d', {willReadFrequently: true}); context.drawImage(drawing.canvas, 0, 0);
        return Array.from(context.getImageData(Math.floor((${x} - box.left) * ratio),
          Math.floor((${y} - box.top) * ratio), 1, 1).data); })()`);
    };
    const [r, g, b] = await pixel();
    assert.ok(r > 200 && g > 200 && b < 100, `${r} ${g} ${b}`);
    await page.clickElement('layer-axis');
    const without = await pixel();
    assert.ok(without[2] > 200, `${without}`);
    assertQuiet(page);
  },

  async strange_names(context) {
    const name = '<b>&"strange".csv';
    const page = await openPlate(context, {name});
    assert.equal(await page.text('name'), name);
    assertQuiet(page);
  },

  async phone(context) {
    const page = await openPlate(context, {width: 360, height: 740, phone: true, scale: 2});
    assert.ok(!await page.evaluate("document.getElementById('colour-by').checkVisibility()"));
    await page.clickElement('fold');
    assert.ok(await page.evaluate("document.getElementById('colour-by').checkVisibility()"));
    assert.ok(await page.evaluate('document.documentElement.scrollWidth <= innerWidth'));
    assertQuiet(page);
  },
};
