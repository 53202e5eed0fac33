/* Values along the line at the time of the clock. */
class Profile {
  constructor(runs, line) { Object.assign(this, {runs, line}); }
  async show(name) {
    this.name = name; this.drawn = null;
    const box = document.getElementById("profile"); box.replaceChildren();
    const run = this.runs[0], family = run.family.get(name);
    this.parts = [];
    const p = figure({height: 230, tools: "box_zoom,reset,save"}, this.line.positions ? "place on the route [m]" : "element", `${name.split(".").pop()} [${family.unit}]`);
    const low = Math.min(...this.runs.map(r => r.family.get(name)?.min ?? Infinity)), high = Math.max(...this.runs.map(r => r.family.get(name)?.max ?? -Infinity)), pad = .05 * (high - low || 1);
    p.y_range = new Bokeh.Range1d({start: low - pad, end: high + pad, reset_start: low - pad, reset_end: high + pad});
    for (const s of this.line.stations) if (s.type !== "Straight" && s.begin !== null && s.end !== null && this.line.positions) p.add_layout(new Bokeh.BoxAnnotation({left: s.begin, right: s.end, fill_color: css("device"), fill_alpha: .18, line_color: null}));
    for (const [r, one] of this.runs.entries()) {
      if (!one.family.get(name)) continue;
      const source = new Bokeh.ColumnDataSource({data: {x: [], y: []}});
      p.line({field: "x"}, {field: "y"}, {source, line_color: LINES[r % LINES.length], line_width: 2, line_dash: DASHES[r % DASHES.length]});
      const x = this.line.positions && one.family.get(this.line.positions) ? (await one.values(this.line.positions)).first : null;
      this.parts.push({one, source, x, values: (await one.values(name)).first, family: one.family.get(name)});
    }
    const marks = marked(p, this.runs, [name], false);
    legend(document.getElementById("profile-legend"), [...(this.runs.length > 1 ? this.runs.map((r, k) => [dashed(LINES[k % LINES.length], DASHES[k % DASHES.length]), r.short]) : []), ...marks]);
    this.view = await put(p, box); this.draw(clock.t, true);
    hover(box, this.view, (x, y, scale) => {
      let best = null, far = 40;
      for (const {one, source, family} of this.parts) source.data.x.forEach((at, k) => {
        const d = Math.hypot((at - x) * this.view.frame.bbox.width / (this.view.frame.x_range.end - this.view.frame.x_range.start), (source.data.y[k] - y) * scale);
        if (d < far) { far = d; best = [`${name.replace("[*]", `[${family.elements[k]}]`)} = ${shown(source.data.y[k], family.unit)}`, `at ${shown(at, this.line.positions ? "m" : "")}${this.runs.length > 1 ? ", " + one.short : ""}`]; }
      });
      return best;
    });
  }
  draw(t, now) {
    if (!this.parts) return;
    const stamp = performance.now();
    if (!now && this.last && stamp - this.last < 90) { clearTimeout(this.later); this.later = setTimeout(() => this.draw(clock.t, true), 100); return; }
    this.last = stamp; document.getElementById("when").textContent = shown(t, "s");
    for (const part of this.parts) {
      const row = part.one.row(t), elements = part.family.elements, between = part.x && part.values.length === part.x.length - 1 && elements[0] === 0;
      const x = elements.map(e => !part.x ? e : between ? (part.x[e][row] + part.x[e + 1][row]) / 2 : part.x[e] ? part.x[e][row] : NaN);
      part.source.data = {x, y: part.values.map(v => v[row])};
    }
  }
}
