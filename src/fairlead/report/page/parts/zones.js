/* Zones: of many alike contacts a map over place and time, of single parts a row of coloured spans each. */
const SAYS = {stuck: "sticks", forward: "slides outboard", backward: "slides inboard", between: "between sticking and sliding", off: "does not touch", slack: "carries no tension", ruck: "rucks"};
const RANK = {ruck: 7, forward: 6, backward: 6, between: 4, slack: 5, "": 3, stuck: 2, sound: 1, off: 0};
const MANY = 12;

class ZoneChart {
  constructor(run) { this.run = run; }
  choices() {
    const busy = this.run.zones.families.filter(z => !z.inner && z.counts.some(n => n)), list = [];
    const telling = busy.filter(z => !z.zones.every(w => ["off", "sound"].includes(this.means(w)))), first = telling.length ? telling : busy;
    if (first.length > 1) list.push(["all that stick, slide, ruck or switch", first]);
    const rank = z => (z.zones.some(w => ["stuck", "forward"].includes(this.means(w))) ? 1e9 : 0) + z.counts.reduce((a, b) => a + b, 0);
    const sorted = [...busy].sort((a, b) => rank(b) - rank(a));
    for (const z of sorted) list.push([z.name, [z]]);
    for (const z of sorted) if (this.many(z)) list.push([`${z.name}, a row each`, [z], true]);
    for (const z of this.run.zones.families.filter(z => z.inner && z.counts.some(n => n))) list.push([`${z.name} (pieces of a table)`, [z]]);
    for (const z of this.run.zones.families.filter(z => !z.counts.some(n => n))) list.push([`${z.name} (never changed)`, [z], true]);
    return list;
  }
  means(name) { return (this.run.zones.words.find(o => o.name === name) || {}).means || ""; }
  many(z) { return z.rows.length >= MANY && z.elements.every(e => e >= 0); }
  async show(families, as_rows) {
    const box = document.getElementById("zone-chart"), made = document.createElement("div"); box.replaceChildren(made);
    this.used = new Set();
    const maps = as_rows ? [] : families.filter(z => this.many(z)), rest = families.filter(z => !maps.includes(z)), told = [];
    const order = z => Math.max(...z.zones.map(w => RANK[this.means(w)] ?? 3));
    for (const z of [...maps].sort((a, b) => order(b) - order(a))) await new ZoneMap(this, z).show(made);
    if (rest.length) told.push(...[await this.rows(rest, made)].filter(Boolean));
    if (maps.length) told.push("In a map a change too short for a pixel is drawn one pixel wide; zoom in to see how short it is");
    const left = this.run.zones.left_out;
    if (left) told.push(`${left} parts that change too often for a page are left out`);
    document.getElementById("zone-note").textContent = told.length ? `${told.join(". ")}.` : "";
    const words = [...this.used].map(z => this.run.zones.words[z]).sort((a, b) => (RANK[b.means] ?? 3) - (RANK[a.means] ?? 3));
    legend(document.getElementById("zone-legend"), words.map(w => [zoneColour(this.run, this.run.zones.words.indexOf(w)), this.told(w)]).concat([NOW()]));
  }
  /* A zone by its word, and what that means where the word does not say it itself. */
  told(word) {
    const along = ["forward", "backward"].includes(word.means), said = along && !this.run.lines.length ? "" : SAYS[word.means];
    return said && said !== word.name ? `${word.name}: ${said}` : word.name;
  }
  async rows(families, element) {
    const run = this.run, rows = families.flatMap(z => { const moved = z.rows.filter(r => r.t.length); return moved.length ? moved : z.rows; }).slice(0, 1200);
    const d = {left: [], right: [], top: [], bottom: [], colour: []}, end = run.end, n = rows.length;
    rows.forEach((row, k) => {
      let from = run.times[0] || 0, zone = row.start;
      const add = to => { if (to > from) { d.left.push(from); d.right.push(to); d.top.push(n - k - .06); d.bottom.push(n - k - .94); d.colour.push(zoneColour(run, zone)); this.used.add(zone); } };
      row.t.forEach((t, i) => { add(t); from = t; zone = row.to[i]; });
      add(Math.max(end, from));
    });
    const height = Math.min(Math.max(70 + n * (n > 60 ? 5 : n > 20 ? 11 : 22), 130), 1000), at = document.createElement("div"); const outer = document.createElement("div"); outer.className = "panel"; outer.style.minHeight = `${height}px`; outer.append(at); element.append(outer);
    const p = figure({height, x_range: span.range(), y_range: new Bokeh.Range1d({start: 0, end: n})}, "time [s]", "");
    p.quad({field: "left"}, {field: "right"}, {field: "top"}, {field: "bottom"}, {source: new Bokeh.ColumnDataSource({data: d}), fill_color: {field: "colour"}, line_color: null});
    const every = Math.max(1, Math.ceil(n / ((height - 60) / 13))), ticks = [], labels = new Map();
    rows.forEach((row, k) => { if (k % every === 0) { ticks.push(n - k - .5); labels.set(n - k - .5, row.name.length > 26 ? "..." + row.name.slice(-24) : row.name); } });
    p.yaxis.ticker = new Bokeh.FixedTicker({ticks}); p.yaxis.major_label_overrides = labels; p.ygrid.visible = false;
    const view = await put(p, at);
    cursor(at, view); hover(at, view, (t, y) => { const row = rows[Math.floor(n - y)]; return row && this.tells(row, t); });
    const still = families.flatMap(z => z.rows).length - n;
    return still > 0 ? `${still} part${still > 1 ? "s that never changed zone are" : " that never changed zone is"} not shown` : "";
  }
  /* What a row does at time t, and from when to when. */
  tells(row, t) {
    const k = upper(row.t, t), zone = this.run.zones.words[k ? row.to[k - 1] : row.start], from = k ? row.t[k - 1] : this.run.times[0], to = k < row.t.length ? row.t[k] : this.run.end;
    return [row.name, this.told(zone), spell(from, to)];
  }
}

