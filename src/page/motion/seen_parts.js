// Which balls can be seen, and where on the screen. Balls that fill a solid overlap so much that drawing each as a whole
// paints every pixel dozens of times, which takes seconds where the CPU draws. A coarse picture of their numbers, made
// here, tells the rectangle that holds the seen part of each; together these are about twice the picture.

export class SeenParts {
  constructor(count) {
    this.rectangles = new Float32Array(4 * count);  // Of the seen balls: left, bottom, right, top, from -1 to 1.
    this.seen = new Uint32Array(count);             // Their numbers.
    this.boxes = new Int32Array(4 * count);         // By ball, in cells.
    this.cells = 0;
  }

  resize(width, height) {
    if (this.width === width && this.height === height) return;
    this.width = width;
    this.height = height;
    this.depth = new Float32Array(width * height);
    this.owner = new Int32Array(width * height);
  }

  /** `balls`: centres and radii; `toView`: elements of the matrix to view space, whose scale is 1; `projection`: elements
   * of the matrix from there; the picture has `width` x `height` cells. The result is the number of seen balls. */
  find(balls, toView, projection, width, height) {
    this.resize(width, height);
    this.depth.fill(Infinity);
    this.owner.fill(-1);
    for (let i = 0; 4 * i < balls.length; ++i) this.paint(i, balls, toView, projection);
    return this.collect(balls.length / 4);
  }

  /** Paints a ball where it is nearer than those before. */
  paint(i, balls, m, projection) {
    const r = balls[4 * i + 3];
    if (!(r > 0)) return;
    const bx = balls[4 * i], by = balls[4 * i + 1], bz = balls[4 * i + 2];
    const x = m[0] * bx + m[4] * by + m[8] * bz + m[12], y = m[1] * bx + m[5] * by + m[9] * bz + m[13];
    const away = -(m[2] * bx + m[6] * by + m[10] * bz + m[14]);
    const c = x * x + y * y + away * away - r * r;
    if (away <= r || c <= 0) return;  // Beside or behind the eye.
    const {width, height, depth, owner} = this;
    // A line of sight is (X, Y, -1): a cell's column is sx X + tx.
    const sx = width / 2 * projection[0], tx = width / 2 * (1 - projection[8]);
    const sy = height / 2 * projection[5], ty = height / 2 * (1 - projection[9]);
    const columns = rangeOf(x, away, r, sx, tx, width), lines = rangeOf(y, away, r, sy, ty, height);
    const nearest = away - r;
    for (let line = lines[0]; line < lines[1]; ++line) {
      const Y = (line + 0.5 - ty) / sy, atLine = Y * Y + 1, bLine = y * Y + away;
      for (let column = columns[0]; column < columns[1]; ++column) {
        const cell = line * width + column;
        if (nearest >= depth[cell]) continue;
        const X = (column + 0.5 - tx) / sx;
        const a = X * X + atLine, b = x * X + bLine, square = b * b - a * c;
        if (square < 0) continue;
        const t = (b - Math.sqrt(square)) / a;
        if (t < depth[cell]) {
          depth[cell] = t;
          owner[cell] = i;
        }
      }
    }
  }

  /** The rectangles, a cell larger on each side: a seen part may end between the middles of two cells. */
  collect(count) {
    const {width, height, owner, boxes} = this;
    for (let i = 0; i < count; ++i) boxes.set([width, height, -1, -1], 4 * i);
    for (let line = 0, cell = 0; line < height; ++line) {
      for (let column = 0; column < width; ++column, ++cell) {
        const k = 4 * owner[cell];
        if (k < 0) continue;
        if (column < boxes[k]) boxes[k] = column;
        if (line < boxes[k + 1]) boxes[k + 1] = line;
        if (column > boxes[k + 2]) boxes[k + 2] = column;
        if (line > boxes[k + 3]) boxes[k + 3] = line;
      }
    }
    let seen = 0;
    for (let i = 0; i < count; ++i) {
      const k = 4 * i, s = 4 * seen;
      if (boxes[k + 2] < 0) continue;
      this.rectangles[s] = 2 * (boxes[k] - 1) / width - 1;
      this.rectangles[s + 1] = 2 * (boxes[k + 1] - 1) / height - 1;
      this.rectangles[s + 2] = 2 * (boxes[k + 2] + 2) / width - 1;
      this.rectangles[s + 3] = 2 * (boxes[k + 3] + 2) / height - 1;
      this.seen[seen++] = i;
    }
    return seen;
  }
}

/** The cells in one direction whose lines of sight can meet a ball at `x` to the side and `away`. */
function rangeOf(x, away, r, scale, shift, cells) {
  const middle = Math.atan2(x, away), half = Math.asin(r / Math.hypot(x, away));
  const least = Math.max(middle - half, -1.57), most = Math.min(middle + half, 1.57);
  return [Math.max(Math.floor(scale * Math.tan(least) + shift - 0.5), 0),
    Math.min(Math.ceil(scale * Math.tan(most) + shift + 0.5), cells)];
}
