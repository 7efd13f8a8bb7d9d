// Runs one test of a page in headless Chromium.
//   node run.mjs TOOL TEST
// TOOL: medial-vk, or make_motion_page for the tests of the page of a motion, whose names begin with motion_.
// The exit code is 77 if there is no Chromium, or if the tool was built without its page.
import {boundaryTests} from './boundary_tests.mjs';
import {Browser, findChromium} from './browser.mjs';
import {Workshop} from './fixtures.mjs';
import {motionCoverTests} from './motion_cover_tests.mjs';
import {motionTests} from './motion_tests.mjs';
import {planeTests} from './plane_tests.mjs';
import {sideTests} from './side_tests.mjs';
import {sitesTests} from './sites_tests.mjs';
import {tests as pageTests} from './tests.mjs';
import {viewTests} from './view_tests.mjs';

const tests = {...pageTests, ...viewTests, ...boundaryTests, ...sideTests};
for (const [name, test] of Object.entries({...motionTests, ...motionCoverTests})) tests[`motion_${name}`] = test;
for (const [name, test] of Object.entries(planeTests)) tests[`plane_${name}`] = test;
for (const [name, test] of Object.entries(sitesTests)) tests[`sites_${name}`] = test;

function skip(why) {
  console.log(`SKIPPED: ${why}`);
  process.exit(77);
}

const [tool, name] = process.argv.slice(2);
const test = tests[name];
if (!test) throw new Error(`no test ${name}; there are: ${Object.keys(tests).join(' ')}`);
const chromium = findChromium();
if (!chromium) skip('no Chromium (Debian: apt install chromium; elsewhere: CHROMIUM=program)');

const workshop = new Workshop(tool);
const browser = new Browser(chromium, {webGl: !name.endsWith('no_webgl')});
try {
  await test({workshop, browser});
  console.log(`${name}: ok`);
} catch (error) {
  if (error.message.includes('was built without its page')) process.exitCode = 77;
  else process.exitCode = 1;
  console.log(process.exitCode === 77 ? `SKIPPED: ${error.message}` : error.stack);
} finally {
  await browser.close();
  workshop.close();
}
