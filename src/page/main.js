// From the data in the page to an interactive picture.
import {Controls} from './controls.js';
import {readReport, readScene} from './data.js';
import {showReport} from './report.js';
import {Viewer} from './viewer.js';

const byId = (id) => document.getElementById(id);

/** Without WebGL 2 only the report can be shown. */
function showReportAlone(why) {
  document.body.classList.add('no-drawing');
  byId('sentence').textContent = `${why} The report of the run follows.`;
  byId('sentence').hidden = false;
  byId('stage').append(byId('report-body'));
}

/** `data-ready` is the time to the first frame, in milliseconds since the request of the page; `data-complete` is set
 * when nothing remains to be added. */
function markReady(viewer) {
  viewer.finish();
  document.documentElement.dataset.ready = Math.round(performance.now());
}

function start() {
  const report = readReport();
  showReport(byId('report-body'), report);
  const canvas = byId('view');
  const context = canvas.getContext('webgl2', {antialias: false, alpha: true, depth: true});
  if (!context) {
    const controls = new Controls(null, null, report);
    controls.describeRun();
    showReportAlone('This browser cannot draw the model: it has no WebGL 2.');
    Object.assign(document.documentElement.dataset, {ready: Math.round(performance.now()), complete: ''});
    return;
  }
  canvas.addEventListener('webglcontextlost', () => {
    byId('sentence').textContent = 'The graphics device was lost; the picture comes back when it does.';
    byId('sentence').hidden = false;
  });
  canvas.addEventListener('webglcontextrestored', () => { byId('sentence').hidden = true; });

  const scene = readScene();
  const viewer = new Viewer(canvas, context, scene);
  const controls = new Controls(viewer, scene, report);
  controls.start();
  viewer.drawNow(false);
  markReady(viewer);
  setTimeout(() => {
    viewer.addCreases();
    document.documentElement.dataset.complete = '';
  }, 50);
  window.medialVk = {viewer, controls};  // For the console of the browser.
}

start();
