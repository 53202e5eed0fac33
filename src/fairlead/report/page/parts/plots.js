/* Plots over time and along the line, drawn by Bokeh; all share one range of time and the cursor of the clock. */
const B = () => Bokeh.Plotting;
const TOOLS = "xbox_zoom,xpan,xwheel_zoom,xzoom_in,xzoom_out,reset,save";
const MOST_POINTS = 60000;

function styled(p, x, y) {
  Object.assign(p, {background_fill_color: null, border_fill_color: null, sizing_mode: "stretch_width"});
  for (const [axis, label] of [[p.xaxis, x], [p.yaxis, y]]) for (const a of [].concat(axis))
    Object.assign(a, {axis_label: label, axis_label_text_font_style: "normal", axis_label_text_font_size: "12px", minor_tick_line_color: null, major_label_text_font_size: "11px"});
  p.toolbar.logo = null;
  p.toolbar.active_drag = p.toolbar.tools.find(tool => tool.type === "BoxZoomTool") || "auto";
  return inked(p);
}
/* Frame, axes and grid in the colours that the page has now. */
function inked(p) {
  const ink = css("ink"), soft = css("soft"), rule = css("rule");
  p.outline_line_color = rule;
  for (const a of [].concat(p.xaxis, p.yaxis)) Object.assign(a, {axis_label_text_color: ink, major_label_text_color: soft, axis_line_color: rule, major_tick_line_color: rule});
  for (const g of [].concat(p.xgrid, p.ygrid)) Object.assign(g, {grid_line_color: rule, grid_line_alpha: .6});
  for (const bar of p.right) if (bar.type === "ColorBar") bar.major_label_text_color = soft;
  return p;
}
function figure(options, x, y) {
  return styled(B().figure({height: 250, width: 600, tools: TOOLS, toolbar_location: "right", output_backend: "canvas", ...options}), x, y);
}
const views = new Map();
async function put(p, element) { const found = await B().show(p, element), view = Array.isArray(found) ? found[0] : found; views.set(element, view); return view; }
/* Plots as pictures of the width of paper, in the colours of paper; `undo` lets the plots be as they were. */
const PAPER = 760; // px
function pictured() {
  const made = [...views].filter(([element]) => element.isConnected).map(([element, view]) => {
    element.style.width = `${PAPER}px`; inked(view.model); view.compute_layout();
    const picture = new Image(); picture.className = "picture"; picture.src = view.export("png", true).canvas.toDataURL();
    picture.alt = element.parentElement.getAttribute("aria-label") || "Plot"; element.before(picture); element.classList.add("screen");
    return [element, view, picture];
  });
  return () => { for (const [element, view, picture] of made) { picture.remove(); element.style.width = ""; element.classList.remove("screen"); inked(view.model); view.compute_layout(); } };
}

/* The line that shows the time of the clock over a plot, and clicks that set it. */
function cursor(box, view) {
  const bar = document.createElement("div"), layer = document.createElement("div"); bar.className = "cursor"; layer.className = "layer"; layer.append(bar); box.append(layer);
  const frame = () => view.frame && view.frame.bbox;
  const where = () => { const f = frame(), outer = box.getBoundingClientRect(), inner = view.el.getBoundingClientRect(); return [inner.left - outer.left, inner.top - outer.top, f]; };
  const move = t => {
    if (!frame() || !box.isConnected) return;
    const range = view.frame.x_range, share = (t - range.start) / (range.end - range.start), [dx, dy, f] = where();
    const on = share >= 0 && share <= 1;
    bar.style.display = on ? "block" : "none";
    if (on) { bar.style.transform = `translate(${dx + f.left + share * f.width}px, ${dy + f.top}px)`; bar.style.height = `${f.height}px`; }
  };
  let down = null;
  box.addEventListener("pointerdown", e => { down = [e.clientX, e.clientY]; }, true);
  box.addEventListener("pointerup", e => {
    if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4 || !frame()) return;
    const [, , f] = where(), inner = view.el.getBoundingClientRect(), share = (e.clientX - inner.left - f.left) / f.width, high = (e.clientY - inner.top - f.top) / f.height;
    if (share >= 0 && share <= 1 && high >= 0 && high <= 1) { const r = view.frame.x_range; clock.set(r.start + share * (r.end - r.start)); }
  }, true);
  const again = () => move(clock.t), soon = () => requestAnimationFrame(() => requestAnimationFrame(again));
  clock.heard.push(move); span.heard.push(again); soon();
  /* Another width of the page: once when the box has it, and again when the plot has laid itself out in it. */
  new ResizeObserver(soon).observe(box);
  for (const side of ["inner_width", "inner_height"]) view.model.properties[side].change.connect(soon);
}

