// The initial direction of view, and the position of the model in the picture.
import assert from 'node:assert/strict';

import {lShape} from './fixtures.mjs';
import * as inPage from './in_page.mjs';

const evaluateInPage = (page, name) => page.evaluate(`(${inPage[name]})()`);

export const viewTests = {
  /** With --up the model is upright at first, and the control turns it for every axis as that option does. */
  async up({workshop, browser}) {
    const points = workshop.make(lShape(), ['--resolution', '30', '--up', 'z']);
    const page = await browser.open();
    await page.load(workshop.url('page.html'));
    assert.equal(await page.evaluate("document.getElementById('up').value"), 'z');
    const axes = ['x', 'y', 'z', '-x', '-y', '-z'];
    const marks = new Set();
    for (const up of axes) {
      await page.evaluate(`{ const e = document.getElementById('up'); e.value = '${up}';
        e.dispatchEvent(new Event('change')); }`);
      const axis = 'xyz'.indexOf(up.at(-1)), sign = up.length === 1 ? 1 : -1;
      const by = (i) => sign * points[i].centre[axis];
      const order = points.map((_, i) => i).sort((i, j) => by(i) - by(j));
      const heights = await page.evaluate(`[${order[0]}, ${order.at(-1)}].map((i) => medialVk.viewer.model.localToWorld(
        medialVk.viewer.camera.position.clone().set(...medialVk.viewer.centre(i))).y)`);
      assert.ok(heights[1] > heights[0] + 0.1, `${up}: ${heights}`);
      marks.add((await evaluateInPage(page, 'look')).mark);
    }
    assert.equal(marks.size, axes.length);
    assert.deepEqual([page.complaints, page.requests], [[], []]);
  },

  /** On a narrow screen the legend takes a strip at the bottom, and the model fills the remaining area, centred. */
  async in_the_middle({workshop, browser}) {
    workshop.make(lShape([3, 0, 0]), ['--resolution', '30']);
    for (const size of [{}, {width: 360, height: 740, phone: true}, {width: 360, height: 300, phone: true}]) {
      const page = await browser.open(size);
      await page.load(workshop.url('page.html'));
      const {bounds: [left, bottom, right, top], strip} = await evaluateInPage(page, 'modelBounds');
      assert.equal(strip > 0, Boolean(size.phone));
      assert.ok(Math.abs(left + right) < 0.01, `${left} to ${right}`);
      assert.ok(Math.abs(top - 1 + (bottom + 1 - strip)) < 0.01, `${bottom} to ${top}, strip ${strip}`);
      const filled = Math.max((right - left) / 2, (top - bottom) / (2 - strip));
      assert.ok(filled > 0.84 && filled < 0.92, `${filled}`);
      assert.deepEqual([page.complaints, page.requests], [[], []]);
    }
  },
};
