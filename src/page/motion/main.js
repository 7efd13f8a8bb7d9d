// From the motion in the page to a picture that plays.
import {byId, markComplete, markReady, openCanvas, showInstead} from '../page_parts.js';
import {MotionControls, MotionText} from './controls.js';
import {readGeometry, readMotion} from './data.js';
import {MotionViewer} from './viewer.js';

function start() {
  const motion = readMotion();
  const text = new MotionText(motion);
  text.describe();
  const {canvas, context} = openCanvas();
  const why = !context ? 'This browser cannot draw the motion: it has no WebGL 2.'
    : motion.shown.length === 0 ? 'The page was made without the meshes of the frames.' : null;
  if (why) {
    text.makeTable();
    showInstead(`${why} The numbers of all frames follow.`, byId('frames-body'));
    return;
  }
  const viewer = new MotionViewer(canvas, context, motion, readGeometry(motion));
  const controls = new MotionControls(viewer, motion, text);
  controls.start();
  viewer.drawNow(false);
  markReady(viewer);
  markComplete();
  window.medialVk = {viewer, controls, player: controls.player, motion};  // For the console of the browser.
}

start();
