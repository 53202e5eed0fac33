/* The line on its route, to scale: a plane picture of arcs and straights, in which curves turn so that the line gets on. */
class Path {
  constructor(stations, from, to) {
    const curved = stations.filter(s => s.curvature > 0 && s.begin !== null && s.end !== null && s.end > s.begin);
    this.parts = [];
    let s = Math.min(from, ...curved.map(c => c.begin)), x = 0, y = 0, heading = 0, side = 1;
    const add = (end, curvature) => {
      if (end <= s) return;
      this.parts.push({s, end, x, y, heading, curvature});
      [x, y, heading] = this.walk(this.parts[this.parts.length - 1], end); s = end;
    };
    for (const c of curved) {
      add(c.begin, 0);
      const turn = (c.end - c.begin) * c.curvature;
      if (Math.abs(heading + side * turn) > Math.abs(heading - side * turn) + 1e-9) side = -side;
      c.side = side; add(c.end, side * c.curvature);
    }
    add(Math.max(to, s + 1e-6), 0);
  }
  walk(p, s) {
    const d = s - p.s, k = p.curvature;
    if (!k) return [p.x + d * Math.cos(p.heading), p.y + d * Math.sin(p.heading), p.heading];
    const h = p.heading + d * k;
    return [p.x + (Math.sin(h) - Math.sin(p.heading)) / k, p.y - (Math.cos(h) - Math.cos(p.heading)) / k, h];
  }
  at(s) {
    let p = this.parts[0];
    for (const one of this.parts) if (one.s <= s) p = one;
    return this.walk(p, s);
  }
  /* Points of the stretch from a to b, close enough together to look round. */
  points(a, b) {
    const cuts = [a];
    for (const p of this.parts) {
      const lo = Math.max(a, p.s), hi = Math.min(b, p.end);
      if (hi > lo) { const n = p.curvature ? Math.max(1, Math.ceil((hi - lo) * Math.abs(p.curvature) / 0.05)) : 1;
        for (let i = 1; i <= n; i++) cuts.push(lo + (hi - lo) * i / n); }
    }
    if (cuts[cuts.length - 1] < b) cuts.push(b);
    return cuts.map(s => this.at(s));
  }
}

