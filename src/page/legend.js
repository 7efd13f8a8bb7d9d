// Parts of legends.

/** `colours` of CSS from end to end; `numbers` as text. */
export function barOf(colours, numbers) {
  const bar = document.createElement('div'), ends = document.createElement('div');
  bar.className = 'bar';
  bar.style.background = `linear-gradient(to right, ${colours.join(', ')})`;
  ends.className = 'ends';
  ends.append(...numbers.map((text) => Object.assign(document.createElement('span'), {textContent: text})));
  return [bar, ends];
}

/** Rows of a colour and its meaning; without a colour, of a text alone. */
export function swatchesOf(rows) {
  const list = document.createElement('ul');
  for (const [colour, text] of rows) {
    const item = document.createElement('li');
    if (colour) {
      const swatch = document.createElement('i');
      swatch.style.background = colour;
      item.append(swatch);
    }
    item.append(text);
    list.append(item);
  }
  return list;
}
