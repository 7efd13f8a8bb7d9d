// Solids, runs of the tool, and medial PLY files in the form that the tests use.
import {spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

/** A prism over a polygon (x, y), from z = 0 to `height`, moved. */
function prism(polygon, triangles, height, [dx, dy, dz]) {
  const n = polygon.length;
  const lines = [0, height].flatMap((z) => polygon.map(([x, y]) => `v ${x + dx} ${y + dy} ${z + dz}`));
  for (const [a, b, c] of triangles) lines.push(`f ${c + 1} ${b + 1} ${a + 1}`, `f ${a + n + 1} ${b + n + 1} ${c + n + 1}`);
  for (let i = 0; i < n; ++i) {
    const j = (i + 1) % n;
    lines.push(`f ${i + 1} ${j + 1} ${j + n + 1} ${i + n + 1}`);
  }
  return `${lines.join('\n')}\n`;
}

/** 1 x 0.6 x 0.8. */
export const box = () => prism([[0, 0], [1, 0], [1, 0.6], [0, 0.6]], [[0, 1, 2], [0, 2, 3]], 0.8, [0, 0, 0]);

/** Semiaxes 1, 0.7 and 0.4, by rings of vertices around z. */
export function ellipsoid(rings = 12, around = 24) {
  const lines = ['v 0 0 0.4'];
  for (let i = 1; i < rings; ++i) {
    for (let k = 0; k < around; ++k) {
      const tilt = Math.PI * i / rings, turn = 2 * Math.PI * k / around;
      lines.push(`v ${Math.sin(tilt) * Math.cos(turn)} ${0.7 * Math.sin(tilt) * Math.sin(turn)} ${0.4 * Math.cos(tilt)}`);
    }
  }
  lines.push('v 0 0 -0.4');
  const at = (i, k) => (i === 0 ? 1 : i === rings ? 2 + (rings - 1) * around : 2 + (i - 1) * around + k % around);
  for (let i = 0; i < rings; ++i) {
    for (let k = 0; k < around; ++k) {
      if (i + 1 < rings) lines.push(`f ${at(i, k)} ${at(i + 1, k)} ${at(i + 1, k + 1)}`);
      if (i > 0) lines.push(`f ${at(i, k)} ${at(i + 1, k + 1)} ${at(i, k + 1)}`);
    }
  }
  return `${lines.join('\n')}\n`;
}

/** No two faces are parallel, so no spokes point in opposite directions. */
export const tetrahedron = () => 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';

export function lShape(moved = [0, 0, 0]) {
  const polygon = [[0, 0], [2, 0], [2, 0.6], [0.6, 0.6], [0.6, 2], [0, 2]];
  return prism(polygon, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], 0.8, moved);
}

/** A folder that is removed after the test, and the tool in it. */
export class Workshop {
  constructor(tool) {
    this.tool = resolve(tool);
    this.folder = mkdtempSync(join(tmpdir(), 'medial-vk-page-files-'));
  }

  path(name) { return join(this.folder, name); }
  url(name) { return pathToFileURL(this.path(name)).href; }
  write(name, text) { writeFileSync(this.path(name), text); }
  read(name) { return readFileSync(this.path(name)); }
  close() { rmSync(this.folder, {recursive: true, force: true}); }

  run(...options) {
    const result = spawnSync(this.tool, options, {cwd: this.folder, encoding: 'utf8'});
    if (result.status !== 0) throw Object.assign(new Error(`medial-vk: ${result.error?.message ?? result.stderr}`), {status: result.status});
  }

  /** Writes the mesh, runs the reference on it and returns its points; the page is page.html. */
  make(mesh, options = [], name = 'part.obj') {
    this.write(name, mesh);
    this.run(`./${name}`, '-o', 'points.ply', '--html', 'page.html', '--backend', 'cpu', '-q', ...options);
    return readPly(this.read('points.ply'));
  }
}

/** Reads a binary medial PLY as docs/formats.md defines it. */
export function readPly(bytes) {
  const mark = 'end_header\n';
  const begin = bytes.indexOf(mark) + mark.length;
  const header = bytes.toString('latin1', 0, begin);
  const word = (name) => header.match(new RegExp(`${name} (.*)`))[1].split(' ').map(Number);
  const count = word('element vertex')[0], origin = word('grid_origin'), voxel = word('voxel_size')[0];
  const kSize = 4 * 8 + 8 * 4 + 4;
  return Array.from({length: count}, (_, i) => {
    const at = begin + i * kSize;
    const double = (k) => bytes.readDoubleLE(at + 8 * k);
    const float = (k) => bytes.readFloatLE(at + 32 + 4 * k);
    const centre = [double(0), double(1), double(2)];
    return {
      centre, radius: double(3),
      spokes: [[float(0), float(1), float(2)], [float(3), float(4), float(5)]],
      angle: float(6), flux: float(7), sheet: bytes.readInt32LE(at + 64),
      voxel: centre.map((c, k) => Math.floor((c - origin[k]) / voxel)),
    };
  });
}