class RouteView {
  constructor(run, line, canvas) { Object.assign(this, {run, line, canvas}); this.whole = false; this.by = line.along[0]; }
  async begin() {
    this.x = this.line.positions ? (await this.run.values(this.line.positions)).first : null;
    await this.colour(this.by);
    this.outer = this.run.zones.families.filter(z => z.name.startsWith(this.line.line + ".outer") && !z.inner && /outer(_\w+)?\[\*\]$/.test(z.name) && z.zones.some(w => this.means(w)));
    this.inner = this.run.zones.families.filter(z => z.name === this.line.line + ".inner[*]");
    this.layers = this.run.zones.families.filter(z => this.line.layers.some(l => z.name === `${this.line.line}.${l}[*]`));
    this.fit();
  }
  means(word) { const w = this.run.zones.words.find(one => one.name === word); return w && ["stuck", "forward", "backward", "between"].includes(w.means); }
  /* Colours by a family; `scale` goes from where to where, by default what holds nearly all of this run. */
  async colour(name, scale) {
    this.by = name; this.values = null;
    if (!name) return;
    const family = this.run.family.get(name), values = await this.run.values(name);
    Object.assign(this, {values: values.first, family}, scale || await levels(this.run, name));
  }
  fit() {
    const finite = this.line.stations.flatMap(s => [s.begin, s.end]).filter(v => v !== null);
    let a = Math.min(...finite), b = Math.max(...finite);
    let lineFrom = a, lineTo = b;
    if (this.x) { lineFrom = this.run.family.get(this.line.positions).min; lineTo = this.run.family.get(this.line.positions).max; }
    if (!finite.length) { a = lineFrom; b = lineTo; }
    const winch = this.line.stations.find(s => s.begin === null && s.end !== null);
    const margin = Math.min(Math.max(0.7 * (b - a), 1.0), 4.0);
    this.from = this.whole ? Math.min(a, lineFrom) : Math.max(a - margin, Math.min(lineFrom, a));
    this.to = this.whole ? Math.max(b, lineTo) : Math.min(b + margin, Math.max(lineTo, b));
    if (winch) this.from = winch.end;
    if (!(this.to > this.from)) this.to = this.from + 1;
    this.path = new Path(this.line.stations, this.from, this.to);
    this.first = this.from;
  }
  resize() {
    const box = this.canvas.getBoundingClientRect(), ratio = Math.min(devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(box.width * ratio); this.canvas.height = Math.round(box.height * ratio);
    this.width = box.width; this.height = box.height; this.ratio = ratio;
    const pts = this.path.points(this.from, this.to), end = pts[pts.length - 1];
    const tilt = -Math.atan2(end[1] - pts[0][1], end[0] - pts[0][0]), c = Math.cos(tilt), s = Math.sin(tilt);
    const turned = pts.map(([x, y]) => [c * x - s * y, s * x + c * y]);
    const xs = turned.map(p => p[0]), ys = turned.map(p => p[1]);
    const pad = Math.min(64, box.width / 8), x0 = Math.min(...xs), y0 = Math.min(...ys), w = Math.max(...xs) - x0, h = Math.max(...ys) - y0;
    this.zoom = Math.min((box.width - 2 * pad) / Math.max(w, 1e-9), (box.height - 110) / Math.max(h, 1e-9));
    const ox = (box.width - this.zoom * w) / 2, oy = (box.height - this.zoom * h) / 2;
    this.tilt = tilt;
    this.screen = ([x, y]) => [ox + this.zoom * (c * x - s * y - x0), oy + this.zoom * (s * x + c * y - y0)];
    this.back = null;
  }
  /* On which side of the line its devices are drawn at s: +1 or -1. */
  side(s) {
    const near = this.line.stations.find(one => one.side && one.begin - .3 <= s && s <= one.end + .3);
    return near ? near.side : 1;
  }
  curve(ctx, a, b, offset = 0) {
    let begun = false;
    for (const p of this.path.points(a, b)) {
      const [x, y] = this.screen(p), h = p[2] + this.tilt;
      const px = x - offset * Math.sin(h), py = y + offset * Math.cos(h);
      if (begun) ctx.lineTo(px, py); else { ctx.moveTo(px, py); begun = true; }
    }
  }
  /* Devices, drawn once behind the line. */
  backdrop() {
    const back = document.createElement("canvas"); back.width = this.canvas.width; back.height = this.canvas.height;
    const ctx = back.getContext("2d"); ctx.scale(this.ratio, this.ratio);
    ctx.lineCap = "butt"; ctx.font = "600 12px system-ui, sans-serif";
    ctx.strokeStyle = css("rule"); ctx.lineWidth = 1.5; ctx.setLineDash([5, 5]);
    ctx.beginPath(); this.curve(ctx, this.from, this.to); ctx.stroke(); ctx.setLineDash([]);
    const sorted = this.line.stations.filter(s => s.type !== "Straight");
    sorted.forEach((s, k) => this.device(ctx, s, k));
    this.ruler(ctx);
    return this.back = back;
  }
  device(ctx, s, k) {
    const a = Math.max(s.begin ?? this.from, this.from), b = Math.min(s.end ?? this.to, this.to);
    if (s.begin === null) { // a winch: the drum the line comes off
      const [x, y, h] = this.path.at(b), [px, py] = this.screen([x, y]), r = 22, hh = h + this.tilt;
      const cx = px + r * Math.sin(hh), cy = py - r * Math.cos(hh);
      ctx.beginPath(); ctx.arc(cx, cy, r, 0, 7); ctx.fillStyle = css("rule"); ctx.fill(); ctx.lineWidth = 3; ctx.strokeStyle = css("device"); ctx.stroke();
      this.drum = {cx, cy, r, s: b}; this.label(ctx, s.name, cx, cy - r - 8); return;
    }
    if (b < a) return;
    const device = css("device"), mid = this.path.at((a + b) / 2), [mx, my] = this.screen(mid), h = mid[2] + this.tilt;
    ctx.strokeStyle = device; ctx.fillStyle = device;
    let away = -1, clear = 18;
    if (s.curvature > 0) {
      const side = s.side || 1; away = -side; clear = 22;
      ctx.lineWidth = 9; ctx.beginPath(); this.curve(ctx, a, b, side * 11); ctx.stroke();
      ctx.lineWidth = 1; ctx.globalAlpha = .55; ctx.beginPath(); const r = 1 / s.curvature;
      const c = this.screen([mid[0] - side * Math.sin(mid[2]) * r, mid[1] + side * Math.cos(mid[2]) * r]);
      for (const end of [a, b]) { const p = this.screen(this.path.at(end)); ctx.moveTo(...c); ctx.lineTo(...p); } ctx.stroke(); ctx.globalAlpha = 1;
      if (s.moves) { ctx.beginPath(); ctx.arc(c[0], c[1], Math.max(r * this.zoom - 14, 3), 0, 7); ctx.stroke(); }
    } else if (s.type === "Sea") {
      ctx.globalAlpha = .8; ctx.strokeStyle = css("water"); ctx.lineWidth = 54; ctx.beginPath(); this.curve(ctx, a, b); ctx.stroke(); ctx.globalAlpha = 1; clear = 30;
    } else if (b - a > 1e-9) {
      const belts = s.moves; if (belts) clear = 26;
      for (const off of belts ? [-13, 13] : [11]) {
        ctx.lineWidth = belts ? 9 : 5; ctx.globalAlpha = belts ? 1 : .7; ctx.beginPath(); this.curve(ctx, a, b, off); ctx.stroke(); ctx.globalAlpha = 1;
      }
    } else { ctx.beginPath(); ctx.arc(mx, my + 12, 4, 0, 7); ctx.fill(); }
    if (k % 2 && !s.curvature) away = -away;
    const far = away * (clear + 6 + ctx.measureText(s.name).width / 2 * Math.abs(Math.sin(h)));
    this.label(ctx, s.name, mx - far * Math.sin(h), my + far * Math.cos(h) + 4);
  }
  label(ctx, text, x, y) {
    ctx.textAlign = "center"; ctx.lineWidth = 4; ctx.strokeStyle = css("card"); ctx.fillStyle = css("ink");
    const half = ctx.measureText(text).width / 2; x = Math.min(Math.max(x, half + 4), this.width - half - 4); y = Math.min(Math.max(y, 14), this.height - 8);
    ctx.strokeText(text, x, y); ctx.fillText(text, x, y);
  }
  ruler(ctx) {
    const nice = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500].find(l => l * this.zoom > 60) || 1000;
    const y = this.height - 14; ctx.strokeStyle = css("soft"); ctx.lineWidth = 2; ctx.beginPath();
    ctx.moveTo(14, y - 4); ctx.lineTo(14, y); ctx.lineTo(14 + nice * this.zoom, y); ctx.lineTo(14 + nice * this.zoom, y - 4); ctx.stroke();
    ctx.font = "12px system-ui, sans-serif"; ctx.textAlign = "left"; ctx.fillStyle = css("soft"); ctx.fillText(`${nice} m`, 20, y - 6);
  }
  /* Where the nodes are at time t. */
  nodes(t) {
    if (!this.x) return null;
    const [i, j, f] = this.run.between(t);
    return this.x.map(v => v[i] + f * (v[j] - v[i]));
  }
  draw(t) {
    if (!this.width) this.resize();
    const ctx = this.canvas.getContext("2d"); ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.canvas.width, this.canvas.height); ctx.drawImage(this.back || this.backdrop(), 0, 0); ctx.scale(this.ratio, this.ratio);
    const nodes = this.nodes(t);
    if (!nodes) return;
    const inside = s => s >= this.first - 1e-9 && s <= this.to + 1e-9, row = this.run.row(t);
    ctx.lineCap = "round"; ctx.lineJoin = "round"; ctx.lineWidth = 7.5;
    ctx.strokeStyle = css("ink"); ctx.globalAlpha = .25; ctx.lineWidth = 10; ctx.beginPath();
    this.curve(ctx, Math.max(nodes[0], this.first), Math.min(nodes[nodes.length - 1], this.to)); ctx.stroke(); ctx.globalAlpha = 1; ctx.lineWidth = 7;
    if (this.values) {
      const between = this.values.length === nodes.length - 1 && this.family.elements[0] === 0 && !/registration|inner|outer/.test(this.by);
      this.values.forEach((v, k) => {
        const e = this.family.elements[k];
        const a = between ? nodes[e] : (nodes[e] + (nodes[e - 1] ?? nodes[e])) / 2, b = between ? nodes[e + 1] : (nodes[e] + (nodes[e + 1] ?? nodes[e])) / 2;
        this.stretch(ctx, a, b, hex(ramp((v[row] - this.low) / (this.high - this.low))));
      });
    } else this.stretch(ctx, nodes[0], nodes[nodes.length - 1], css("stuck"));
    this.marks(ctx, nodes, t, inside);
    if (this.drum) { const d = this.drum, angle = -(nodes[Math.floor(nodes.length / 2)] - d.s) * this.zoom / d.r; ctx.strokeStyle = css("ink"); ctx.lineWidth = 2; ctx.beginPath();
      for (const q of [0, 2.1, 4.2]) { ctx.moveTo(d.cx, d.cy); ctx.lineTo(d.cx + d.r * .8 * Math.cos(angle + q), d.cy + d.r * .8 * Math.sin(angle + q)); } ctx.stroke(); }
    this.ends(ctx, nodes, inside);
  }
  stretch(ctx, a, b, colour) {
    a = Math.max(a, this.first); b = Math.min(b, this.to);
    if (!(b > a)) return;
    ctx.strokeStyle = colour; ctx.beginPath(); this.curve(ctx, a, b); ctx.stroke();
  }
  /* Both ends of the line by name, also where the picture cuts the line off. */
  ends(ctx, nodes, inside) {
    ctx.font = "600 12px system-ui, sans-serif";
    for (const [s, cut, word, on] of [[nodes[0], this.first, "inboard", -1], [nodes[nodes.length - 1], this.to, "outboard", 1]]) {
      const here = inside(s), beyond = on * (s - cut) > 0;
      if (!here && !beyond) continue;
      const p = this.path.at(here ? s : cut), [x, y] = this.screen(p), h = p[2] + this.tilt, off = -26 * this.side(here ? s : cut);
      if (here) { ctx.fillStyle = css("ink"); ctx.beginPath(); ctx.arc(x, y, 5.5, 0, 7); ctx.fill(); }
      const text = here ? `${word} end` : on < 0 ? `\u2190 ${word}` : `${word} \u2192`, far = off * (1 + ctx.measureText(text).width / 52 * Math.abs(Math.sin(h)));
      if (!here && on < 0 && this.drum) this.label(ctx, text, this.drum.cx, this.drum.cy + this.drum.r + 16); // what is wound up
      else this.label(ctx, text, x - far * Math.sin(h), y + far * Math.cos(h) + 4);
    }
  }
  marks(ctx, nodes, t, inside) {
    for (const [families, away, size] of [[this.outer, 15, 4.6], [this.inner, -13, 3.2]]) for (const z of families) for (const row of z.rows) {
      const s = nodes[row.element], means = s === undefined ? "" : this.run.zones.words[zoneAt(row, t)].means;
      if (!["stuck", "forward", "backward", "between"].includes(means) || !inside(s)) continue;
      const p = this.path.at(s), [x, y] = this.screen(p), h = p[2] + this.tilt, off = away * this.side(s), cx = x - off * Math.sin(h), cy = y + off * Math.cos(h);
      ctx.fillStyle = css(means); ctx.beginPath();
      if (means === "stuck" || means === "between") ctx.rect(cx - size * .75, cy - size * .75, 1.5 * size, 1.5 * size);
      else { const d = means === "forward" ? 1 : -1; ctx.moveTo(cx + d * size * 1.35 * Math.cos(h), cy + d * size * 1.35 * Math.sin(h));
        for (const q of [2.4, -2.4]) ctx.lineTo(cx + d * size * 1.35 * Math.cos(h + q), cy + d * size * 1.35 * Math.sin(h + q)); }
      ctx.fill();
    }
    for (const z of this.layers) for (const row of z.rows) {
      const means = this.run.zones.words[zoneAt(row, t)].means, a = nodes[row.element], b = nodes[row.element + 1];
      if ((means !== "ruck" && means !== "slack") || a === undefined || b === undefined || !inside((a + b) / 2)) continue;
      const from = Math.max(a, this.first), to = Math.min(b, this.to), p = this.path.at((from + to) / 2), [x, y] = this.screen(p), h = p[2] + this.tilt;
      ctx.strokeStyle = css(means); ctx.lineWidth = 2; ctx.beginPath(); // thin, so that the colour below is seen
      if (means === "ruck") { const l = Math.max((to - from) * this.zoom / 2, 7); for (let i = -3; i <= 3; i++) { const u = l * i / 3, w = 9 * (i % 2 ? 1 : -1);
        const px = x + u * Math.cos(h) - w * Math.sin(h), py = y + u * Math.sin(h) + w * Math.cos(h); if (i === -3) ctx.moveTo(px, py); else ctx.lineTo(px, py); } }
      else { ctx.setLineDash([2, 5]); this.curve(ctx, a, b, -7); }
      ctx.stroke(); ctx.setLineDash([]); ctx.lineWidth = 7;
    }
  }
  /* What the picture shows at time t, in words. */
  words(t) {
    const count = families => { const n = {}; for (const z of families) for (const r of z.rows) { const m = this.run.zones.words[zoneAt(r, t)].means; n[m] = (n[m] || 0) + 1; } return n; };
    const outer = count(this.outer), inner = count(this.inner), layers = count(this.layers), told = [];
    const slides = n => (n.forward || 0) + (n.backward || 0);
    told.push(`on devices ${slides(outer)} contacts slide, ${outer.stuck || 0} stick`);
    if (this.inner.length) told.push(`inside the hose ${slides(inner)} slide, ${inner.stuck || 0} stick`);
    if (this.line.ruck_force) told.push(layers.ruck ? (layers.ruck > 1 ? `${layers.ruck} elements ruck` : "1 element rucks") : "no element rucks");
    if (layers.slack) told.push(`${layers.slack} elements are slack`);
    if (this.values) {
      const row = this.run.row(t); let k = -1, least = Infinity, most = -Infinity, m = -1;
      this.values.forEach((v, i) => { if (v[row] < least) { least = v[row]; k = i; } if (v[row] > most) { most = v[row]; m = i; } });
      if (k >= 0) told.push(`sticking, sliding and rucks are those of this instant, but the colours are of the row recorded at ${clock.said(this.run.times[row])}, where ${this.by.replace("[*]", "")} goes from ${shown(least, this.family.unit)} (element ${this.family.elements[k]}) to ${shown(most, this.family.unit)} (element ${this.family.elements[m]})`);
    }
    return told.join("; ");
  }
  legend() {
    const has = new Set([...this.outer, ...this.inner, ...this.layers].flatMap(z => z.zones).map(w => (this.run.zones.words.find(one => one.name === w) || {}).means));
    const entries = [["stuck", "square", "sticks"], ["forward", "right", "slides outboard"], ["backward", "left", "slides inboard"], ["between", "square", "between sticking and sliding"], ["ruck", "zigzag", "rucks"], ["slack", "dots", "slack"]];
    const told = entries.filter(([means]) => has.has(means)).map(([means, shape, text]) => [{colour: css(means), shape}, text]);
    if (this.outer.length) told.push(["transparent", "Marks on the side of the device: contacts with it" + (this.inner.length ? "; on the other side: core in hose" : "")]);
    return told;
  }
  scale() {
    const flat = "The route is to scale and flat: a bend out of the plane is drawn as if it lay in it.", said = v => shown(v, this.family.unit);
    return this.values ? `The bar holds 99 % of the recorded values. Over the whole run, also between recorded rows, the quantity goes from ${said(this.family.min)} to ${said(this.family.max)}. ${flat}` : flat;
  }
}
