// Bundles a page: its HTML with the styles, the program and the licences of its libraries, and the two marks where
// medial-vk writes the title and the data.
//   node bundle.mjs NODE_MODULES PAGE OUTPUT.html
// PAGE: one of kPages.
import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const kPages = {
  page: {html: 'page.html', style: 'page.css', script: 'main.js'},
  motion: {html: 'motion/motion.html', style: 'motion/motion.css', script: 'motion/main.js'},
  sites: {html: 'sites/sites.html', style: 'sites/sites.css', script: 'sites/main.js'},
  plane: {html: 'plane/plane.html', style: 'plane/plane.css', script: 'plane/main.js'},
};

const [packages, name, output] = process.argv.slice(2);
const sources = kPages[name];
if (!sources) throw new Error(`no page ${name}; there are: ${Object.keys(kPages).join(' ')}`);
const here = dirname(fileURLToPath(import.meta.url));
const {buildSync} = createRequire(join(packages, 'any.js'))('esbuild');

function bundle(entry) {
  const result = buildSync({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome100', 'firefox100', 'safari15.4'],
    loader: {'.glsl': 'text'},
    nodePaths: [packages],
    legalComments: 'none',  // The full licence is part of the page.
    charset: 'ascii',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

/** Only code of the build may run in the page, and nothing may be fetched, for any data. */
function policy(script, style) {
  const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
  return `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src data: blob:; base-uri 'none'`;
}

function fill(template, parts) {
  return template.replace(/<!--build: (\w+)-->/g, (_, name) => {
    if (!(name in parts)) throw new Error(`${sources.html} requires ${name}, which is missing`);
    return parts[name];
  });
}

const script = bundle(sources.script);
const style = bundle(sources.style);
if (/<\/script|<!--/i.test(script)) throw new Error('the program would end its own element');
const version = JSON.parse(readFileSync(join(packages, 'three/package.json'))).version;
const page = fill(readFileSync(join(here, sources.html), 'utf8'), {
  policy: policy(script, style),
  licence: `<!--\nThis page draws with three.js ${version}:\n\n${readFileSync(join(packages, 'three/LICENSE'), 'utf8').trim()}\n-->`,
  style: `<style>${style}</style>`,
  script: `<script>${script}</script>`,
});
for (const mark of ['<!--medial-vk: title-->', '<!--medial-vk: data-->']) {
  if (page.split(mark).length !== 2) throw new Error(`${mark} must occur once`);
}
writeFileSync(output, page);
