// The page of a cover in motion: run.mjs runs the test as motion_cover.
import assert from 'node:assert/strict';

import {moveSlider, numbersShown, openMotion} from './motion_steps.mjs';
import {assertQuiet, look, numbersIn} from './steps.mjs';

export const motionCoverTests = {
  /** A cover has a curve, numbers and states of its own, and each drawn ball holds the one of the record. */
  async cover(context) {
    const {page, motion} = await openMotion(context, ['rule=cover', 'motion=twist', 'raw=raw']);
    assert.match(await page.text('proof'), /^The balls are proved to cover the solid of each frame; nothing between/);
    assert.match(await page.text('legend'), /^state of the ball\s*steady\s*grown$/);
    assert.equal(await page.text('curve-name'), 'added');
    const raw = new Float64Array(new Uint8Array(context.workshop.read('raw')).buffer);
    const size = 3 * motion.vertices + 4 * motion.balls;
    const {lower, upper, scale} = motion;
    for (const number of [0, 7, 3]) {
      await moveSlider(page, number);
      const shown = await numbersShown(page), frame = motion.frames[number];
      assert.ok(Math.abs(numbersIn(shown.added)[0] - frame.added) <= 1e-4 * frame.added, shown.added);
      const reach = numbersIn(shown['reach out, at most'])[0];
      assert.ok(Math.abs(reach - frame.reach_out) <= 5e-3 * frame.reach_out, shown['reach out, at most']);
      assert.equal(shown.covered, 'the solid');
      for (const state of ['steady', 'grown', 'unused']) assert.equal(shown[state], String(frame[state]), state);
      assert.equal(shown.uncovered, undefined);
      const balls = await page.evaluate('Array.from(medialVk.viewer.balls.places.image.data)');
      for (let i = 0; i < motion.balls; ++i) {
        const ball = raw.subarray(number * size + 3 * motion.vertices + 4 * i, number * size + 3 * motion.vertices + 4 * i + 4);
        const away = [0, 1, 2].map((k) => (lower[k] + upper[k]) / 2 + balls[4 * i + k] * scale - ball[k]);
        const radius = balls[4 * i + 3] * scale;
        if (ball[3] === 0) {
          assert.equal(radius, 0, `${number} ${i}: unused`);
          continue;
        }
        assert.ok(radius >= Math.hypot(...away) + ball[3] - 1e-14, `${number} ${i}: ${radius}, not above ${ball[3]}`);
        assert.ok(radius <= ball[3] + 1e-6 * scale, `${number} ${i}: ${radius}, far above ${ball[3]}`);
      }
    }
    // The mesh is seen through the balls, unless they are opaque.
    const through = await look(page);
    await page.evaluate(`{ const e = document.getElementById('ball-opacity'); e.value = 100;
      e.dispatchEvent(new Event('input', {bubbles: true})); }`);
    const opaque = await look(page);
    assert.notEqual(opaque.mark, through.mark);
    await page.clickElement('layer-mesh');
    assert.equal((await look(page)).mark, opaque.mark, 'opaque balls hide the mesh');
    await page.clickElement('open-help');
    assert.match(await page.text('curve-meaning'), /outside of the solid/);
    assertQuiet(page);
  },
};
