// From the surface in the page to an interactive picture.
import {byId, markComplete, markReady, openCanvas, showInstead} from '../page_parts.js';
import {SurfaceControls, SurfaceText} from './controls.js';
import {readGeometry, readNumbers} from './data.js';
import {SurfaceViewer} from './viewer.js';

function start() {
  const numbers = readNumbers();
  const text = new SurfaceText(numbers);
  text.describe();
  const {canvas, context} = openCanvas();
  if (!context) {
    showInstead('This browser cannot draw the surface: it has no WebGL 2. Its numbers follow.', byId('numbers-part'));
    return;
  }
  const viewer = new SurfaceViewer(canvas, context, numbers, readGeometry(numbers));
  const controls = new SurfaceControls(viewer, numbers, text);
  controls.start();
  viewer.drawNow(false);
  markReady(viewer);
  markComplete();
  window.medialVk = {viewer, controls};  // For the console of the browser.
}

start();