/* The stretch of time that all plots show. Each plot is a document of its own, so each has a range, and they are kept alike. */
const span = {
  start: 0, end: 1, whole_end: 1, ranges: [], heard: [],
  begin(end) { this.whole_end = this.end = end > 0 ? end : 1; },
  range() {
    const made = new Bokeh.Range1d({start: this.start, end: this.end, bounds: [0, this.whole_end], reset_start: 0, reset_end: this.whole_end});
    made.change.connect(() => { if (!this.busy && Number.isFinite(made.start)) this.set(made.start, made.end); });
    this.ranges.push(made);
    return made;
  },
  set(start, end) {
    if (start === this.start && end === this.end || !(end > start)) return;
    Object.assign(this, {start, end}); this.busy = true;
    for (const one of this.ranges) if (one.start !== start || one.end !== end) one.setv({start, end});
    this.busy = false;
    if (!this.waiting) { this.waiting = true; setTimeout(() => { this.waiting = false; for (const tell of this.heard) tell(); }, 40); }
  },
  whole() { this.set(0, this.whole_end); },
};

/* One panel: families of one unit, of all runs that have them. Of many elements it shows ends, middle and extremes. */
const FEW = 8, MOST_NAMED = 8, ROLES = ["first", "lowest", "middle", "highest", "last"];
class Panel {
  constructor(runs, title, families) { Object.assign(this, {runs, title, families}); this.picked = "few"; this.more = new Set(); }
  async show(list) {
    this.box = document.createElement("div"); this.box.className = "panel";
    const head = document.createElement("div"), name = document.createElement("b"), away = document.createElement("button");
    head.className = "head"; name.textContent = this.title; away.type = "button"; away.textContent = "Remove"; away.setAttribute("aria-label", `Remove ${this.title}`);
    away.onclick = () => { this.gone = true; this.box.remove(); };
    head.append(name, this.picker(), away); this.plot = document.createElement("div"); this.box.append(head, this.plot);
    this.box.setAttribute("role", "group"); this.box.setAttribute("aria-label", `Plot of ${this.title}`); list.append(this.box);
    await this.draw(); span.heard.push(() => this.fill());
  }
  /* A choice of elements; nothing to choose where there are few. */
  picker() {
    const elements = [...new Set(this.runs.flatMap(run => this.families.flatMap(name => run.family.get(name) && run.family.get(name).elements.length > FEW ? run.family.get(name).elements : [])))].sort((a, b) => a - b);
    const label = document.createElement("label"), list = document.createElement("select"); label.className = "small pick"; label.append("Elements ", list); label.hidden = !elements.length;
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
    const p = this.p = figure({x_range: span.range(), y_range: new Bokeh.DataRange1d({})}, "time [s]", unit === "1" ? "value" : `[${unit}]`);
    let drawn = 0;
    for (const [r, run] of this.runs.entries()) for (const name of this.families) {
      const family = run.family.get(name);
      if (!family) continue;
      const values = await run.values(name), n = values.first.length, picked = this.chosen(family, values), many = n > FEW && this.picked === "all";
      if (n > FEW && !many) this.bands.push({run, name, values: hull(values), colour: several ? LINES[r % LINES.length] : css("soft"), count: n});
      for (const [k, role] of picked) {
        const own = many ? PALETTE[Math.round(235 * k / (n - 1))] : LINES[drawn % LINES.length], at = role && role !== "picked" ? ROLES.indexOf(role.split(", ")[0]) : 0;
        const label = `${name.replace("[*]", family.elements[k] === null ? "" : `[${family.elements[k]}]`)}${role ? ` (${role})` : ""}${several ? ", " + run.short : ""}`;
        const together = several && n > FEW;
        this.curves.push({run, values, k, colour: together ? LINES[r % LINES.length] : own, dash: many ? "solid" : together ? ["solid", "dotdash", "dotted", "dashdot", "dashed"][at] : DASHES[r], label, role, many, family, name});
        if (!together && !many) drawn++;
      }
    }
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
    const chips = entries => entries.map(([colour, text]) => { const one = document.createElement("span"), chip = document.createElement("i"); chip.style.background = colour; one.append(chip, text); return one; });
    const items = [...groups.map(([text, entries]) => { const li = document.createElement("li"), b = document.createElement("b"); b.textContent = text; li.className = "group"; li.append(b, ...chips(entries.slice(0, MOST_NAMED)));
      if (entries.length > MOST_NAMED) li.append(rest(`${entries.length - MOST_NAMED} more`, chips(entries.slice(MOST_NAMED)))); return li; }),
    ...alone.map(entries => { const li = document.createElement("li"); li.append(...chips(entries)); return li; })];
    list.append(...items.slice(0, MOST_NAMED), ...this.marks.map(one => { const li = document.createElement("li"); li.append(...chips([one])); return li; }));
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
/* What a legend does not show at first. */
function rest(text, items) {
  const more = document.createElement("details"), head = document.createElement("summary"); head.textContent = text; more.append(head, ...items);
  return more;
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
      p.line({field: "x"}, {field: "y"}, {source, line_color: LINES[r], line_width: 2, line_dash: DASHES[r]});
      const x = this.line.positions && one.family.get(this.line.positions) ? (await one.values(this.line.positions)).first : null;
      this.parts.push({one, source, x, values: (await one.values(name)).first, family: one.family.get(name)});
    }
    const marks = marked(p, this.runs, [name], false);
    legend(document.getElementById("profile-legend"), [...(this.runs.length > 1 ? this.runs.map((r, k) => [dashed(LINES[k], DASHES[k]), r.short]) : []), ...marks]);
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

/* Devices of a route as bands across a map. */
function devices(p, line, bottom, top, from, to, colour) {
  for (const s of line.stations) if (s.type !== "Straight") {
    const a = s.begin ?? bottom, b = s.end ?? top; if (b < bottom || a > top) continue;
    p.add_layout(new Bokeh.BoxAnnotation({bottom: Math.max(a, bottom), top: Math.min(b, top), fill_color: null, line_color: colour, line_dash: "dashed", line_alpha: .8}));
    p.add_layout(new Bokeh.Label({x: from + .006 * (to - from), y: (Math.max(a, bottom) + Math.min(b, top)) / 2, text: s.name, text_font_size: "11px", text_baseline: "middle", text_color: "#ffffff", background_fill_color: "#000000", background_fill_alpha: .55, padding: 2}));
  }
}

/* A map: time to the right, place upward, value as colour. */
async function map(run, line, name, element) {
  const family = run.family.get(name), values = await run.values(name), box = document.createElement("div"); box.className = "panel";
  const title = document.createElement("b"); title.textContent = `${name} [${family.unit}], from ${shown(family.min)} to ${shown(family.max)} over the whole run, also between recorded rows`; const at = document.createElement("div"); box.append(title, at); element.append(box);
  const xs = line.positions ? (await run.values(line.positions)).first : null, elements = family.elements, between = xs && values.first.length === xs.length - 1 && elements[0] === 0;
  const W = Math.min(700, Math.max(run.rows, 2)), H = 200, place = (k, i) => !xs ? elements[k] : between ? (xs[elements[k]][i] + xs[elements[k] + 1][i]) / 2 : xs[elements[k]] ? xs[elements[k]][i] : NaN;
  const finite = line.stations.flatMap(s => [s.begin, s.end]).filter(v => v !== null), pad = Math.max(1, .5 * (Math.max(...finite) - Math.min(...finite)));
  let bottom = xs ? Math.max(run.family.get(line.positions).min, Math.min(...finite) - pad) : elements[0], top = xs ? Math.min(run.family.get(line.positions).max, Math.max(...finite) + pad) : elements[elements.length - 1];
  if (!(top > bottom)) { bottom = elements[0]; top = elements[elements.length - 1] + 1; }
  const grid = new Float32Array(W * H).fill(NaN), n = values.first.length, all = [];
  let worst = {low: Infinity, high: -Infinity};
  for (let k = 0; k < n; k++) for (let i = 0; i < run.rows; i++) { const lo = values.low[k][i], hi = values.high[k][i]; if (lo < worst.low) worst = {...worst, low: lo, tl: run.times[i], yl: place(k, i)}; if (hi > worst.high) worst = {...worst, high: hi, th: run.times[i], yh: place(k, i)}; }
  for (let c = 0; c < W; c++) {
    const i = run.row(run.times[0] + (run.end - run.times[0]) * (c + .5) / W);
    let k = 0;
    for (let h = 0; h < H; h++) {
      const y = bottom + (top - bottom) * (h + .5) / H;
      while (k < n - 2 && place(k + 1, i) < y) k++;
      const a = place(k, i), b = place(k + 1, i);
      if (!(y >= a - (b - a) / 2 && y <= b + (b - a) / 2)) continue;
      const f = Math.min(Math.max((y - a) / (b - a), 0), 1), v = values.first[k][i] + f * (values.first[k + 1][i] - values.first[k][i]);
      grid[c + W * h] = v; if ((c * 7 + h) % 11 === 0 && Number.isFinite(v)) all.push(v);
    }
  }
  all.sort((a, b) => a - b);
  const low = all[Math.floor(.003 * all.length)] ?? 0, high0 = all[Math.floor(.997 * all.length)] ?? 1, high = high0 > low ? high0 : low + 1;
  const canvas = document.createElement("canvas"); canvas.width = W; canvas.height = H; const ctx = canvas.getContext("2d"), image = ctx.createImageData(W, H);
  for (let h = 0; h < H; h++) for (let c = 0; c < W; c++) { const v = grid[c + W * h], o = 4 * (c + W * (H - 1 - h)); if (Number.isFinite(v)) { const [r, g, b] = ramp((v - low) / (high - low)); image.data.set([r, g, b, 255], o); } }
  ctx.putImageData(image, 0, 0);
  const p = figure({height: 280, x_range: span.range(), y_range: new Bokeh.Range1d({start: bottom, end: top})}, "time [s]", xs ? "place [m]" : "element");
  const t0 = run.times[0];
  p.image_url({value: canvas.toDataURL()}, t0, bottom, run.end - t0, top - bottom, {anchor: "bottom_left"});
  if (xs) devices(p, line, bottom, top, t0, run.end, "#ffffff");
  p.scatter([worst.tl, worst.th].filter(Number.isFinite), [worst.yl, worst.yh].filter(Number.isFinite), {marker: "x", size: 12, line_width: 3, line_color: "#ff5a4d"});
  const mapper = new Bokeh.LinearColorMapper({palette: PALETTE, low, high});
  p.add_layout(new Bokeh.ColorBar({color_mapper: mapper, background_fill_color: null, major_label_text_color: css("soft"), width: 12, title: null}), "right");
  const view = await put(p, at); cursor(at, view);
  hover(at, view, (t, y) => {
    const i = run.row(t); let k = -1, far = Infinity;
    for (let j = 0; j < n; j++) { const d = Math.abs(place(j, i) - y); if (d < far) { far = d; k = j; } }
    return k < 0 ? null : [`${name.replace("[*]", `[${elements[k]}]`)} = ${shown(values.first[k][i], family.unit)}`, `t = ${shown(run.times[i], "s")}, ${xs ? shown(place(k, i), "m") + " on the route" : ""}`];
  });
}
