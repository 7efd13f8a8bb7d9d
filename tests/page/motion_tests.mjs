// The properties of the page of a motion, each as a test: run.mjs runs one of them, as motion_NAME.
import assert from 'node:assert/strict';

import {assertNumbers, frameOf, isPlaying, moveSlider, numbersShown, openMotion, tableRows} from './motion_steps.mjs';
import {assertQuiet, checked, evaluateInPage, focus, grouped, look, numbersIn, selectOption} from './steps.mjs';

export const motionTests = {
  async numbers_and_slider(context) {
    const {page, motion} = await openMotion(context, ['gap', 'motion=twist', 'name=ring.obj']);
    assert.equal(await page.text('name'), 'ring.obj');
    assert.equal(await page.evaluate('document.title'), 'ring.obj - balls in motion');
    assert.match(await page.text('facts'), /^30 balls, 1,024 triangles, 12 frames$/);
    assert.match(await page.text('proof'), /proved to lie inside the mesh of its frame; nothing between two frames/);
    assert.equal(await page.text('curve-name'), 'uncovered');
    assert.ok(!await page.evaluate("document.getElementById('ball-opacity').checkVisibility()"));
    await assertNumbers(page, motion, 0);
    for (const number of [7, 11, 3]) {
      await moveSlider(page, number);
      assert.equal(await frameOf(page), number);
      const shown = await assertNumbers(page, motion, number);
      const {gap, medial, flat, shrunk, lost} = motion.frames[number];
      numbersIn(shown['greatest gap']).forEach((x, i) => assert.ok(Math.abs(x - gap[i]) <= 5e-3 * gap[i], shown['greatest gap']));
      assert.equal(medial + flat + shrunk + lost, 30);
      assert.match(await page.text('clock'), new RegExp(`^frame ${number} of 11, `));
    }
    await page.clickElement('open-frames');
    const table = await tableRows(page);
    assert.equal(table.length, 12);
    assert.deepEqual(table.map((row) => row[0]), motion.frames.map((_, i) => String(i)));
    assertQuiet(page);
  },

  /** Time passes as the speed says, and the end is what is chosen. */
  async plays(context) {
    const {page} = await openMotion(context, ['rate=20']);
    await page.clickElement('play');
    assert.ok(await isPlaying(page));
    assert.equal(await page.evaluate("document.getElementById('play').getAttribute('aria-label')"), 'Pause');
    const seen = new Set();
    for (let i = 0; i < 200 && seen.size < 4; ++i) {
      seen.add(await frameOf(page));
      await page.evaluate('new Promise((done) => setTimeout(done, 20))');
    }
    assert.ok(seen.size >= 4, `frames ${[...seen]}`);
    await page.clickElement('play');
    assert.ok(!await isPlaying(page));
    const still = await frameOf(page);
    await page.evaluate('new Promise((done) => setTimeout(done, 300))');
    assert.equal(await frameOf(page), still);

    // 12 frames, of which each stays for a twentieth of a second: a frame for each step of time.
    const framesOf = (end, count, step) => page.evaluate(`(() => { const {player} = medialVk, seen = []; player.setEnd('${end}');
      player.seek(8); player.phase += 0.5; for (let i = 0; i < ${count}; ++i) { player.advance(${step}); seen.push(player.frame); }
      return seen; })()`);
    assert.deepEqual(await framesOf('again', 6, 0.05), [9, 10, 11, 0, 1, 2]);
    assert.deepEqual(await framesOf('back', 6, 0.05), [9, 10, 11, 10, 9, 8]);
    assert.deepEqual(await framesOf('stop', 5, 0.05), [9, 10, 11, 11, 11]);
    // A device that draws three pictures a second leaves frames out.
    assert.deepEqual(await framesOf('again', 3, 0.2), [0, 4, 8]);
    await selectOption(page, 'speed', 80);
    assert.deepEqual(await framesOf('again', 2, 0.05), [0, 4]);
    assertQuiet(page);
  },

  async keys(context) {
    const {page} = await openMotion(context);
    await focus(page, 'view');
    const expected = [['ArrowRight', 1], ['ArrowRight', 2], ['ArrowLeft', 1], ['End', 11], ['ArrowRight', 11], ['Home', 0]];
    for (const [key, frame] of expected) {
      await page.press(key);
      assert.equal(await frameOf(page), frame, key);
    }
    await focus(page, 'time');  // The same on the slider.
    await page.press('ArrowRight');
    assert.equal(await frameOf(page), 1);
    await page.press(' ');
    assert.ok(await isPlaying(page));
    await page.press(' ');
    assert.ok(!await isPlaying(page));
    await focus(page, 'play');  // Space presses a button; the effect is one, not two.
    await page.press(' ');
    assert.ok(await isPlaying(page));
    await page.press('ArrowLeft');
    assert.ok(!await isPlaying(page), 'a step pauses');
    await focus(page, 'view');
    await page.press('Home');
    const first = await look(page);
    for (const [key, modifiers] of [['ArrowUp', 0], ['ArrowRight', 8], ['+', 0]]) {
      await page.press(key, modifiers);
      assert.notEqual((await look(page)).mark, first.mark, key);
      assert.equal(await frameOf(page), 0, key);
      await page.press('0');
      assert.equal((await look(page)).mark, first.mark, `${key}, then 0`);
    }
    for (const [key, layer] of [['1', 'mesh'], ['2', 'balls']]) {
      await page.press(key);
      assert.ok(!await checked(page, `layer-${layer}`));
      assert.notEqual((await look(page)).mark, first.mark, layer);
      await page.press(key);
    }
    await page.press('l');
    assert.equal(await page.evaluate("document.getElementById('at-end').value"), 'back');
    await page.press('h');
    assert.ok(await page.evaluate("document.getElementById('help-dialog').open"));
    await page.press('Escape');
    assert.ok(!await page.evaluate("document.getElementById('help-dialog').open"));
    assertQuiet(page);
  },

  /** The curve has a place for each frame, at which a click goes there, and the thumb of the slider lies below. */
  async curve(context) {
    const {page, motion} = await openMotion(context, ['motion=twist']);
    const values = motion.frames.map(({uncovered}) => uncovered);
    const top = numbersIn(await page.text('curve-top'))[0];
    assert.ok(top >= Math.max(...values));
    const line = numbersIn(await page.evaluate("document.getElementById('curve-line').getAttribute('d')"));
    assert.equal(line.length, 24);
    values.forEach((value, i) => {
      assert.ok(Math.abs(line[2 * i] - i / 11) < 1e-4);
      assert.ok(Math.abs((1 - line[2 * i + 1]) * top - value) < 1e-4 * top, `${line[2 * i + 1]}`);
    });
    const [left, y, width] = await page.evaluate(`(() => { const {left, top, width, height} =
      document.getElementById('curve-box').getBoundingClientRect(); return [left, top + height / 2, width]; })()`);
    for (const number of [4, 11, 0]) {
      await page.click(left + width * number / 11 + (number === 11 ? -1 : 1), y);
      assert.equal(await frameOf(page), number);
      const cursor = await page.evaluate(`(() => { const {left, width} =
        document.getElementById('curve-cursor').getBoundingClientRect(); return left + width / 2; })()`);
      assert.ok(Math.abs(cursor - (left + width * number / 11)) < 1.5, `${cursor}`);
    }
    const [from, to] = await page.evaluate(`(() => { const {left, right} = document.getElementById('time')
      .getBoundingClientRect(); return [left + 8, right - 8]; })()`);
    assert.ok(Math.abs(from - left) < 1 && Math.abs(to - left - width) < 1, `${from} ${to}, ${left} ${left + width}`);
    assertQuiet(page);
  },

  /** Vertices to half a place of the box, and balls inside those of the record, for every frame. */
  async drawing_follows(context) {
    const {page, motion} = await openMotion(context, ['motion=limb', 'raw=raw']);
    const raw = new Float64Array(new Uint8Array(context.workshop.read('raw')).buffer);
    const size = 3 * motion.vertices + 4 * motion.balls;
    assert.equal(raw.length, 12 * size);
    const {lower, upper, scale} = motion;
    const marks = [];
    for (let frame = 0; frame < 12; ++frame) {
      await page.evaluate(`medialVk.player.seek(${frame})`);
      const [places, balls, drawn] = await page.evaluate(`[Array.from(medialVk.viewer.placesOf(${frame})),
        Array.from(medialVk.viewer.balls.places.image.data), Array.from(medialVk.viewer.skin.position.array.subarray(0, 3))]`);
      const expected = raw.subarray(frame * size, (frame + 1) * size);
      places.forEach((place, i) => {
        const side = upper[i % 3] - lower[i % 3];
        const error = Math.abs(lower[i % 3] + place / 65535 * side - expected[i]);
        assert.ok(error <= side / 65535 * 0.5001, `${frame} ${i}: ${error}`);
      });
      const v = await page.evaluate('medialVk.viewer.skin.vertexOf[0]');
      drawn.forEach((x, k) => assert.ok(Math.abs((lower[k] + upper[k]) / 2 + x * scale - expected[3 * v + k]) < 1e-4 * scale));
      for (let i = 0; i < motion.balls; ++i) {
        const ball = expected.subarray(3 * motion.vertices + 4 * i, 3 * motion.vertices + 4 * i + 4);
        const away = [0, 1, 2].map((k) => (lower[k] + upper[k]) / 2 + balls[4 * i + k] * scale - ball[k]);
        const radius = balls[4 * i + 3] * scale;
        assert.ok(Math.hypot(...away) + radius <= ball[3] + 1e-14, `${frame} ${i}: ${radius}, not below ${ball[3]}`);
        assert.ok(radius >= ball[3] - 1e-6 * scale, `${frame} ${i}: ${radius}, far below ${ball[3]}`);
      }
      marks.push((await look(page)).mark);
    }
    assert.equal(new Set(marks).size, 12);
    await page.evaluate('medialVk.player.seek(4)');
    assert.equal((await look(page)).mark, marks[4]);
    assertQuiet(page);
  },

  /** Lost balls, which are inserted here, are not drawn. */
  async states_and_colours(context) {
    const {page, motion} = await openMotion(context, ['motion=bend']);
    const first = await look(page);
    assert.match(await page.text('legend'), /^state of the ball\s*medial\s*flat\s*shrunk$/);
    const marks = new Set([first.mark]);
    for (const [by, legend] of [['ball', /^number of the ball01.*11and so on$/], ['radius', /^radius \(units of the mesh\)0\d/]]) {
      await selectOption(page, 'colour-by', by);
      assert.match(await page.text('legend'), legend);
      marks.add((await look(page)).mark);
    }
    assert.equal(marks.size, 3);
    await selectOption(page, 'colour-by', 'state');
    assert.equal((await look(page)).mark, first.mark);
    await page.clickElement('layer-mesh');
    assert.ok((await look(page)).share > 0.05, 'the balls alone');
    assertQuiet(page);

    const nothing = Buffer.alloc(12 * 16 * motion.balls).toString('base64');
    const {workshop, browser} = context;
    workshop.write('page.html', workshop.read('page.html').toString().replace(/(id="data-balls">)[^<]*/, `$1${nothing}`));
    const lost = await browser.open();
    await lost.load(workshop.url('page.html'));
    assert.ok((await look(lost)).share > 0.05, 'the mesh');
    await lost.clickElement('layer-mesh');
    assert.equal((await look(lost)).share, 0);
    assertQuiet(lost);
  },

  /** The motion of the documents: 7,200 vertices, 500 balls, 120 frames. The pace is printed; only a hang is an error. */
  async smooth(context) {
    const {page} = await openMotion(context, ['around=60', 'balls=500', 'frames=120', 'rate=30']);
    console.log(`${grouped(context.workshop.read('page.html').length)} bytes; first frame after ${await page.evaluate(
      'document.documentElement.dataset.ready')} ms`);
    await page.press(' ');
    const [pictures, skipped, ratio, work] = await page.evaluate(`new Promise((done) => {
      const {viewer, player} = medialVk, show = player.onFrame;
      let pictures = 0, skipped = 0, before = player.frame, work = 0;
      player.onFrame = (frame) => {
        pictures += 1;
        skipped += (frame - before + 120) % 120 - 1;
        before = frame;
        const begin = performance.now();
        show(frame);
        work += performance.now() - begin;
      };
      setTimeout(() => done([pictures, skipped, viewer.ratioOf(false), work / pictures]), 5000);
    })`);
    console.log(`${pictures / 5} frames a second, ${skipped} left out, ${ratio} pixels for one of the page, ${work.toFixed(1)} ms ` +
      'of the program for a frame');
    assert.ok(pictures >= 2, `${pictures} pictures in 5 s`);
    await page.press(' ');
    assert.ok(!await isPlaying(page));
    assertQuiet(page);
  },

  /** The slider stops at frames that have a mesh; the curve and the table have all. */
  async many_frames_without_meshes(context) {
    const {page, motion} = await openMotion(context, ['every=5']);
    assert.deepEqual(motion.shown, [0, 5, 10]);
    await focus(page, 'time');
    for (const frame of [5, 10, 10]) {
      await page.press('ArrowRight');
      assert.equal(await frameOf(page), frame);
    }
    for (const [value, frame] of [[6, 5], [8, 10], [2, 0], [11, 10]]) {
      await moveSlider(page, value);
      assert.equal(await frameOf(page), frame);
      assert.equal(await page.evaluate("document.getElementById('time').value"), String(frame));
    }
    await assertNumbers(page, motion, 10);
    assert.equal(numbersIn(await page.evaluate("document.getElementById('curve-line').getAttribute('d')")).length, 24);
    await page.clickElement('open-frames');
    assert.equal((await tableRows(page)).length, 12);
    assertQuiet(page);
  },

  async no_meshes(context) {
    const {page, motion} = await openMotion(context, ['every=0']);
    assert.deepEqual(motion.shown, []);
    assert.match(await page.text('sentence'), /made without the meshes/);
    assert.equal((await tableRows(page)).length, 12);
    assertQuiet(page);
  },

  async no_webgl(context) {
    const {page, motion} = await openMotion(context);
    assert.match(await page.text('sentence'), /no WebGL 2/);
    for (const id of ['sentence', 'frames-body']) {
      assert.ok(await page.evaluate(`document.getElementById('${id}').checkVisibility()`), id);
    }
    assert.ok(!await page.evaluate("document.getElementById('player').checkVisibility()"));
    const table = await tableRows(page);
    assert.equal(table.length, 12);
    assert.equal(table[3][4 + 1], String(motion.frames[3].medial));
    const [worst] = await evaluateInPage(page, 'contrasts');
    assert.ok(worst.ratio >= 4.5, JSON.stringify(worst));
    assertQuiet(page);
  },

  async no_volume(context) {
    const {page} = await openMotion(context, ['open', 'frames=3', 'balls=4']);
    assert.equal((await numbersShown(page)).uncovered, 'not known');
    assert.ok(await page.evaluate("document.getElementById('no-volume').checkVisibility()"));
    assert.ok(!await page.evaluate("document.getElementById('curve-box').checkVisibility()"));
    await page.press('ArrowRight');
    assert.equal(await frameOf(page), 1);
    assertQuiet(page);
  },

  async published(context) {
    const {page, motion} = await openMotion(context, ['rule=published', 'motion=twist']);
    assert.match(await page.text('proof'), /may reach out of the mesh/);
    await moveSlider(page, 6);
    const {outside} = motion.frames[6];
    assert.ok(outside > 0);
    assert.ok(Math.abs(numbersIn((await numbersShown(page))['outside, at most'])[0] - outside) <= 1e-4 * outside);
    assertQuiet(page);
  },

  async strange_names(context) {
    const name = 'a"\'</script><script>alert(1)<!-- &amp; \u00e4.obj';
    const {page} = await openMotion(context, [`name=${name}`]);
    assert.equal(await page.text('name'), name);
    assert.ok((await page.evaluate('document.title')).startsWith(name));
    assertQuiet(page);
  },

  async up(context) {
    const {page} = await openMotion(context, ['up=-z']);
    assert.equal(await page.evaluate("document.getElementById('up').value"), '-z');
    const first = await look(page);
    await selectOption(page, 'up', 'z');
    assert.notEqual((await look(page)).mark, first.mark);
    assertQuiet(page);
  },

  async phone(context) {
    const {page} = await openMotion(context, [], {width: 360, height: 740, phone: true, scale: 2});
    const assertFits = async (what) => {
      assert.equal(await page.evaluate('document.documentElement.scrollWidth'), 360, what);
      assert.deepEqual(await evaluateInPage(page, 'tooWide'), [], what);
    };
    await assertFits('closed');
    assert.ok((await look(page)).share > 0.05);
    await page.clickElement('fold');
    assert.ok(await page.evaluate("document.getElementById('opacity').checkVisibility()"));
    await assertFits('open');
    for (const name of ['frames', 'help']) {
      await page.clickElement(`open-${name}`);
      await assertFits(name);
      await page.press('Escape');
    }
    assertQuiet(page);
  },

  /** Text against its background: a contrast of at least 4.5 to 1 (WCAG 2, level AA), light and dark. */
  async contrast({workshop, browser}) {
    workshop.run('page.html', 'open', 'frames=2', 'balls=3');
    for (const dark of [false, true]) {
      const page = await browser.open({dark});
      await page.load(workshop.url('page.html'));
      for (const dialog of [null, 'frames', 'help']) {
        if (dialog) await page.clickElement(`open-${dialog}`);
        const [worst] = await evaluateInPage(page, 'contrasts');
        console.log(`${dark ? 'dark' : 'light'}, ${dialog ?? 'page'}: at least ${worst.ratio.toFixed(2)} (${worst.text})`);
        assert.ok(worst.ratio >= 4.5, JSON.stringify(worst));
        if (dialog) await page.press('Escape');
      }
      assertQuiet(page);
    }
  },

  /** Every control can be reached by Tab and shows that it has the focus. */
  async focus_is_seen(context) {
    const {page} = await openMotion(context);
    await moveSlider(page, 5);  // All buttons are enabled.
    const seen = new Set();
    for (let i = 0; i < 40; ++i) {
      await page.press('Tab');
      const [id, outline] = await page.evaluate(`(() => { const e = document.activeElement; return [e.id,
        getComputedStyle(e).outlineStyle]; })()`);
      if (id) assert.notEqual(outline, 'none', id);
      seen.add(id);
    }
    const controls = await page.evaluate(`[...document.querySelectorAll('canvas, #panel, #player')].flatMap((e) =>
      e.matches('canvas') ? [e] : [...e.querySelectorAll('button, input, select')]).filter((e) => e.checkVisibility() &&
      !e.disabled).map((e) => e.id)`);
    assert.ok(controls.includes('time') && controls.includes('play'));
    for (const id of controls) assert.ok(seen.has(id), `Tab does not reach ${id}`);
    assert.deepEqual(await evaluateInPage(page, 'nameless'), []);
  },

  async same_bytes_twice({workshop}) {
    const make = () => { workshop.run('page.html', 'frames=4', 'balls=8', 'gap'); return workshop.read('page.html'); };
    assert.ok(make().equals(make()));
  },
};
