// The properties of the page, each as a test: run.mjs runs one of them.
import assert from 'node:assert/strict';

import {box, lShape, tetrahedron} from './fixtures.mjs';
import {evaluateInPage, assertQuiet, assertSame, checked, focus, grouped, kLayers, kSmall, look, numbersIn, openPart,
  pickedValues, project, selectOption, show} from './steps.mjs';

export const tests = {
  /** A hundred thousand points: all layers draw something. The time is printed; only a hang is an error. */
  async big_result({workshop, browser}) {
    const points = workshop.make(box(), ['--resolution', '140']);
    assert.ok(points.length > 100000, `${points.length} points`);
    const page = await browser.open();
    const time = await page.load(workshop.url('page.html'));
    console.log(`${grouped(points.length)} points: first frame after ${time} ms`);
    assert.equal(await page.text('count'), `${grouped(points.length)} of ${grouped(points.length)} points shown`);
    const all = await look(page);
    assert.ok(all.share > 0.2 && all.colours > 500, JSON.stringify(all));
    for (const layer of kLayers) {
      await show(page, [layer]);
      const begin = Date.now();
      const alone = await look(page);
      console.log(`${layer}: ${(100 * alone.share).toFixed(1)} % of the pixels, ${alone.colours} colours, ` +
        `${Date.now() - begin} ms`);
      assert.ok(alone.share > 0.05 && alone.colours >= 3, `${layer}: ${JSON.stringify(alone)}`);
    }
    await show(page, []);
    assert.equal((await look(page)).share, 0);

    // All balls at once cover the picture a thousand times over; the page must still respond.
    await show(page, ['balls']);
    await focus(page, 'ball-count');
    await page.press('End');
    assert.equal(numbersIn((await page.text('ball-count-value')).replaceAll(',', ''))[0], points.length);
    const answers = [];
    for (let i = 0; i < 5; ++i) {
      const begin = Date.now();
      await page.press('[');
      await page.evaluate('medialVk.viewer.turn(0.1, 0)');
      await page.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
      await page.evaluate('medialVk.viewer.finish()');
      answers.push(Date.now() - begin);
      await page.evaluate('new Promise((done) => setTimeout(done, 1000))');
    }
    console.log(`all balls: ${await page.text('ball-count-value')}; a turn takes ${answers} ms`);
    assert.ok(Math.min(...answers) < 5000);
    assertQuiet(page);
  },

  async mouse(context) {
    const {page} = await openPart(context);
    const first = await look(page);
    const differs = async (what) => assert.notEqual((await look(page)).mark, first.mark, what);
    await page.drag([400, 400], [520, 340]);
    await differs('turning');
    await page.clickElement('reset');
    assert.equal((await look(page)).mark, first.mark, 'reset');
    await page.wheel(400, 400, -240);
    await page.evaluate('new Promise((done) => setTimeout(done, 300))');
    await differs('zooming');
    assertQuiet(page);
  },

  async keyboard(context) {
    const {page} = await openPart(context);
    await focus(page, 'view');
    const first = await look(page);
    for (const key of ['ArrowLeft', 'ArrowUp', '+', '-', '1']) {
      await page.press(key);
      assert.notEqual((await look(page)).mark, first.mark, key);
      if (key === '1') await page.press('1');
      await page.press('0');
      assert.equal((await look(page)).mark, first.mark, `${key}, then 0`);
    }
    for (const [i, layer] of kLayers.entries()) {
      const before = await checked(page, `layer-${layer}`);
      await page.press(String(i + 1));
      assert.equal(await checked(page, `layer-${layer}`), !before, layer);
    }
    for (const key of ['c', 'f']) await page.press(key);
    assert.deepEqual([await checked(page, 'cut'), await checked(page, 'cut-flip')], [true, true]);
    await page.press('h');
    assert.ok(await page.evaluate("document.getElementById('help-dialog').open"));
    await page.press('Escape');
    assert.ok(!await page.evaluate("document.getElementById('help-dialog').open"));
    assertQuiet(page);
  },

  /** Every control can be reached by Tab and shows that it has the focus. */
  async focus_is_seen(context) {
    const {page} = await openPart(context);
    const seen = new Set();
    for (let i = 0; i < 40; ++i) {
      await page.press('Tab');
      const [id, outline] = await page.evaluate(`(() => { const e = document.activeElement; return [e.id,
        getComputedStyle(e).outlineStyle]; })()`);
      if (id) assert.notEqual(outline, 'none', id);
      seen.add(id);
    }
    const controls = await page.evaluate(`[...document.querySelectorAll('canvas, #panel :is(button, input, select)')]
      .filter((e) => e.checkVisibility() && !e.disabled).map((e) => e.id)`);
    for (const id of controls) assert.ok(seen.has(id), `Tab does not reach ${id}`);
    assert.deepEqual(await evaluateInPage(page, 'nameless'), []);
  },

  async filter(context) {
    const {points, page} = await openPart(context);
    const total = grouped(points.length);
    assert.equal(await page.text('count'), `${total} of ${total} points shown`);
    await show(page, ['points']);
    const all = await look(page);
    const angles = points.map((p) => p.angle), radii = points.map((p) => p.radius);
    const least = (numbers, share) => Math.min(...numbers) + share * (Math.max(...numbers) - Math.min(...numbers));
    const countAbove = (angle, radius) => points.filter((p) => p.angle >= angle && p.radius >= radius).length;

    await focus(page, 'least-angle');
    for (let i = 0; i < 30; ++i) await page.press('ArrowRight');
    const share = await page.evaluate("document.getElementById('least-angle').value") / 1000;
    assert.ok(share > 0);
    const byAngle = Number((await page.text('count')).split(' ')[0].replaceAll(',', ''));
    assert.ok(Math.abs(byAngle - countAbove(least(angles, share), 0)) <= 2 && byAngle < points.length, `${byAngle}`);
    assert.ok((await look(page)).share < all.share);

    await focus(page, 'least-radius');
    await page.press('End');
    const byBoth = Number((await page.text('count')).split(' ')[0].replaceAll(',', ''));
    assert.ok(byBoth < byAngle, `${byBoth}`);
    assert.ok(Math.abs(byBoth - countAbove(least(angles, share), least(radii, 1) * (1 - 1e-7))) <= 2, `${byBoth}`);
    assertQuiet(page);
  },

  /** A model far from 0, where single precision would be visible. */
  async pick(context) {
    const far = [100000, -50000, 20000];
    const {points, page} = await openPart(context, {mesh: lShape(far)});
    await show(page, ['points']);
    const before = await look(page);
    const picked = new Set();
    for (const share of [0.1, 0.35, 0.6, 0.85]) {
      await page.click(...await project(page, Math.floor(share * points.length)));
      const values = await pickedValues(page);
      assert.ok(values, 'nothing was picked');
      picked.add(values.point);
      assertSame(values, points[Number(values.point)], 2);
    }
    assert.ok(picked.size > 1);
    assert.notEqual((await look(page)).mark, before.mark, 'the picked ball is drawn');
    await page.press('Escape');
    assert.equal(await pickedValues(page), null);
    assert.equal((await look(page)).mark, before.mark);
    assertQuiet(page);
  },

  async pick_by_keyboard_and_balls(context) {
    const {points, page} = await openPart(context, {mesh: box()});
    await show(page, ['balls']);
    await look(page);  // Only drawn balls can be picked.
    await focus(page, 'view');
    await page.press('Enter');
    const values = await pickedValues(page);
    assert.ok(values, 'the ball in the middle');
    assertSame(values, points[Number(values.point)], 1);
    await page.press(']');
    assert.equal(Number((await pickedValues(page)).point), (Number(values.point) + 1) % points.length);
    await page.press('[');
    assert.equal((await pickedValues(page)).point, values.point);
    await page.clickElement('clear-picked');
    assert.equal(await pickedValues(page), null);
    await focus(page, 'picked-number');
    for (const key of '12') await page.press(key);
    await page.press('Enter');
    assert.equal((await pickedValues(page)).point, '12');
    assertSame(await pickedValues(page), points[12], 1);
    assertQuiet(page);
  },

  async cut(context) {
    const {points, page} = await openPart(context);
    const whole = await look(page);
    await page.clickElement('cut');
    for (const [axis, name] of ['x', 'y', 'z'].entries()) {
      await selectOption(page, 'cut-axis', axis);
      const place = numbersIn(await page.text('cut-offset-value'))[0];
      const shares = [];
      for (const sign of [-1, 1]) {
        const expected = points.filter((p) => sign * (p.centre[axis] - place) >= 0).length;
        const count = Number((await page.text('count')).split(' ')[0].replaceAll(',', ''));
        assert.ok(Math.abs(count - expected) <= 2 + points.length / 500, `${name} ${sign}: ${count}, not ${expected}`);
        shares.push((await look(page)).share);
        await page.clickElement('cut-flip');
      }
      assert.ok(shares.some((share) => share < 0.95 * whole.share), `${name}: ${shares} of ${whole.share}`);
    }
    for (const layer of kLayers) {
      await page.evaluate(`document.getElementById('cut').checked && document.getElementById('cut').click()`);
      await show(page, [layer]);
      const uncut = await look(page);
      await page.clickElement('cut');
      assert.ok((await look(page)).share < 0.98 * uncut.share, layer);
    }
    assertQuiet(page);
  },

  /** Counts and messages of the page must not move a control away from under the mouse. */
  async nothing_moves(context) {
    const {page} = await openPart(context);
    const places = `[...document.querySelectorAll('input, select, button')].map((e) =>
      [e.id, e.getBoundingClientRect().y])`;
    await show(page, ['balls']);
    const before = await page.evaluate(places);
    // Immediately: the next frame reports how many balls it has drawn.
    const [text, after] = await page.evaluate(`(() => {
      medialVk.viewer.drawnBalls = 1;
      medialVk.controls.sayBalls();
      return [document.getElementById('balls-drawn').textContent, ${places}];
    })()`);
    assert.match(text, /^1 of/);
    assert.deepEqual(after, before);
    assertQuiet(page);
  },

  async phone(context) {
    const {points, page} = await openPart(context, {width: 360, height: 740, phone: true, scale: 2});
    const assertFits = async (what) => {
      assert.equal(await page.evaluate('document.documentElement.scrollWidth'), 360, what);
      assert.deepEqual(await evaluateInPage(page, 'tooWide'), [], what);
    };
    await assertFits('closed');
    assert.ok((await look(page)).share > 0.05);
    assert.ok(!await page.evaluate("document.getElementById('least-angle').checkVisibility()"));
    await page.clickElement('fold');
    assert.equal(await page.evaluate("document.getElementById('fold').getAttribute('aria-expanded')"), 'true');
    assert.ok(await page.evaluate("document.getElementById('least-angle').checkVisibility()"));
    await assertFits('open');
    for (const name of ['report', 'help']) {
      await page.clickElement(`open-${name}`);
      await assertFits(name);
      await page.press('Escape');
    }
    await page.clickElement('fold');
    assert.ok(!await page.evaluate("document.getElementById('least-angle').checkVisibility()"));
    await page.evaluate('new Promise((done) => setTimeout(done, 300))');  // The picture grows.
    await page.tap(...await project(page, Math.floor(points.length / 2)));
    assert.ok(await pickedValues(page), 'a tap picks');
    assertQuiet(page);
  },

  /** Text against its background: a contrast of at least 4.5 to 1 (WCAG 2, level AA), light and dark. */
  async contrast({workshop, browser}) {
    workshop.make(lShape(), kSmall);
    const backgrounds = [];
    for (const dark of [false, true]) {
      const page = await browser.open({dark});
      await page.load(workshop.url('page.html'));
      await page.evaluate('medialVk.controls.choose(3)');
      for (const dialog of [null, 'report', 'help']) {
        if (dialog) await page.clickElement(`open-${dialog}`);
        const [worst] = await evaluateInPage(page, 'contrasts');
        console.log(`${dark ? 'dark' : 'light'}, ${dialog ?? 'page'}: at least ${worst.ratio.toFixed(2)} (${worst.text})`);
        assert.ok(worst.ratio >= 4.5, JSON.stringify(worst));
        if (dialog) await page.press('Escape');
      }
      backgrounds.push(await page.evaluate('getComputedStyle(document.body).backgroundColor'));
      assertQuiet(page);
    }
    assert.notEqual(backgrounds[0], backgrounds[1]);
  },

  async report(context) {
    const {points, page} = await openPart(context);
    await page.clickElement('open-report');
    const text = await page.text('report-body');
    for (const part of ['part.obj', 'Parameters', 'resolution', 'Mesh', 'triangles', 'Levels', 'Union of the balls', 'Fatness', 'significance', grouped(points.length)]) {
      assert.ok(text.includes(part), part);
    }
    assert.ok(await page.evaluate("document.getElementById('report-body').checkVisibility()"));
    assertQuiet(page);
  },

  async no_webgl({workshop, browser}) {
    const points = workshop.make(lShape(), kSmall);
    const page = await browser.open();
    await page.load(workshop.url('page.html'));
    assert.match(await page.text('sentence'), /no WebGL 2/);
    for (const id of ['sentence', 'report-body']) {
      assert.ok(await page.evaluate(`document.getElementById('${id}').checkVisibility()`), id);
    }
    assert.ok((await page.text('report-body')).includes(grouped(points.length)));
    const [worst] = await evaluateInPage(page, 'contrasts');
    assert.ok(worst.ratio >= 4.5, JSON.stringify(worst));
    assertQuiet(page);
  },

  async strange_names({workshop, browser}) {
    const name = 'a"\'<script>alert(1)<!-- &amp; \u00e4.obj';
    workshop.make(lShape(), kSmall, name);
    const page = await browser.open();
    await page.load(workshop.url('page.html'));
    assert.equal(await page.text('name'), name);
    assert.ok((await page.evaluate('document.title')).startsWith(name));
    assertQuiet(page);
  },

  async nothing_found({workshop, browser}) {
    const points = workshop.make(tetrahedron(), ['--resolution', '4', '--object-angle', '1.57']);
    assert.equal(points.length, 0);
    const page = await browser.open();
    await page.load(workshop.url('page.html'));
    await show(page, kLayers);
    assert.equal(await page.text('count'), '0 of 0 points shown');
    assert.ok((await look(page)).share > 0.05, 'the mesh');
    await focus(page, 'view');
    for (const key of ['Enter', ']', '[']) await page.press(key);
    assert.equal(await pickedValues(page), null);
    assertQuiet(page);
  },

  /** More sheets than colours, and points without a sheet, which are inserted here. */
  async sheets({workshop, browser}) {
    const points = workshop.make(lShape(), kSmall);
    const numbers = Buffer.from(Int32Array.from(points, (_, i) => i % 20 - 1).buffer).toString('base64');
    const page = await browser.open();
    workshop.write('page.html', workshop.read('page.html').toString().replace(/(id="data-sheets">)[^<]*/, `$1${numbers}`));
    await page.load(workshop.url('page.html'));
    const before = await look(page);
    await selectOption(page, 'colour-by', 'sheet');
    assert.notEqual((await look(page)).mark, before.mark);
    assert.match(await page.text('legend'), /sheet \(number\)none.*0.*11and 7 more/s);
    for (const attribute of ['radius', 'flux', 'angle']) {
      await selectOption(page, 'colour-by', attribute);
      assert.match(await page.text('legend'), /^(radius|flux|object angle) \((units of the mesh|no unit|rad)\)-?\d/);
    }
    assert.equal((await look(page)).mark, before.mark);
    assertQuiet(page);
  },

  async same_bytes_twice({workshop}) {
    workshop.make(lShape(), kSmall);
    const first = workshop.read('page.html');
    workshop.make(lShape(), kSmall);
    assert.ok(first.equals(workshop.read('page.html')));
  },
};