/* The zones of alike parts as a picture: time to the right, place on the route (else number) upward. */
class ZoneMap {
  constructor(chart, family) {
    Object.assign(this, {chart, run: chart.run, family});
    this.line = this.run.lines.find(one => family.name.startsWith(one.line + "."));
  }
  async show(element) {
    const {run, family} = this, at = document.createElement("div"), title = document.createElement("b"); at.className = "panel low";
    const changed = family.rows.filter(r => r.t.length).length; title.textContent = `${family.name}${this.role()}: ${family.counts.reduce((a, b) => a + b, 0)} changes in ${changed} of ${family.rows.length}`;
    const plot = document.createElement("div"), note = document.createElement("p"); note.className = "small"; at.append(title, note, plot); element.append(at);
    this.x = this.line && this.line.positions ? (await run.values(this.line.positions)).first : null;
    this.between = this.line && this.line.layers.some(l => family.name === `${this.line.line}.${l}[*]`);
    this.reach(); note.textContent = this.x ? cut(run, this.line, this.bottom, this.top) : ""; note.hidden = !note.textContent;
    const p = figure({height: 210, x_range: span.range(), y_range: new Bokeh.Range1d({start: this.bottom, end: this.top})}, "time [s]", this.x ? "place on the route [m]" : "number");
    this.source = new Bokeh.ColumnDataSource({data: {url: [], x: [], w: []}});
    p.image_url({field: "url"}, {field: "x"}, this.bottom, {field: "w"}, this.top - this.bottom, {source: this.source, anchor: "bottom_left"});
    if (this.x) devices(p, this.line, this.bottom, this.top, run.times[0], run.end, css("ink"));
    p.ygrid.visible = false; this.draw();
    const view = await put(p, plot);
    cursor(plot, view); hover(plot, view, (t, y) => { const row = this.row(t, y); return row && this.chart.tells(row, t); });
    span.heard.push(() => { clearTimeout(this.soon); this.soon = setTimeout(() => { if (plot.isConnected) this.draw(); }, 30); });
  }
  role() {
    if (!this.line) return "";
    const tail = this.family.name.slice(this.line.line.length + 1), {layers} = this.line;
    if (tail === "inner[*]") return ` (${layers[1]} on ${layers[0]})`;
    if (/^outer/.test(tail)) return " (line on its devices)";
    return layers.some(l => tail === `${l}[*]`) ? ` (elements of the ${tail.slice(0, -3)})` : "";
  }
  /* From where to where a part reaches, at a row of the record. */
  ends(row, i) {
    const e = row.element, x = this.x;
    if (!x) return [e - .5, e + .5];
    const here = x[e] && x[e][i];
    if (this.between) return [here, x[e + 1] ? x[e + 1][i] : NaN];
    return [x[e - 1] ? (x[e - 1][i] + here) / 2 : here, x[e + 1] ? (x[e + 1][i] + here) / 2 : here];
  }
  /* The places at which something happens, with devices. */
  reach() {
    if (this.x && document.getElementById("zone-whole").checked) { const all = this.run.family.get(this.line.positions); this.bottom = all.min; this.top = all.max; return; }
    let low = Infinity, high = -Infinity;
    const quiet = z => ["off", "sound"].includes(this.run.zones.words[z].means);
    for (const row of this.family.rows) row.t.forEach((t, i) => {
      if (t <= this.run.times[0] || quiet(row.to[i]) && quiet(i ? row.to[i - 1] : row.start)) return;
      const [a, b] = this.ends(row, this.run.row(t)); if (a < low) low = a; if (b > high) high = b;
    });
    if (this.x) for (const s of this.line.stations) if (s.curvature > 0) { if (s.begin !== null) low = Math.min(low, s.begin); if (s.end !== null) high = Math.max(high, s.end); }
    if (!(high > low)) for (const row of this.family.rows) { const [a, b] = this.ends(row, 0); if (a < low) low = a; if (b > high) high = b; }
    if (!(high > low)) { high = low = Number.isFinite(low) ? low : 0; high++; }
    const pad = this.x ? .04 * (high - low) : 0; this.bottom = low - pad; this.top = high + pad;
  }
  row(t, y) { const i = this.run.row(t); return this.family.rows.find(row => { const [a, b] = this.ends(row, i); return y >= a && y < b; }); }
  draw() {
    const {run} = this, W = 1100, H = 220, from = Math.max(span.start, run.times[0]), to = Math.min(span.end, run.end), word = run.zones.words;
    if (!(to > from)) return;
    const canvas = document.createElement("canvas"); canvas.width = W; canvas.height = H;
    const ctx = canvas.getContext("2d"), image = ctx.createImageData(W, H), pixels = new Uint32Array(image.data.buffer), inks = new Map(), wide = (to - from) / W, rows = Array.from({length: W}, (_, c) => run.row(from + (c + .5) * wide));
    const high = y => H - (y - this.bottom) / (this.top - this.bottom) * H;
    for (const row of this.family.rows) {
      const zones = new Int32Array(W).fill(-1), rank = z => RANK[word[z].means] ?? 3;
      const mark = (a, b, z) => { const c0 = Math.max(Math.floor((a - from) / wide), 0), c1 = Math.min(Math.max(Math.ceil((b - from) / wide), c0 + 1), W); for (let c = c0; c < c1; c++) if (zones[c] < 0 || rank(z) > rank(zones[c])) zones[c] = z; };
      let begin = run.times[0], zone = row.start;
      for (let i = 0; i <= row.t.length; i++) {
        const end = i < row.t.length ? row.t[i] : Math.max(run.end, begin);
        if (end > from && begin < to && end > begin) mark(Math.max(begin, from), Math.min(end, to), zone);
        if (i < row.t.length) { begin = end; zone = row.to[i]; }
      }
      for (let c = 0, next; c < W; c = next) {
        for (next = c + 1; next < W && zones[next] === zones[c] && (!this.x || rows[next] === rows[c]);) next++;
        if (zones[c] < 0) continue;
        this.chart.used.add(zones[c]);
        if (word[zones[c]].means === "off") continue;
        const [a, b] = this.ends(row, rows[c]), y = Math.max(Math.floor(high(b)), 0), below = Math.min(Math.max(Math.ceil(high(a)), y + 1), H);
        if (!(b > a)) continue;
        if (!inks.has(zones[c])) inks.set(zones[c], ink(zoneColour(run, zones[c])));
        for (let h = y; h < below; h++) pixels.fill(inks.get(zones[c]), h * W + c, h * W + next);
      }
    }
    ctx.putImageData(image, 0, 0);
    this.source.data = {url: [canvas.toDataURL()], x: [from], w: [to - from]};
  }
}

/* A colour #rrggbb or #rgb as a pixel of an image. */
function ink(colour) {
  const hex = colour.slice(1), [r, g, b] = hex.length === 3 ? [...hex].map(c => parseInt(c + c, 16)) : [0, 2, 4].map(i => parseInt(hex.slice(i, i + 2), 16));
  return new Uint32Array(new Uint8Array([r, g, b, 255]).buffer)[0];
}
