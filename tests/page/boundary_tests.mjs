// What was measured on the boundary, on the page.
import assert from 'node:assert/strict';

import {box, ellipsoid} from './fixtures.mjs';
import {assertQuiet, kSmall, look, numbersIn, openPart, selectOption, show} from './steps.mjs';

const kMeasured = [...kSmall, '--thickness', '--curvature', '--least-wall', '--boundary-edge', '0.2', '--boundary', 'boundary.ply', '--ascii'];

/** The vertices of the PLY as text, by the names of their numbers. */
function vertices(text) {
  const [header, body] = text.split('end_header\n');
  const names = [...header.split('element face')[0].matchAll(/property \w+ (\w+)/g)].map((match) => match[1]);
  const count = Number(header.match(/element vertex (\d+)/)[1]);
  return body.split('\n').slice(0, count).map((line) => Object.fromEntries(line.split(' ').map((word, i) => [names[i], Number(word)])));
}

const vertexValues = (page) => page.evaluate(`(() => { const list = document.getElementById('vertex-values');
  if (list.hidden) return null;
  return Object.fromEntries([...list.querySelectorAll('dt')].map((dt) => [dt.textContent, dt.nextSibling.textContent])); })()`);

/** Mean red, green and blue of the pixels that are drawn. */
const meanColour = (page) => page.evaluate(`(() => { const {viewer} = window.medialVk; viewer.drawNow(false);
  const gl = viewer.renderer.getContext(), sums = [0, 0, 0, 0];
  const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (let i = 0; i < bytes.length; i += 4) if (bytes[i + 3] === 255) for (let k = 0; k < 4; ++k) sums[k] += bytes[i + k];
  return [0, 1, 2].map((k) => 255 * sums[k] / sums[3]); })()`);

export const boundaryTests = {
  /** Colours and legends change with the choice; a click on the mesh shows the numbers of the file. */
  async boundary(context) {
    const {page} = await openPart(context, {mesh: box(), options: kMeasured});
    const wanted = vertices(context.workshop.read('boundary.ply').toString());
    const report = await page.evaluate(`document.getElementById('report-body').textContent`);
    assert.ok(/Walls and gaps.*wallsnonemeasured0\.5[89]\d*0\.6\(/.test(report), report);
    await show(page, ['mesh']);
    const glass = await look(page);
    const pictures = new Set([glass.mark]);
    for (const [colour, words] of [['thickness', 'thickness'], ['kappa1', 'kappa 1'], ['kappa2', 'kappa 2'], ['shape', 'saddle']]) {
      await selectOption(page, 'mesh-colour', colour);
      pictures.add((await look(page)).mark);
      assert.ok((await page.text('legend')).includes(words), await page.text('legend'));
    }
    // Curvatures of a box are all 0 or unknown: their pictures may be alike.
    assert.ok(pictures.size >= 3, `${pictures.size} pictures`);

    await selectOption(page, 'mesh-colour', 'thickness');
    assert.equal(await page.text('opacity-value'), '100 %');
    const [red, , blue] = await meanColour(page);
    assert.notEqual(Math.round(red), Math.round(blue));
    assert.equal(await vertexValues(page), null);
    const [x, y] = await page.evaluate(`(() => { const r = document.getElementById('view').getBoundingClientRect();
      return [r.left + r.width / 2, r.top + r.height / 2]; })()`);
    await page.click(x, y);
    const values = await vertexValues(page);
    assert.ok(values, 'no vertex was picked');
    const vertex = wanted[Number(values.vertex)];
    assert.equal(values.kind, ['none', 'facets', 'crease', 'corner', 'wall'][vertex.thickness_kind]);
    // Three digits are shown.
    const [lower, upper] = numbersIn(values.thickness);
    assert.ok(Math.abs(lower - vertex.thickness_lower) <= 0.005 * vertex.thickness_lower, `${values.thickness}`);
    assert.ok(Math.abs(upper - vertex.thickness_upper) <= 0.005 * vertex.thickness_upper, `${values.thickness}`);
    assert.equal(values['kappa 1'] === 'unknown', Number.isNaN(vertex.kappa_1));

    await page.click(3, 3);
    assert.equal(await vertexValues(page), null, 'beside the mesh nothing is picked');
    await selectOption(page, 'mesh-colour', '');
    await page.evaluate(`{ const e = document.getElementById('opacity'); e.value = 50; e.dispatchEvent(new Event('input')); }`);
    assert.equal((await look(page)).mark, glass.mark, 'the mesh is glass again');
    assertQuiet(page);
  },

  /** Strokes along principal directions come and go with their box, and with the mesh. */
  async boundary_strokes(context) {
    const options = ['--resolution', '24', '--object-angle', '0.3', '--curvature', '--boundary', 'boundary.ply'];
    const {page} = await openPart(context, {mesh: ellipsoid(), options});
    assert.equal(await page.evaluate(`document.getElementById('offer-strokes').hidden`), false);
    await show(page, ['mesh']);
    const without = await look(page);
    assert.ok(!(await page.text('legend')).includes('strokes'));
    await page.evaluate(`document.getElementById('strokes').click()`);
    assert.notEqual((await look(page)).mark, without.mark);
    assert.ok((await page.text('legend')).includes('strokes: long along kappa 1'), await page.text('legend'));
    // Each is a rectangle of ink before one of white, within the plane of its surface and near it.
    const [count, farthest] = await page.evaluate(`(() => { const {viewer} = window.medialVk;
      const places = viewer.strokes.geometry.getAttribute('position').array, {vertices} = viewer.scene;
      let farthest = 0;
      for (let i = 0; i < places.length; i += 3) { let nearest = Infinity;
        for (let v = 0; v < vertices.length; v += 3) nearest = Math.min(nearest, Math.hypot(places[i] - vertices[v],
          places[i + 1] - vertices[v + 1], places[i + 2] - vertices[v + 2]));
        farthest = Math.max(farthest, nearest); }
      return [places.length / 18, farthest]; })()`);
    assert.ok(count > 0 && count % 2 === 0, `${count} rectangles`);
    // Half of the longest stroke with its margin, half its width and the lift, in radii of a shape whose longest side is
    // 1, and the rounding of single precision.
    assert.ok(farthest <= (0.0255 + 0.005 + 0.005) * Math.sqrt(3) / 2 + 1e-6, `${farthest}`);
    await page.evaluate(`document.getElementById('layer-mesh').click()`);
    assert.equal(await page.evaluate(`window.medialVk.viewer.strokes.visible`), false);
    assertQuiet(page);
  },

  async boundary_not_measured(context) {
    const {page} = await openPart(context, {mesh: box()});
    assert.ok(await page.evaluate(`document.getElementById('boundary').hidden`));
    assert.ok(await page.evaluate(`document.getElementById('offer-strokes').hidden`));
    await page.click(400, 300);
    assert.equal(await vertexValues(page), null);
    assertQuiet(page);
  },
};
