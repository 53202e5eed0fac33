/* One panel: families of one unit, of all runs that have them. Of many elements it shows ends, middle and extremes. */
const FEW = 8, MOST_NAMED = 8, ROLES = ["first", "lowest", "middle", "highest", "last"];
class Panel {
  /* `only`: the number of an element that was asked for alone. */
  constructor(runs, title, families, only = null) { Object.assign(this, {runs, title, families, only}); this.picked = "few"; this.more = new Set(); }
  async show(list, top = false) {
    this.box = document.createElement("div"); this.box.className = "panel";
    const head = document.createElement("div"), name = document.createElement("b"), away = document.createElement("button"), about = document.createElement("span");
    head.className = "head"; name.textContent = this.title; away.type = "button"; away.textContent = "Remove"; away.setAttribute("aria-label", `Remove ${this.title}`);
    away.onclick = () => { this.gone = true; this.box.remove(); };
    const doc = this.families.length === 1 ? this.runs.map(run => run.family.get(this.families[0])?.doc).find(Boolean) : "";
    if (doc) { about.className = "small"; about.textContent = doc; }
    head.append(name, about, this.picker(), away); this.plot = document.createElement("div"); this.box.append(head, this.plot);
    this.box.setAttribute("role", "group"); this.box.setAttribute("aria-label", `Plot of ${this.title}`); if (top) list.prepend(this.box); else list.append(this.box);
    await this.draw(); span.heard.push(() => this.fill());
  }
  /* A choice of elements; nothing to choose where there are few. */
  picker() {
    const elements = [...new Set(this.runs.flatMap(run => this.families.flatMap(name => run.family.get(name) && run.family.get(name).elements.length > FEW ? run.family.get(name).elements : [])))].sort((a, b) => a - b);
    const label = document.createElement("label"), list = document.createElement("select"); label.className = "small pick"; label.append("Elements ", list); label.hidden = !elements.length || this.only !== null;
    options(list, [["few", "ends, middle, extremes"], ["all", `all ${elements.length}`], ...elements.map(e => [e, `${e} as well`])], "few");
    list.onchange = async () => {
      const all = list.value === "all" || list.value === "few";
      if (all) { this.picked = list.value; this.more.clear(); } else { this.picked = "few"; this.more.add(Number(list.value)); }
      this.note_at?.remove(); this.plot.replaceChildren(); await this.draw();
    };
    return label;
  }
  /* Which elements of a family are drawn, each with its role. */
  chosen(family, values) {
    const n = values.first.length, found = new Map();
    if (this.only !== null) return new Map(family.elements.flatMap((e, k) => e === this.only ? [[k, ""]] : []));
    if (n <= FEW || this.picked === "all") return new Map(values.first.map((_, k) => [k, ""]));
    let low = Infinity, high = -Infinity, kl = 0, kh = 0;
    values.low.forEach((v, k) => { for (const y of v) if (y < low) { low = y; kl = k; } });
    values.high.forEach((v, k) => { for (const y of v) if (y > high) { high = y; kh = k; } });
    [0, kl, n >> 1, kh, n - 1].forEach((k, i) => found.set(k, found.has(k) ? `${found.get(k)}, ${ROLES[i]}` : ROLES[i]));
    family.elements.forEach((e, k) => { if (this.more.has(e) && !found.has(k)) found.set(k, "picked"); });
    return found;
  }
  async draw() {
    this.curves = []; this.bands = [];
    const unit = this.unit(), several = this.runs.length > 1;
    const p = this.p = figure({x_range: span.range(), y_range: new Bokeh.DataRange1d({})}, "time [s]", "");
    let drawn = 0;
    for (const [r, run] of this.runs.entries()) for (const name of this.families) {
      const family = run.family.get(name);
      if (!family) continue;
      const values = await run.values(name), n = values.first.length, picked = this.chosen(family, values), many = n > FEW && this.picked === "all", alone = this.only !== null;
      if (n > FEW && !many && !alone) this.bands.push({run, name, values: hull(values), colour: several ? LINES[r % LINES.length] : css("soft"), count: n});
      for (const [k, role] of picked) {
        const own = many ? PALETTE[Math.round(235 * k / (n - 1))] : LINES[drawn % LINES.length];
        const label = `${name.replace("[*]", family.elements[k] === null ? "" : `[${family.elements[k]}]`)}${role ? ` (${role})` : ""}${several ? ", " + run.short : ""}`;
        const together = several && n > FEW && !alone;
        this.curves.push({run, values, k, colour: together ? LINES[r % LINES.length] : own, dash: many ? "solid" : together ? ROLE_DASHES[(role || "first").split(", ")[0]] : DASHES[r % DASHES.length], label, role, many, family, name});
        if (!together && !many) drawn++;
      }
    }
    this.apart();
    const words = [...new Set(this.families.map(name => name.split(".").pop().replaceAll("_", " ")))];
    measuredAxis([].concat(p.yaxis)[0], words.length === 1 ? words[0] : "", unit, this.runs.flatMap(run => this.families.flatMap(name => { const f = run.family.get(name); return f ? [f.min, f.max] : []; })).filter(v => v !== null));
    for (const band of this.bands) {
      band.source = new Bokeh.ColumnDataSource({data: {x: [], y1: [], y2: []}});
      p.varea({field: "x"}, {field: "y1"}, {field: "y2"}, {source: band.source, fill_color: band.colour, fill_alpha: .16});
    }
    this.source = new Bokeh.ColumnDataSource({data: {xs: [], ys: [], colour: [], dash: [], label: []}});
    const alpha = this.curves.length > 20 ? .75 : 1;
    p.multi_line({field: "xs"}, {field: "ys"}, {source: this.source, line_color: {field: "colour"}, line_dash: {field: "dash"}, line_width: this.curves.length > 20 ? 1.1 : 1.6, line_alpha: alpha});
    this.marks = marked(p, this.runs, this.families, true);
    this.fill();
    this.view = await put(p, this.plot);
    cursor(this.plot, this.view); hover(this.plot, this.view, (t, y, scale) => this.nearest(t, y, scale)); this.note();
  }
  /* A curve that lies on an earlier one is dashed, so that both are seen. */
  apart() {
    if (this.runs.length > 1 || this.curves.length > 8) return;
    const ends = this.curves.map(c => [c.family.min, c.family.max]).filter(([a]) => a !== null), wide = Math.max(...ends.map(e => e[1])) - Math.min(...ends.map(e => e[0])) || 1;
    this.curves.forEach((c, j) => {
      const v = c.values.first[c.k], step = Math.max(1, v.length >> 9);
      const below = this.curves.slice(0, j).filter(o => { const w = o.values.first[o.k]; let near = 0, all = 0; for (let i = 0; i < v.length; i += step, all++) if (Math.abs(v[i] - w[i]) <= .008 * wide) near++; return near > .5 * all; });
      if (below.length) c.dash = DASHES[below.length % DASHES.length];
    });
  }
  /* The curve nearest to the pointer, if it is near. */
  nearest(t, y, scale) {
    let best = null, far = 24;
    for (const c of this.curves) { const v = c.values.first[c.k][c.run.row(t)], d = Math.abs(v - y) * scale; if (d < far) { far = d; best = [c, v]; } }
    return best && [best[0].label, `${shown(best[1], best[0].family.unit)} at ${shown(best[0].run.times[best[0].run.row(t)], "s")}`];
  }
  unit() { for (const run of this.runs) for (const name of this.families) if (run.family.get(name)) return run.family.get(name).unit; return ""; }
  /* The legend: of a family with many elements one entry for each run, of others one for each curve; few at first. */
  note() {
    const list = this.note_at = document.createElement("ul"), several = this.runs.length > 1; list.className = "legend";
    const groups = [], alone = [], title = (name, run) => `${name}${several ? ", " + run.short : ""}`;
    for (const name of this.families) for (const run of this.runs) {
      const own = this.curves.filter(c => c.name === name && c.run === run), band = this.bands.find(b => b.name === name && b.run === run);
      if (!own.length) continue;
      const n = own[0].family.elements.length, of = c => `[${c.family.elements[c.k]}]`;
      if (own[0].many) alone.push([[`linear-gradient(90deg, ${own[0].colour}, ${own[own.length >> 1].colour}, ${own[own.length - 1].colour})`, `${title(name, run)}: elements ${own[0].family.elements[0]} to ${own[own.length - 1].family.elements[own.length - 1]}`]]);
      else if (own.length > 1) groups.push([title(name, run), [...own.map(c => [dashed(c.colour, c.dash), `${of(c)}${c.role ? " " + c.role : ""}`]),
        ...(band ? [[`color-mix(in srgb, ${band.colour} 25%, transparent)`, `all ${n} lie in here`]] : [])]]);
      else alone.push([[dashed(own[0].colour, own[0].dash), own[0].label]]);
    }
    const chips = entries => entries.map(([swatch, text]) => { const one = document.createElement("span"); one.append(chip(swatch), text); return one; });
    const items = [...groups.map(([text, entries]) => { const li = document.createElement("li"), b = document.createElement("b"); b.textContent = text; li.className = "group"; li.append(b, ...chips(entries.slice(0, MOST_NAMED)));
      if (entries.length > MOST_NAMED) li.append(rest(`${entries.length - MOST_NAMED} more`, chips(entries.slice(MOST_NAMED)))); return li; }),
    ...alone.map(entries => { const li = document.createElement("li"); li.append(...chips(entries)); return li; })];
    list.append(...items.slice(0, MOST_NAMED), ...[...this.marks, NOW()].map(one => { const li = document.createElement("li"); li.append(...chips([one])); return li; }));
    if (items.length > MOST_NAMED) { const li = document.createElement("li"); li.append(rest(`${items.length - MOST_NAMED} more curves`, items.slice(MOST_NAMED))); list.append(li); }
    this.box.append(list);
  }
  fill() {
    if (this.gone || !this.curves) return;
    const {start, end} = span, most = Math.min(2400, Math.max(160, MOST_POINTS / this.curves.length));
    const d = {xs: [], ys: [], colour: [], dash: [], label: []};
    for (const c of this.curves) {
      const {x, y} = thinned(c.run, c.values, c.k, start, end, most);
      d.xs.push(x); d.ys.push(y); d.colour.push(c.colour); d.dash.push(c.dash); d.label.push(c.label);
    }
    this.source.data = d;
    for (const b of this.bands) b.source.data = hulled(b.run, b.values, start, end, 1200);
  }
}
/* Lowest and highest value of all elements, by row. */
function hull(values) {
  const n = values.first[0].length, low = new Float32Array(n).fill(Infinity), high = new Float32Array(n).fill(-Infinity);
  for (const v of values.low) for (let i = 0; i < n; i++) if (v[i] < low[i]) low[i] = v[i];
  for (const v of values.high) for (let i = 0; i < n; i++) if (v[i] > high[i]) high[i] = v[i];
  return {low, high};
}
function hulled(run, {low, high}, from, to, most) {
  const t = run.times, a = Math.max(upper(t, from) - 2, 0), b = Math.min(upper(t, to) + 1, run.rows), size = Math.max(1, Math.ceil((b - a) / most)), d = {x: [], y1: [], y2: []};
  for (let i = a; i < b; i += size) {
    let lo = Infinity, hi = -Infinity;
    for (let j = i; j < Math.min(i + size, b); j++) { if (low[j] < lo) lo = low[j]; if (high[j] > hi) hi = high[j]; }
    d.x.push(t[i]); d.y1.push(lo === Infinity ? NaN : lo); d.y2.push(hi === -Infinity ? NaN : hi);
  }
  return d;
}
