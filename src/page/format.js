// Numbers in readable form.

export const grouped = (n) => n.toLocaleString('en-US');

/** Seven significant digits relative to the size of the mesh, for any position: the precision of floats. */
export function lengthFormat(scale) {
  const digits = 6 - Math.floor(Math.log10(scale));
  if (!(digits >= 0 && digits <= 16)) return (x) => x.toExponential(6);
  return (x) => x.toFixed(digits);
}

/** Short, for the ends of a scale. */
export function brief(x) {
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e5 || size < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(3)));
}

/** Any number of a report. */
export function plain(x) {
  if (Number.isInteger(x)) return Math.abs(x) < 1e15 ? grouped(x) : x.toExponential(6);
  const size = Math.abs(x);
  return size >= 1e6 || size < 1e-4 ? x.toExponential(5) : String(Number(x.toPrecision(7)));
}

export function bytes(n) {
  const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
  let unit = 0;
  for (; n >= 1024 && unit + 1 < units.length; ++unit) n /= 1024;
  return `${Number(n.toPrecision(3))} ${units[unit]}`;
}
