// Chromium without a window, driven through two pipes by its own protocol: no library, no port.
import {spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

/** The path of the browser, or null. */
export function findChromium() {
  const names = [process.env.CHROMIUM, 'chromium', 'chromium-browser', 'google-chrome'];
  return names.find((name) => name && spawnSync(name, ['--version'], {stdio: 'ignore'}).status === 0) ?? null;
}

const kOptions = [
  '--headless=new', '--remote-debugging-pipe', '--no-first-run', '--no-default-browser-check', '--disable-sync',
  '--disable-extensions', '--disable-background-networking', '--disable-component-update', '--disable-dev-shm-usage',
  '--hide-scrollbars', '--mute-audio', '--force-color-profile=srgb', '--window-size=1280,800',
];
// The CPU draws: the same pixels on every machine.
const kSoftware = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const kNoWebGl = ['--disable-gpu', '--disable-3d-apis'];

export class Browser {
  /** `webGl` false: a browser that cannot draw in three dimensions. */
  constructor(program, {webGl = true} = {}) {
    this.profile = mkdtempSync(join(tmpdir(), 'medial-vk-page-'));
    const own = [`--user-data-dir=${this.profile}`, ...(process.getuid?.() === 0 ? ['--no-sandbox'] : [])];
    this.process = spawn(program, [...kOptions, ...own, ...(webGl ? kSoftware : kNoWebGl), 'about:blank'],
      {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true});
    this.pending = new Map();
    this.listeners = [];
    this.next = 1;
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (part) => {
      text += part;
      const messages = text.split('\0');
      text = messages.pop();
      messages.forEach((message) => this.receive(JSON.parse(message)));
    });
    this.process.on('exit', () => {
      for (const {reject} of this.pending.values()) reject(new Error('Chromium ended'));
    });
  }

  receive(message) {
    if (!message.id) return this.listeners.forEach((listener) => listener(message));
    const {resolve, reject} = this.pending.get(message.id);
    this.pending.delete(message.id);
    if (message.error) reject(new Error(message.error.message)); else resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, {resolve, reject});
      this.process.stdio[3].write(`${JSON.stringify({id, method, params, sessionId})}\0`);
    });
  }

  async open(options) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    const page = new Page(this, sessionId);
    await page.prepare(options);
    return page;
  }

  async close() {
    const ended = new Promise((resolve) => { this.process.once('exit', resolve); });
    this.send('Browser.close').catch(() => {});
    const timer = setTimeout(() => process.kill(-this.process.pid, 'SIGKILL'), 10000);
    await ended;
    clearTimeout(timer);
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 20, retryDelay: 100});
  }
}

const kKeys = {
  ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, Escape: 27, Enter: 13, Tab: 9, Home: 36, End: 35,
};

/** Remarks of the browser's driver on speed, which depend on the machine's load: a picked point is read back. */
const kPerformance = /GL Driver Message \(OpenGL, Performance/;

export class Page {
  constructor(browser, session) {
    this.browser = browser;
    this.session = session;
    this.complaints = [];  // Errors and warnings of the console, exceptions, violations of the policy.
    this.requests = [];    // All requests except that for the page itself.
    browser.listeners.push((message) => { if (message.sessionId === session) this.hear(message); });
  }

  send(method, params) { return this.browser.send(method, params, this.session); }

  hear({method, params}) {
    if (method === 'Runtime.exceptionThrown') {
      this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    } else if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) {
      this.complaints.push(params.args.map((arg) => arg.value ?? arg.description).join(' '));
    } else if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level) &&
               !kPerformance.test(params.entry.text)) {
      this.complaints.push(`${params.entry.text} ${params.entry.url ?? ''}`);
    } else if (method === 'Network.requestWillBeSent' && params.request.url !== this.url) {
      this.requests.push(params.request.url);
    }
  }

  async prepare({width = 1280, height = 800, dark = false, phone = false, scale = 1} = {}) {
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await this.send(`${domain}.enable`);
    await this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: scale, mobile: phone});
    await this.send('Emulation.setTouchEmulationEnabled', {enabled: phone});
    await this.send('Emulation.setEmulatedMedia',
      {features: [{name: 'prefers-color-scheme', value: dark ? 'dark' : 'light'}]});
  }

  /** Milliseconds from the request to the first frame, by the page's clock. */
  async load(url, limit = 120000) {
    this.url = url;
    const {errorText} = await this.send('Page.navigate', {url});
    if (errorText) throw new Error(`${url}: ${errorText}`);
    const end = Date.now() + limit;
    while (Date.now() < end) {
      const ready = await this.evaluate(`(({ready, complete}) => complete !== undefined && ready)
        (document.documentElement.dataset)`).catch(() => null);
      if (ready) return Number(ready);
      if (this.complaints.length) break;
      await new Promise((resolve) => { setTimeout(resolve, 20); });
    }
    throw new Error(`the page was not ready: ${this.complaints.join('; ')}`);
  }

  /** The value of an expression; promises are waited for. */
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate',
      {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  text(id) { return this.evaluate(`document.getElementById('${id}').textContent`); }

  async mouse(type, x, y, more = {}) {
    await this.send('Input.dispatchMouseEvent', {type, x, y, button: 'left', clickCount: 1, ...more});
  }

  async click(x, y) {
    await this.mouse('mousePressed', x, y, {buttons: 1});
    await this.mouse('mouseReleased', x, y);
  }

  async tap(x, y) {
    await this.send('Input.dispatchTouchEvent', {type: 'touchStart', touchPoints: [{x, y}]});
    await this.send('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
  }

  async clickElement(id) {
    const [x, y] = await this.evaluate(`(() => { const e = document.getElementById('${id}'); e.scrollIntoView({block:
      'nearest'}); const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()`);
    await this.click(x, y);
  }

  async drag(from, to) {
    await this.mouse('mousePressed', ...from, {buttons: 1});
    for (let i = 1; i <= 5; ++i) {
      await this.mouse('mouseMoved', ...from.map((c, k) => c + (to[k] - c) * i / 5), {buttons: 1});
    }
    await this.mouse('mouseReleased', ...to);
  }

  async wheel(x, y, deltaY) {
    await this.send('Input.dispatchMouseEvent', {type: 'mouseWheel', x, y, deltaX: 0, deltaY});
  }

  /** `modifiers`: 8 is Shift. */
  async press(key, modifiers = 0) {
    const code = kKeys[key] ?? key.toUpperCase().charCodeAt(0);
    const event = {key, modifiers, windowsVirtualKeyCode: code, ...(key in kKeys ? {code: key} : {text: key})};
    if (key === 'Enter') event.text = '\r';
    await this.send('Input.dispatchKeyEvent', {type: event.text ? 'keyDown' : 'rawKeyDown', ...event});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, windowsVirtualKeyCode: code});
  }

  /** PNG bytes; of a part (x, y, width, height) eight times as large. */
  async screenshot(part) {
    const clip = part && {x: part[0], y: part[1], width: part[2], height: part[3], scale: 8};
    const {data} = await this.send('Page.captureScreenshot', {format: 'png', clip});
    return Buffer.from(data, 'base64');
  }
}
