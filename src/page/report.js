// The report of the run in readable form: docs/report.md explains the keys.
import {bytes, plain} from './format.js';
import {element, tableOf} from './page_parts.js';

const kBytes = new Set(['memory_bytes']);
const kHidden = new Set(['format', 'program', 'version', 'input', 'output', 'seconds', 'assumptions']);
const kTitles = {
  parameters: 'Parameters', mesh: 'Mesh', grid: 'Grid', voxels: 'Voxels', levels: 'Levels', points: 'Points',
  device: 'Device', certificate: 'Check', union: 'Union of the balls', grouping: 'Grouping into sheets',
  medial_mesh: 'Medial mesh', sheets: 'Sheets', fatness: 'Fatness: overlap of neighbouring balls',
};
const kNames = {
  undecided_kinds: 'undecided: ', object_angle: 'object angle', api_version: 'Vulkan version',
  memory_bytes: 'memory',
};
// Counts of a mesh that matter even if 0; others are shown only if nonzero.
const kAlways = new Set(['vertices', 'triangles', 'components', 'open_edges', 'undecided', 'rejected', 'found',
  'written', 'proved_empty', 'radius', 'perturb', 'extra_levels', 'signed_volume', 'tunnels', 'cavities']);
const kSheets = 30;  // The limit of rows in the table.

const nameOf = (key) => kNames[key] ?? key.replaceAll('_', ' ');

function vulkanVersion(packed) {
  return `${packed >>> 22 & 127}.${packed >>> 12 & 1023}.${packed & 4095}`;
}

function textOf(key, value) {
  if (value === null) return 'none';
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (key === 'api_version') return vulkanVersion(value);
  if (key === 'seed') return String(value);
  if (typeof value === 'number') return kBytes.has(key) ? bytes(value) : plain(value);
  if (Array.isArray(value)) return value.map((x) => textOf(key, x)).join(key === 'size' ? ' × ' : ', ');
  if (typeof value === 'object' && 'least' in value) return `${plain(value.least)} to ${plain(value.greatest)}`;
  return String(value);
}

function rows(list, object, prefix = '') {
  for (const [key, value] of Object.entries(object)) {
    if (kHidden.has(key) || (value === 0 && !kAlways.has(key))) continue;
    const nested = value !== null && typeof value === 'object' && !Array.isArray(value) && !('least' in value);
    if (nested) {
      rows(list, value, key === 'undecided_kinds' ? 'undecided, ' : `${nameOf(key)}, `);
    } else {
      list.append(element('dt', prefix + nameOf(key)), element('dd', textOf(key, value)));
    }
  }
  return list;
}

/** An array of objects with the same keys. */
function table(objects) {
  const keys = Object.keys(objects[0]).filter((key) => objects.some((object) => object[key] !== 0 && object[key] !== ''));
  return tableOf(keys.map((key) => ({name: nameOf(key), number: typeof objects[0][key] === 'number'})),
    objects.map((object) => keys.map((key) => textOf(key, object[key]))));
}

function section(title, ...content) {
  return element('section', null, element('h3', title), ...content);
}

function run(report) {
  const list = element('dl');
  for (const [name, text] of [['input', report.input], ['output', report.output],
    ['made by', `${report.program} ${report.version}`]]) {
    list.append(element('dt', name), element('dd', text));
  }
  return section('Run', list);
}

function certificate(value) {
  if (!value) return section('Check', element('p', 'Not requested (--check).'));
  const verdict = value.passed ? 'Every ball satisfies its certificate.' : 'Some balls do not satisfy their certificate.';
  return section('Check', element('p', verdict), table(value.conditions));
}

/** The sheets with the most points. */
function sheets(all) {
  const shown = all.slice(0, kSheets);
  const more = all.length - shown.length;
  return section(kTitles.sheets, table(shown), ...(more > 0 ? [element('p', `and ${plain(more)} more`)] : []));
}

/** For which voxels and object angles the solid is fat. */
function fatness({proved, angles}) {
  const text = proved ? 'Proved: no medial point of object angle ' + plain(proved.object_angle) + ' or more has a radius below '
    + plain(proved.least_radius) + '.' : 'By the points; there is no proof for all medial points.';
  return section(kTitles.fatness, element('p', text), table(angles));
}

/** The least walls and gaps. */
function walls(all) {
  const rows = all.map(({side, demanded, verdict, proved, thinnest}) => [side, demanded === null ? 'none' : plain(demanded),
    verdict, plain(proved), thinnest ? plain(2 * thinnest.radius) : 'none',
    thinnest ? thinnest.contacts.map((at) => `(${at.map(plain).join(', ')})`).join(' and ') : '']);
  const columns = [['of'], ['demanded', true], ['verdict'], ['none is thinner than', true], ['thinnest found', true], ['between']];
  return section('Walls and gaps', tableOf(columns.map(([name, number = false]) => ({name, number})), rows));
}

/** Fills `target`. */
export function showReport(target, report) {
  target.append(run(report));
  for (const key of ['points', 'union', 'medial_mesh', 'voxels', 'parameters', 'mesh', 'grid', 'grouping']) {
    if (report[key]) target.append(section(kTitles[key], rows(element('dl'), report[key])));
    const assumptions = report[key]?.assumptions ?? [];
    if (assumptions.length) target.lastChild.append(element('ul', null, ...assumptions.map((x) => element('li', x))));
  }
  if (report.sides) target.append(section('Sides', table(report.sides)));
  if (report.sheets?.length) target.append(sheets(report.sheets));
  if (report.fatness) target.append(fatness(report.fatness));
  if (report.boundary?.walls?.length) target.append(walls(report.boundary.walls));
  if (report.levels?.length) target.append(section(kTitles.levels, table(report.levels)));
  target.append(certificate(report.certificate));
  target.append(report.device ? section(kTitles.device, rows(element('dl'), report.device))
    : section(kTitles.device, element('p', 'None: the reference on the CPU.')));
  const raw = element('details', null, element('summary', 'As JSON (but for the times)'),
    element('pre', JSON.stringify(report, null, 2)));
  raw.lastChild.tabIndex = 0;
  target.append(raw);
}
