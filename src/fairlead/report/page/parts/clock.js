/* The time of the page: whoever shows something at a time asks to be told when it changes. */
const clock = {
  /* A time in digits that tell rows apart; all that says the time of the page says it so. */
  said(t) { const digits = Math.min(Math.max(4 - Math.floor(Math.log10(this.end || 1)), 0), 9); return `${t.toFixed(digits)} s`; },
  t: 0, end: 0, playing: false, rate: 1, heard: [],
  set(t) { this.t = Math.min(Math.max(t, 0), this.end); for (const tell of this.heard) tell(this.t); },
  play(on) { this.playing = on; if (on) { if (this.t >= this.end) this.set(0); this.last = null; requestAnimationFrame(now => this.tick(now)); } },
  tick(now) {
    if (!this.playing) return;
    if (this.last !== null) this.set(this.t + (now - this.last) / 1000 * this.rate);
    this.last = now;
    if (this.t >= this.end) { this.playing = false; for (const tell of this.stopped || []) tell(); return; }
    requestAnimationFrame(next => this.tick(next));
  },
};
