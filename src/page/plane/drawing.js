// Draws the shape and the axis on a canvas, in a view that moves and zooms.
import {viridisColour} from '../colours.js';
import {kAngle, kNumbers, kRadius} from './axis.js';

const kColours = 48;  // a path for each
const kPathColour = 'rgb(217 26 26)';

function ringsPath({boundary, rings}) {
  const path = new Path2D();
  for (let ring = 0; ring + 1 < rings.length; ++ring) {
    for (let i = rings[ring]; i < rings[ring + 1]; ++i) {
      path[i === rings[ring] ? 'moveTo' : 'lineTo'](boundary[2 * i], boundary[2 * i + 1]);
    }
    path.closePath();
  }
  return path;
}

/** One path for each colour. A piece whose colours differ at its ends is drawn in parts. */
function axisPaths({samples, lines}, component, [least, greatest]) {
  const paths = Array.from({length: kColours}, () => new Path2D());
  const colourOf = (value) => {
    const share = greatest > least ? (value - least) / (greatest - least) : 0;
    return Math.round(Math.min(1, Math.max(0, share)) * (kColours - 1));
  };
  for (let branch = 0; branch + 1 < lines.length; ++branch) {
    let colour = -1;
    for (let i = lines[branch]; i + 1 < lines[branch + 1]; ++i) {
      const at = (k, share) => (1 - share) * samples[kNumbers * i + k] + share * samples[kNumbers * (i + 1) + k];
      const parts = Math.abs(colourOf(at(component, 0)) - colourOf(at(component, 1))) + 1;
      for (let part = 0; part < parts; ++part) {
        const from = part / parts, to = (part + 1) / parts, next = colourOf(at(component, (from + to) / 2));
        if (next !== colour) paths[next].moveTo(at(0, from), at(1, from));
        colour = next;
        paths[colour].lineTo(at(0, to), at(1, to));
      }
    }
  }
  return paths;
}

export class Drawing {
  constructor(canvas, plane) {
    Object.assign(this, {canvas, plane, context: canvas.getContext('2d')});
    this.shape = ringsPath(plane);
    this.all = axisPaths(plane, kRadius, [0, 0])[0];
    this.layers = {shape: true, axis: true, nodes: true, discs: false};
    this.discs = [];
    this.here = null;
    this.colourBy('radius');
    this.fit();
  }

  colourBy(what) {
    this.paths = axisPaths(this.plane, what === 'radius' ? kRadius : kAngle, this.plane.ranges[what]);
  }

  /** Everything in view. */
  fit() {
    const {lower, upper} = this.plane;
    const wide = Math.max(upper[0] - lower[0], 1e-300), high = Math.max(upper[1] - lower[1], 1e-300);
    const {width, height} = this.size();
    this.scale = 0.9 * Math.min(width / wide, height / high);
    this.least = this.scale / 20;
    this.middle = [(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2];
  }

  size() {
    return {width: Math.max(this.canvas.clientWidth, 1), height: Math.max(this.canvas.clientHeight, 1)};
  }

  /** Up in the picture is up in the plane, except in SVG. */
  get flip() { return this.plane.y_is_down ? 1 : -1; }

  toPlane(x, y) {
    const {width, height} = this.size();
    return [this.middle[0] + (x - width / 2) / this.scale, this.middle[1] + this.flip * (y - height / 2) / this.scale];
  }

  move(dx, dy) {
    this.middle[0] -= dx / this.scale;
    this.middle[1] -= this.flip * dy / this.scale;
  }

  /** The point of the plane at (x, y) of the canvas stays there. */
  zoom(factor, x, y) {
    const [u, v] = this.toPlane(x, y);
    this.scale = Math.min(Math.max(this.scale * factor, this.least), this.least * 1e9);
    const [p, q] = this.toPlane(x, y);
    this.middle[0] += u - p;
    this.middle[1] += v - q;
  }

  /** Draws with the next picture of the screen. */
  request() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.draw(); });
  }

  draw() {
    const {canvas, context, scale, layers} = this;
    const {width, height} = this.size(), ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const style = getComputedStyle(document.documentElement);
    const ink = (name) => style.getPropertyValue(name).trim();
    context.setTransform(ratio * scale, 0, 0, ratio * scale * this.flip, ratio * (width / 2 - scale * this.middle[0]),
      ratio * (height / 2 - scale * this.flip * this.middle[1]));
    context.lineJoin = context.lineCap = 'round';
    const stroke = (path, colour, pixels) => {
      context.strokeStyle = colour;
      context.lineWidth = pixels / scale;
      context.stroke(path);
    };
    if (layers.shape) {
      context.fillStyle = ink('--glass');
      context.fill(this.shape, 'evenodd');
      stroke(this.shape, ink('--rim'), 1.2);
    }
    if (layers.discs) this.drawDiscs(this.discs, ink('--rim'));
    if (layers.axis) {
      stroke(this.all, ink('--halo'), 5);
      this.paths.forEach((path, i) => stroke(path, viridisColour(i / (kColours - 1)), 2.6));
    }
    if (this.plane.path.length > 0) {
      const path = this.route();
      stroke(path, ink('--halo'), 6);
      stroke(path, kPathColour, 3.2);
    }
    if (layers.nodes) this.drawNodes(ink('--ink'), ink('--paper'));
    if (this.here) this.drawHere(ink('--accent'));
  }

  /** The widest path between sites, if one was asked for. */
  route() {
    const {path} = this.plane, route = new Path2D();
    for (let i = 0; i < path.length; i += 2) route.lineTo(path[i], path[i + 1]);
    return route;
  }

  drawDiscs(discs, colour) {
    const {context, scale} = this;
    context.strokeStyle = colour;
    context.lineWidth = 1 / scale;
    for (const [x, y, radius] of discs) {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  drawNodes(ink, paper) {
    const {context, scale} = this, {nodes} = this.plane;
    for (let i = 0; i < nodes.length; i += 3) {
      context.beginPath();
      context.arc(nodes[i], nodes[i + 1], (nodes[i + 2] === 1 ? 2.2 : 3.4) / scale, 0, 2 * Math.PI);
      context.fillStyle = nodes[i + 2] === 1 ? ink : paper;
      context.fill();
      context.strokeStyle = ink;
      context.lineWidth = 1.4 / scale;
      context.stroke();
    }
  }

  drawHere(colour) {
    const {context, scale, here} = this;
    context.beginPath();
    context.arc(here.x, here.y, here.radius, 0, 2 * Math.PI);
    context.strokeStyle = colour;
    context.lineWidth = 2 / scale;
    context.stroke();
    context.beginPath();
    context.arc(here.x, here.y, 4.5 / scale, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
  }
}
