// The properties of the page of a surface between sites, each as a test: run.mjs runs one of them, as sites_NAME.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';

import {evaluateInPage, assertNear, assertQuiet, checked, focus, look, numbersIn, pickedValues, selectOption} from './steps.mjs';

/** A cube of side 1, moved along x. */
function cube(x) {
  const corners = Array.from({length: 8}, (_, i) => `v ${x + (i & 1)} ${i >> 1 & 1} ${i >> 2 & 1}`);
  const faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
  return `${[...corners, ...faces.map((face) => `f ${face.join(' ')}`)].join('\n')}\n`;
}

/** Two cubes, from 0 to 1 and from 2 to 3 in x: the surface between them is a part of the plane x = 1.5. */
function makeCubes(workshop, {names = ['left.obj', 'right.obj'], options = []} = {}) {
  names.forEach((name, i) => workshop.write(name, cube(2 * i)));
  const run = spawnSync(workshop.tool, ['voronoi', ...names.map((name) => `./${name}`), '-q', '--resolution', '30', '-o', 'v.json',
    '--html', 'page.html', ...options], {cwd: workshop.folder, encoding: 'utf8'});
  if (run.status !== 0) throw new Error(run.stderr);
}

async function openCubes({workshop, browser}, {names, options, ...size} = {}) {
  makeCubes(workshop, {names, options});
  const page = await browser.open(size);
  await page.load(workshop.url('page.html'));
  return page;
}

const kRoadmap = ['--roadmap', 'map.json', '--from', '1.5,-0.4,0.5', '--to', '1.5,1.4,0.5'];
const listed = (page) => page.evaluate(`[...document.querySelectorAll('#pairs tr')].map((row) =>
  [...row.querySelectorAll('td')].map((cell) => cell.textContent))`);

