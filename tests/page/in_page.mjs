// Functions that run inside the page, transferred as text.

/** The content of the canvas: share of drawn pixels, number of colours, and a number that distinguishes pictures. */
export function look() {
  const {viewer} = window.medialVk;
  viewer.drawNow(false);
  const gl = viewer.renderer.getContext();
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
  const bytes = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const pixels = new Uint32Array(bytes.buffer);
  let drawn = 0, mark = 0;
  const colours = new Set();
  for (const pixel of pixels) {
    if (pixel >>> 24) ++drawn;
    colours.add(pixel);
    mark = Math.imul(mark, 31) + pixel | 0;
  }
  return {share: drawn / pixels.length, colours: colours.size, mark};
}

/** The bounds of the mesh on the canvas, from -1 to 1 (left, bottom, right, top), and the height of the legend below. */
export function modelBounds() {
  const {viewer} = window.medialVk;
  const {vertices} = viewer.scene;
  const bounds = [Infinity, Infinity, -Infinity, -Infinity];
  const position = viewer.camera.position.clone();
  for (let i = 0; i < vertices.length; i += 3) {
    const {x, y} = position.fromArray(vertices, i).applyMatrix4(viewer.model.matrixWorld).project(viewer.camera);
    [x, y].forEach((value, k) => {
      bounds[k] = Math.min(bounds[k], value);
      bounds[k + 2] = Math.max(bounds[k + 2], value);
    });
  }
  const stage = document.getElementById('stage').getBoundingClientRect();
  const legend = document.getElementById('legend').getBoundingClientRect();
  return {bounds, strip: legend.width === stage.width ? 2 * legend.height / stage.height : 0};
}

/** Contrast (WCAG 2) of every visible text with its background; the worst first. */
export function contrasts() {
  // Through a canvas, which accepts every notation of a colour.
  const brush = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  const parse = (text) => {
    brush.clearRect(0, 0, 1, 1);
    brush.fillStyle = text;
    brush.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = brush.getImageData(0, 0, 1, 1).data;
    return {rgb: [r, g, b], opaque: a === 255};
  };
  const light = ({rgb}) => {
    const [r, g, b] = rgb.map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour.opaque) return colour;
    }
    return parse('canvas');
  };
  const found = [];
  for (const element of document.body.querySelectorAll('*')) {
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!(own || element.matches('input[type=number]')) || element.matches('script, style, noscript, option')) continue;
    if (!element.checkVisibility({visibilityProperty: true}) || element.matches(':disabled')) continue;
    const a = light(parse(getComputedStyle(element).color)), b = light(behind(element));
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    found.push({ratio, text: `${element.tagName} ${element.id} ${element.textContent.trim().slice(0, 30)}`});
  }
  return found.sort((x, y) => x.ratio - y.ratio);
}

/** Controls without a name of their own. */
export function nameless() {
  return [...document.querySelectorAll('button, input, select')].filter((element) =>
    !(element.labels?.length || element.textContent.trim() || element.getAttribute('aria-label'))).map((e) => e.id);
}

/** Elements that extend beyond the right edge of the screen, except those in an element that scrolls by itself. */
export function tooWide() {
  const wide = document.documentElement.clientWidth;
  const scrolls = (element) => {
    for (let e = element.parentElement; e; e = e.parentElement) {
      if (e.matches('.wide, pre')) return true;
    }
    return false;
  };
  return [...document.body.querySelectorAll('*')].filter((e) => e.checkVisibility() && !scrolls(e) &&
    e.getBoundingClientRect().right > wide + 0.5).map((e) => `${e.tagName} ${e.id}`);
}
