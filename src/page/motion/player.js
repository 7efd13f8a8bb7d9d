// Which frame is shown, and how time passes.

export const kEnds = ['again', 'back', 'stop'];
const kLongest = 0.25;  // Seconds that may pass between two pictures; more is a pause of the browser.

export class Player {
  /** `shown`: the numbers of the frames that can be shown, ascending, one or more. `onFrame(number)` is called with each
   * frame that is to be shown, `onState()` when playing begins or ends. */
  constructor(shown, onFrame, onState) {
    this.shown = shown;
    this.onFrame = onFrame;
    this.onState = onState;
    this.first = shown[0];
    this.last = shown[shown.length - 1];
    this.frame = this.first;
    this.rate = 24;       // Frames a second.
    this.atEnd = 'again';
    this.playing = false;
    this.phase = 0;       // Frames since the first one; there and back, if so.
  }

  /** The index in `shown` of the last frame up to `number`. */
  indexOf(number) {
    let least = 0, most = this.shown.length - 1;
    while (least < most) {
      const middle = Math.ceil((least + most) / 2);
      if (this.shown[middle] <= number) least = middle; else most = middle - 1;
    }
    return least;
  }

  /** Shows the last frame up to `number`. */
  seek(number) {
    const frame = this.shown[this.indexOf(number)];
    this.phase = frame - this.first;
    this.showFrame(frame);
  }

  showFrame(frame) {
    if (frame === this.frame && this.started) return;
    this.started = true;
    this.frame = frame;
    this.onFrame(frame);
  }

  /** Pauses at the next frame or the one before. */
  step(by) {
    this.pause();
    const index = this.indexOf(this.frame) + by;
    if (index >= 0 && index < this.shown.length) this.seek(this.shown[index]);
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  play() {
    if (this.playing || this.shown.length < 2) return;
    if (this.atEnd === 'stop' && this.frame === this.last) this.seek(this.first);
    this.playing = true;
    this.before = null;
    this.onState();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.onState();
  }

  setEnd(atEnd) {
    this.atEnd = atEnd;
    this.phase = this.frame - this.first;
  }

  tick(now) {
    if (!this.playing) return;
    if (this.before !== null) this.advance(Math.min((now - this.before) / 1000, kLongest));
    this.before = now;
    if (this.playing) requestAnimationFrame((next) => this.tick(next));
  }

  /** Lets time pass, in seconds. */
  advance(seconds) {
    const length = this.last - this.first;  // Frames from the first to the last.
    this.phase += seconds * this.rate;
    let at = Math.floor(this.phase);
    if (this.atEnd === 'again') {
      this.phase %= length + 1;
      at %= length + 1;
    } else if (this.atEnd === 'back') {
      this.phase %= 2 * length;
      at %= 2 * length;
      at = Math.min(at, 2 * length - at);
    } else if (at >= length) {
      at = this.phase = length;
      this.pause();
    }
    this.showFrame(this.shown[this.indexOf(this.first + at)]);
  }
}