export const sitesTests = {
  async pairs_and_picking(context) {
    const page = await openCubes(context);
    const json = JSON.parse(context.workshop.read('v.json'));
    assert.equal(await page.text('name'), 'left, right');
    assert.equal(await page.evaluate('document.title'), 'left, right - surface between sites');
    const [[name, area, least], ...others] = await listed(page);
    assert.equal(name, 'left and right');
    assert.equal(others.length, 0);
    // Three digits.
    assert.ok(Math.abs(Number(area) / json.pieces[0].area - 1) < 6e-3, area);
    assert.ok(Math.abs(Number(least) / json.pieces[0].least_clearance - 1) < 6e-3, least);

    // In the middle of the picture is the middle of the plane.
    await focus(page, 'view');
    await page.press('Enter');
    const values = await pickedValues(page);
    assert.equal(values.pair, 'left and right');
    const point = json.points[Number(values.point)];
    assertNear(numbersIn(values.place), point.point, 1e-6);
    assertNear(numbersIn(values.distance), [point.distance], 1e-6);
    assertNear(numbersIn(values.distance), [0.5], 1e-3);
    assertNear(numbersIn(values['towards left']), [-1, 0, 0], 1e-4);
    assertNear(numbersIn(values['towards right']), [1, 0, 0], 1e-4);
    await page.press('Escape');
    assert.equal(await pickedValues(page), null);

    // Without the faces of the pair there is nothing to pick, and less to see.
    const before = await look(page);
    await page.clickElement('no-pair');
    assert.ok((await look(page)).share < before.share);
    await focus(page, 'view');
    await page.press('Enter');
    assert.equal(await pickedValues(page), null);
    await page.clickElement('all-pairs');
    assert.equal((await look(page)).mark, before.mark);
    assertQuiet(page);
  },

  async layers_and_colours(context) {
    const page = await openCubes(context, {options: ['--up', 'z']});
    assert.equal(await page.evaluate("document.getElementById('up').value"), 'z');
    const all = await look(page);
    for (const layer of ['sites', 'surface']) {
      await page.clickElement(`layer-${layer}`);
      assert.ok((await look(page)).share < all.share, layer);
      await page.clickElement(`layer-${layer}`);
    }
    assert.equal((await look(page)).mark, all.mark);
    assert.match(await page.text('legend'), /left and right/);
    await selectOption(page, 'colour-by', 'distance');
    const distances = JSON.parse(context.workshop.read('v.json')).points.map(({distance}) => distance);
    const ends = await page.evaluate("[...document.querySelectorAll('#legend .ends span')].map((e) => Number(e.textContent))");
    assert.ok(Math.abs(ends[0] / Math.min(...distances) - 1) < 6e-3, `${ends}`);
    assert.ok(Math.abs(ends.at(-1) / Math.max(...distances) - 1) < 6e-3, `${ends}`);
    assert.notEqual((await look(page)).mark, all.mark);
    // A cut in the middle across y leaves the half of the plane.
    await page.clickElement('layer-sites');
    const whole = (await look(page)).share;
    await selectOption(page, 'cut-axis', '1');
    await page.clickElement('cut');
    const half = (await look(page)).share;
    assert.ok(half > 0.2 * whole && half < 0.8 * whole, `${half} of ${whole}`);
    assertQuiet(page);
  },

  async roadmap_and_path(context) {
    const plain = await openCubes(context);
    const visible = (page, id) => page.evaluate(`document.getElementById('${id}').checkVisibility()`);
    for (const id of ['offer-roadmap', 'offer-path', 'path-part']) assert.ok(!await visible(plain, id), id);
    assertQuiet(plain);

    const page = await openCubes(context, {options: kRoadmap});
    const {path} = JSON.parse(context.workshop.read('map.json'));
    assert.ok(await visible(page, 'path-values') && !await visible(page, 'no-path'));
    const [width, length] = numbersIn(await page.text('path-values'));
    assertNear([width, length], [path.width, path.length], 1e-6);
    assert.ok(await checked(page, 'layer-path') && !await checked(page, 'layer-roadmap'));
    const first = await look(page);
    await page.clickElement('layer-path');
    assert.notEqual((await look(page)).mark, first.mark);
    await page.clickElement('layer-roadmap');
    const withRoadmap = await look(page);
    assert.ok(withRoadmap.colours > first.colours);
    assert.match(await page.text('legend'), /width of a link/);
    assertQuiet(page);
  },

  /** In the plane the path is red on the page of the plane. */
  async path_in_the_plane({workshop, browser}) {
    workshop.write('room.wkt', 'POLYGON ((-9 -9, 9 -9, 9 9, -9 9, -9 -9), (-3 -3, -3 3, 3 3, 3 -3, -3 -3))');
    workshop.write('core.wkt', 'POLYGON ((-1 -1, 1 -1, 1 1, -1 1, -1 -1))');
    workshop.run('voronoi', 'room.wkt', 'core.wkt', '-q', '-o', 'v.json', '--html', 'page.html', '--roadmap', 'map.json',
      '--from', '2,0.5', '--to', '2,-0.5');
    const page = await browser.open();
    await page.load(workshop.url('page.html'));
    const {path} = JSON.parse(workshop.read('map.json'));
    assert.deepEqual(await page.evaluate('[...medialVk.drawing.plane.path]'), path.line.flat());
    const red = await page.evaluate(`(() => { const {drawing} = medialVk; drawing.draw();
      const ratio = devicePixelRatio, {width, height} = drawing.size();
      const at = [(width / 2 + (2 - drawing.middle[0]) * drawing.scale) * ratio,
        (height / 2 + drawing.flip * (0 - drawing.middle[1]) * drawing.scale) * ratio].map(Math.floor);
      const copy = new OffscreenCanvas(drawing.canvas.width, drawing.canvas.height);
      const context = copy.getContext('2d', {willReadFrequently: true}); context.drawImage(drawing.canvas, 0, 0);
      return Array.from(context.getImageData(...at, 1, 1).data); })()`);
    assert.ok(red[0] > 180 && red[1] < 80 && red[2] < 80, `${red}`);
    assert.match(await page.text('numbers'), /width of the path/);
    assertQuiet(page);
  },

  async strange_names(context) {
    const page = await openCubes(context, {names: ['<b>&"strange".obj', 'right.obj']});
    assert.equal(await page.text('name'), '<b>&"strange", right');
    assert.equal((await listed(page))[0][0], '<b>&"strange" and right');
    assertQuiet(page);
  },

  async phone(context) {
    const page = await openCubes(context, {width: 360, height: 740, phone: true, scale: 2, options: kRoadmap});
    assert.ok(!await page.evaluate("document.getElementById('colour-by').checkVisibility()"));
    await page.clickElement('fold');
    assert.ok(await page.evaluate("document.getElementById('colour-by').checkVisibility()"));
    assert.ok(await page.evaluate('document.documentElement.scrollWidth <= innerWidth'));
    assertQuiet(page);
  },

  async contrast(context) {
    for (const dark of [false, true]) {
      const page = await openCubes(context, {dark, options: kRoadmap});
      await focus(page, 'view');
      await page.press('Enter');
      const [worst] = await evaluateInPage(page, 'contrasts');
      assert.ok(worst.ratio >= 4.5, JSON.stringify(worst));
    }
  },

  async no_webgl(context) {
    const page = await openCubes(context);
    assert.match(await page.text('sentence'), /no WebGL 2/);
    assert.match(await page.text('numbers'), /least distance/);
    assertQuiet(page);
  },

  async same_bytes_twice({workshop}) {
    makeCubes(workshop, {options: kRoadmap});
    const first = workshop.read('page.html');
    makeCubes(workshop, {options: [...kRoadmap, '--threads', '1']});
    assert.ok(first.equals(workshop.read('page.html')));
  },
};
