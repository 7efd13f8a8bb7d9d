// Takes a picture of a page, for inspection.
//   node look.mjs PAGE.html PICTURE.png [dark] [phone] [SCRIPT] [size=WIDTHxHEIGHT] [clip=X,Y,WIDTH,HEIGHT]
// SCRIPT runs in the page first. A clip is enlarged eight times. The exit code is 77 if there is no Chromium.
import {writeFileSync} from 'node:fs';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

import {Browser, findChromium} from './browser.mjs';

const [page, picture, ...rest] = process.argv.slice(2);
const flags = new Set(rest.filter((word) => ['dark', 'phone'].includes(word)));
const given = (name, separator) => rest.find((word) => word.startsWith(name))?.slice(name.length).split(separator).map(Number);
const clip = given('clip=', ',');
const [width, height] = given('size=', 'x') ?? [1280, 800];
const script = rest.find((word) => !flags.has(word) && !/^(clip|size)=/.test(word));
const chromium = findChromium();
if (!chromium) {
  console.error('no Chromium (Debian: apt install chromium; elsewhere: CHROMIUM=program)');
  process.exit(77);
}
const browser = new Browser(chromium);
const size = flags.has('phone') ? {width: 360, height: 740, phone: true, scale: 2} : {width, height};
const tab = await browser.open({...size, dark: flags.has('dark')});
console.log(`first frame after ${await tab.load(pathToFileURL(resolve(page)).href)} ms`);
if (script) await tab.evaluate(script);
await new Promise((done) => { setTimeout(done, 1500); });
writeFileSync(picture, await tab.screenshot(clip));
if (tab.complaints.length || tab.requests.length) console.log(tab.complaints, tab.requests);
await browser.close();
