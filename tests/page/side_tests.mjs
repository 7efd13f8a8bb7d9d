// The page of a run on both sides of the mesh.
import assert from 'node:assert/strict';

import {lShape} from './fixtures.mjs';
import {assertQuiet, grouped, look, numbersIn, pickedValues, selectOption, show} from './steps.mjs';

async function openSides({workshop, browser}, side) {
  workshop.write('part.obj', lShape());
  workshop.run('./part.obj', '-o', 'points.json', '--html', 'page.html', '--report', 'report.json', '--backend', 'cpu', '-q',
    '--resolution', '20', '--side', side, '--margin', '30%');
  const page = await browser.open();
  await page.load(workshop.url('page.html'));
  return {page, points: JSON.parse(workshop.read('points.json')).points, report: JSON.parse(workshop.read('report.json'))};
}

const visible = (page, id) => page.evaluate(`document.getElementById('${id}').checkVisibility()`);

export const sideTests = {
  /** The filter shows the points of one side, a picked point names its side, and colours tell the sides apart. */
  async both_sides(context) {
    const {page, points, report} = await openSides(context, 'both');
    const inside = points.filter(({side}) => side === 'inside').length, outside = points.length - inside;
    assert.ok(inside > 0 && outside > 0);
    assert.deepEqual(report.sides.map(({points: count}) => count), [inside, outside]);
    await show(page, ['points']);
    const both = await look(page);
    const counts = {both: points.length, inside, outside};
    const shares = {};
    for (const side of ['inside', 'outside', 'both']) {
      await selectOption(page, 'side', side);
      assert.equal(await page.text('count'), `${grouped(counts[side])} of ${grouped(points.length)} points shown`);
      shares[side] = (await look(page)).share;
    }
    assert.ok(shares.inside > 0 && shares.outside > 0);
    assert.ok(shares.inside < both.share && shares.outside < both.share, JSON.stringify(shares));
    assert.equal((await look(page)).mark, both.mark);

    // The next point of the outside is the first behind those inside.
    await selectOption(page, 'side', 'outside');
    await page.press(']');
    assert.equal((await pickedValues(page)).side, 'outside');
    assert.equal(numbersIn((await pickedValues(page)).point)[0], inside);
    await selectOption(page, 'side', 'inside');
    await page.press('Escape');
    await page.press(']');
    assert.equal((await pickedValues(page)).side, 'inside');
    await page.press('Escape');

    // One colour for each side: orange inside, blue outside.
    await selectOption(page, 'colour-by', 'side');
    assert.match(await page.text('legend'), /inside.*outside/);
    const warmth = async (side) => {
      await selectOption(page, 'side', side);
      return page.evaluate(`(() => { const {viewer} = window.medialVk; viewer.drawNow(false);
        const gl = viewer.renderer.getContext(); let sum = 0;
        const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        for (let i = 0; i < bytes.length; i += 4) if (bytes[i + 3] === 255) sum += bytes[i] - bytes[i + 2];
        return sum; })()`);
    };
    assert.ok(await warmth('inside') > 0);
    assert.ok(await warmth('outside') < 0);
    const text = await page.evaluate(`document.getElementById('report-body').textContent`);
    assert.ok(text.includes(`inside${inside}`) && text.includes(`outside${outside}`), text);
    assertQuiet(page);
  },

  /** A page of one side offers no choice of sides. */
  async one_side(context) {
    const {page, points} = await openSides(context, 'outside');
    assert.ok(points.length > 0);
    assert.ok(!await visible(page, 'offer-side'));
    assert.equal(await page.text('count'), `${grouped(points.length)} of ${grouped(points.length)} points shown`);
    assertQuiet(page);
  },
};
