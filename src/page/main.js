// From the data in the page to an interactive picture.
import {Controls} from './controls.js';
import {readReport, readScene} from './data.js';
import {byId, markComplete, markReady, openCanvas, showInstead} from './page_parts.js';
import {showReport} from './report.js';
import {Viewer} from './viewer.js';

function start() {
  const report = readReport();
  showReport(byId('report-body'), report);
  const {canvas, context} = openCanvas();
  if (!context) {
    new Controls(null, null, report).describeRun();
    showInstead('This browser cannot draw the model: it has no WebGL 2. The report of the run follows.', byId('report-body'));
    return;
  }
  const scene = readScene();
  const viewer = new Viewer(canvas, context, scene);
  const controls = new Controls(viewer, scene, report);
  controls.start();
  viewer.drawNow(false);
  markReady(viewer);
  setTimeout(() => {
    viewer.addCreases();
    markComplete();
  }, 50);
  window.medialVk = {viewer, controls};  // For the console of the browser.
}

start();
