// Colours of the attributes, and of the page itself in its light and dark themes.

// Ten samples of viridis, evenly spaced: the map of --picture.
const kViridis = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]];

// One colour per sheet, in turn: those of Okabe and Ito, which all readers can distinguish, then paler or darker ones.
const kSheets = [[230, 159, 0], [86, 180, 233], [0, 158, 115], [213, 94, 0], [204, 121, 167], [240, 228, 66],
  [0, 114, 178], [168, 216, 160], [150, 90, 40], [176, 160, 224], [250, 180, 160], [110, 130, 40]];

export const kSheetColours = kSheets.length;

const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
export const kViridisCss = kViridis.map(css);
export const viridisGradient = () => `linear-gradient(to right, ${kViridisCss.join(', ')})`;
export const sheetTexel = (sheet) => kSheets[sheet % kSheets.length];
export const sheetColour = (sheet) => sheet < 0 ? 'rgb(140 148 158)' : css(sheetTexel(sheet));

/** Red, green and blue from 0 to 255. */
export function viridis(share) {
  const place = share * (kViridis.length - 1);
  const below = Math.min(Math.floor(place), kViridis.length - 2);
  return kViridis[below].map((c, i) => Math.round(c + (place - below) * (kViridis[below + 1][i] - c)));
}

export const viridisColour = (share) => css(viridis(share));

/** 256 x 2 texels: the map of numbers, and the colours of sheets. */
export function colourTexels() {
  const texels = new Uint8Array(4 * 512).fill(255);
  for (let i = 0; i < 256; ++i) texels.set(viridis(i / 255), 4 * i);
  kSheets.forEach((colour, i) => texels.set(colour, 4 * (256 + i)));
  return texels;
}

export const kThemes = {
  light: {glass: [0.58, 0.67, 0.77], crease: [0.16, 0.20, 0.26], picked: [0.93, 0.42, 0.05], spokeA: [0.80, 0.16, 0.10],
          spokeB: [0.05, 0.32, 0.70]},
  dark: {glass: [0.60, 0.70, 0.82], crease: [0.80, 0.86, 0.94], picked: [1.0, 0.62, 0.22], spokeA: [1.0, 0.48, 0.40],
         spokeB: [0.48, 0.74, 1.0]},
};

/** The attributes for colouring; `component` is the index in the kernels' `values`. */
export const kAttributes = {
  angle: {component: 0, label: 'object angle (rad)'},
  radius: {component: 1, label: 'radius (units of the mesh)'},
  flux: {component: 2, label: 'flux (no unit)'},
  sheet: {component: 3, label: 'sheet (number)'},
  side: {component: 4, label: 'side of the mesh'},
};
