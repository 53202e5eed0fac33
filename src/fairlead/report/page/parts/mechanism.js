const READABLE = .78, SMALLEST = .5, MOST_TILES = 60;
/* A text that is at most so wide [px]: what does not fit is left out of its middle. */
function fitted(ctx, text, room) {
  let one = text;
  for (let n = text.length - 1; n > 2 && ctx.measureText(one).width > room; n--) one = `${text.slice(0, Math.ceil(n / 2) - 1)}\u2026${text.slice(-Math.floor(n / 2))}`;
  return one;
}
/* The mechanism of a scene without a line: boxes as they are wired, moved by what was recorded; strips of many elements. */
class MechanismView {
  constructor(run, canvas) { Object.assign(this, {run, canvas, m: run.mechanism || {boxes: [], wires: [], strips: []}}); }
  async begin() {
    const first = async name => name ? (await this.run.values(name)).first[0] : null;
    for (const b of this.m.boxes) {
      b.xs = await first(b.x); b.angles = await first(b.angle); b.row = null;
      if (b.angles) b.w += 26; // room for its wheel
      for (const z of this.run.zones.families) for (const r of z.rows)
        if (!z.inner && (z.name === b.name || (z.name.startsWith(b.name + ".") && r.element < 0)) && (!b.row || this.tells(z, r) > b.tells)) { b.row = r; b.tells = this.tells(z, r); }
      b.values = [];
      for (const name of b.shown) { const {unit, min, max} = this.run.family.get(name); b.values.push({name: name.slice(b.name.length + 1), unit, min, max, v: await first(name)}); }
      b.range = b.x ? this.span(b.x) : 0;
    }
    this.groups = this.joined().map(boxes => {
      const ranges = boxes.map(b => b.range).filter(r => r > 0).sort((a, b) => a - b), group = {boxes, reach: ranges[0] || 0};
      for (const b of boxes) { b.group = group; b.travels = b.range > 12 * group.reach; }
      for (const b of boxes) if (!b.travels) group.reach = Math.max(group.reach, b.range);
      return group;
    });
    for (const s of this.m.strips) {
      s.v = (await this.run.values(s.family)).first; s.unit = this.run.family.get(s.family).unit;
      const own = s.family.split(".")[0] + ".";
      s.zones = this.run.zones.families.find(z => !z.inner && z.name.startsWith(own) && z.rows.length >= s.v.length - 1 && z.rows.length <= s.v.length + 1 && z.rows.length > 2);
      let most = 0; for (const v of s.v) for (let i = 0; i < v.length; i += 1 + (v.length >> 9)) most = Math.max(most, Math.abs(v[i] - v[0]));
      s.most = most || 1;
    }
  }
  /* Boxes that push and pull one another, in groups: each has a scale of its own, so that none stands still beside another. */
  joined() {
    const of = this.m.boxes.map((_, k) => k), root = k => { while (of[k] !== k) k = of[k]; return k; }, found = new Map();
    for (const w of this.m.wires) if (w.domain === "translational") for (const e of w.ends) of[root(e.box)] = root(w.ends[0].box);
    this.m.boxes.forEach((b, k) => { const r = root(k); if (!found.has(r)) found.set(r, []); found.get(r).push(b); });
    return [...found.values()];
  }
  /* How much a row says of its part: a state machine says more than the comparators in it. */
  tells(family, row) { return 1e6 * new Set([row.start, ...row.to]).size + row.t.length; }
  span(name) { const f = this.run.family.get(name); return f.max - f.min; }
  resize() {
    this.canvas.style.height = ""; this.down = this.tiles = null;
    let box = this.canvas.getBoundingClientRect();
    const all = [...this.m.boxes, ...this.m.wires];
    const x0 = Math.min(...all.map(b => b.cx - b.w / 2)), x1 = Math.max(...all.map(b => b.cx + b.w / 2));
    const y0 = Math.min(...all.map(b => b.cy - b.h / 2)), y1 = Math.max(...all.map(b => b.cy + b.h / 2));
    const strip = this.m.strips.length ? Math.min(96 * this.m.strips.length, .62 * box.height) : 0;
    const wide = x1 - x0, high = y1 - y0, widest = Math.max(...this.m.boxes.map(b => b.w), 0), gap = 46;
    const usual = box.height, room = Math.max(640, usual); // there is room below
    let taken = usual;
    const fits = n => Math.min((box.width - 70) / Math.max(wide / n + (n > 1 ? widest : 0), 1), (taken - strip - 60) / Math.max(n * high + (n - 1) * gap, 1), 2);
    let rows = 1; const broken = () => { rows = 1; for (let n = 2; n <= 8; n++) if (fits(n) > 1.15 * fits(rows)) rows = n; }; // a long chain is broken into rows
    broken(); const first = fits(rows); if (first < READABLE) { taken = room; broken(); if (fits(rows) < 1.15 * first) { taken = usual; broken(); } }
    const row = x => Math.min(rows - 1, Math.floor((x - x0) * rows / (wide || 1))), crossing = this.m.wires.flatMap(w => w.ends.filter(e => row(this.m.boxes[e.box].cx) !== row(w.cx))).length;
    const across = fits(rows) * (crossing > 2 * (rows - 1) ? .75 : 1), below = across < READABLE || rows > 1 ? this.downward(box.width) : null, down = below && below.high < (box.width < 800 ? Math.max(2.2 * box.width, 900) : .7 * box.width) ? below : null;
    const best = Math.max(across, down ? down.zoom : 0);
    if (best < SMALLEST && this.m.boxes.length > 6) { this.tiled(box.width); this.high(this.tiles.high + strip); return; }
    if (down && down.zoom > across) { this.down = down; this.high(down.high + strip); this.zoom = down.zoom; this.at = down.at; this.stripTop = this.height - strip; this.room(); return; }
    this.high(taken > usual ? taken : 0); box = {width: this.width, height: this.height};
    const z = this.zoom = fits(rows), band = wide / rows, over = rows > 1 ? widest : 0;
    const ox = (box.width - z * (band + over)) / 2 + z * over / 2, oy = (box.height - strip - z * (rows * high + (rows - 1) * gap)) / 2;
    this.at = (x, y) => { const k = Math.min(rows - 1, Math.max(0, Math.floor((x - x0) / (band || 1)))); return [ox + z * (x - x0 - k * band), oy + z * (y - y0 + k * (high + gap))]; };
    this.stripTop = box.height - strip; this.room();
  }
  /* The picture so many pixels high; 0 leaves what the style has. */
  high(pixels) {
    if (pixels) this.canvas.style.height = `${Math.ceil(pixels)}px`;
    const box = this.canvas.getBoundingClientRect(), ratio = Math.min(devicePixelRatio || 1, 2);
    Object.assign(this, {width: box.width, height: box.height, ratio});
    this.canvas.width = Math.round(box.width * ratio); this.canvas.height = Math.round(box.height * ratio);
    if (pixels) this.stripTop = this.height - (this.m.strips.length ? Math.min(96 * this.m.strips.length, .62 * box.height) : 0);
  }
  /* The wiring from the top down, for a narrow page: layers below each other, what stood above stands on the left. */
  downward(width) {
    const layers = new Map(), {boxes, wires} = this.m, all = [...boxes, ...wires];
    for (const b of boxes) { const key = Math.round(b.cx); if (!layers.has(key)) layers.set(key, []); layers.get(key).push(b); }
    const order = [...layers.keys()].sort((a, b) => a - b), y0 = Math.min(...all.map(b => b.cy)), x0 = order[0];
    let sx = 0, sy = 0; const broad = b => Math.max(b.w, b.values.length ? 118 : 0); // the values below a box, too
    for (const each of layers.values()) { each.sort((a, b) => a.cy - b.cy); for (let k = 1; k < each.length; k++) sx = Math.max(sx, ((broad(each[k]) + broad(each[k - 1])) / 2 + 14) / Math.max(each[k].cy - each[k - 1].cy, 1)); }
    const tall = key => Math.max(...layers.get(key).map(b => b.h));
    for (let k = 1; k < order.length; k++) sy = Math.max(sy, ((tall(order[k]) + tall(order[k - 1])) / 2 + 64) / (order[k] - order[k - 1]));
    sx = sx || 1; const left = Math.min(...boxes.map(b => sx * (b.cy - y0) - b.w / 2), 0), right = Math.max(...all.map(b => sx * (b.cy - y0) + (b.type ? b.w / 2 : 0)));
    const zoom = Math.min((width - 76) / Math.max(right - left, 1), 1.1), ends = [tall(order[0]) / 2, tall(order[order.length - 1]) / 2];
    const high = zoom * (sy * (order[order.length - 1] - x0) + ends[0] + ends[1]) + 70, ox = (width - zoom * (right - left)) / 2 - zoom * left, oy = 24 + zoom * ends[0];
    return {zoom, high, at: (x, y) => [ox + zoom * sx * (y - y0), oy + zoom * sy * (x - x0)]};
  }
  /* A tile for each part that has a zone, where the wiring would be too small to read. */
  tiled(width) {
    const moving = b => b.row && b.row.t.length, telling = this.m.boxes.filter(b => b.row || b.values.length), zoned = this.m.boxes.filter(moving);
    this.only = telling.length > MOST_TILES && zoned.length > 0;
    const list = this.only ? zoned : telling.length ? telling : this.m.boxes, columns = Math.max(1, Math.floor((width - 16) / 168)), wide = (width - 16) / columns;
    this.tiles = {list, columns, wide, high: 46 * Math.ceil(list.length / columns) + 16};
  }
  tile(ctx, b, k, t) {
    const {columns, wide} = this.tiles, x = 8 + wide * (k % columns), y = 8 + 46 * Math.floor(k / columns), w = wide - 8, zone = b.row ? zoneAt(b.row, t) : null, v = b.values[0];
    ctx.fillStyle = css("paper"); ctx.fillRect(x, y, w, 40); ctx.fillStyle = zone === null ? css("device") : zoneColour(this.run, zone); ctx.fillRect(x, y, 8, 40);
    ctx.textAlign = "left"; ctx.fillStyle = css("ink"); ctx.font = "600 11px system-ui, sans-serif"; ctx.fillText(fitted(ctx, b.name, w - 18), x + 14, y + 14);
    ctx.fillStyle = css("soft"); ctx.font = "11px system-ui, sans-serif";
    ctx.fillText(fitted(ctx, [zone === null ? b.type : this.run.zones.words[zone].name, v ? `${v.name} ${shown(this.value(v.v, t), v.unit)}` : ""].filter(Boolean).join(", "), w - 18), x + 14, y + 28);
    if (!v || !(v.max > v.min)) return;
    const share = (this.value(v.v, t) - v.min) / (v.max - v.min); ctx.fillStyle = css("rule"); ctx.fillRect(x + 14, y + 34, w - 24, 2);
    ctx.fillStyle = css("accent"); ctx.fillRect(x + 14 + Math.min(Math.max(share, 0), 1) * (w - 28), y + 32, 4, 6);
  }
  /* How many values there is room for below each box. */
  room() {
    const z = this.zoom, at = this.m.boxes.map(b => this.at(b.cx, b.cy)), most = this.m.boxes.length > 12 ? 1 : 2;
    this.m.boxes.forEach((b, k) => {
      let free = this.stripTop - at[k][1] - b.h * z / 2 - (b.travels ? 8 : 0);
      this.m.boxes.forEach((o, j) => { const below = at[j][1] - at[k][1] - (o.h + b.h) * z / 2; if (j !== k && below > 0 && Math.abs(at[j][0] - at[k][0]) < (o.w + b.w) * z / 2) free = Math.min(free, below); });
      b.lines = z < .5 ? 0 : Math.max(0, Math.min(most, Math.floor((free - 5) / 13)));
    });
  }
  value(v, t) { const [i, j, f] = this.run.between(t); return v[i] + f * (v[j] - v[i]); }
  /* How far each wire and each box is moved in the picture [px]: what is joined moves together. */
  moves(t) {
    const moved = this.m.boxes.map(b => b.xs && !b.travels ? 34 / (b.group.reach || 1) * (this.value(b.xs, t) - b.xs[0]) : b.fixed && !b.xs ? 0 : null);
    const wires = this.m.wires.map(w => { const known = w.ends.map(e => this.m.boxes[e.box]).map((b, k) => moved[w.ends[k].box]).filter((d, k) => d !== null && this.m.boxes[w.ends[k].box] && !this.m.boxes[w.ends[k].box].travels); return known.length && w.domain === "translational" ? known.reduce((a, b) => Math.abs(a) > Math.abs(b) ? a : b) : null; });
    this.m.boxes.forEach((b, k) => { if (moved[k] === null) {
      const own = this.m.wires.map((w, n) => [w, wires[n]]).filter(([w, d]) => d !== null && w.ends.some(e => e.box === k)).map(([, d]) => d);
      moved[k] = own.length ? own.reduce((a, c) => a + c, 0) / Math.max(own.length, 2) : 0; } });
    return {boxes: moved, wires: wires.map(d => d || 0)};
  }
  draw(t) {
    if (!this.width) this.resize();
    const ctx = this.canvas.getContext("2d"); ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0); ctx.clearRect(0, 0, this.width, this.height);
    if (this.tiles) { this.tiles.list.forEach((b, k) => this.tile(ctx, b, k, t)); this.m.strips.forEach((s, k) => this.strip(ctx, s, k, t)); return; }
    const moved = this.moves(t), z = this.zoom;
    ctx.lineWidth = 2; ctx.strokeStyle = css("device");
    this.m.wires.forEach((w, n) => {
      const [wx, wy] = this.at(w.cx, w.cy), px = wx + moved.wires[n];
      ctx.setLineDash(w.domain === "signal" ? [4, 4] : []); ctx.beginPath();
      for (const e of w.ends) { const b = this.m.boxes[e.box], [bx, by] = this.at(b.cx, b.cy), side = w.cx > b.cx ? 1 : -1, sx = bx + moved.boxes[e.box] + side * b.w * z / 2;
        if (this.down) { const sy = by + side * b.h * z / 2, at = bx + moved.boxes[e.box]; ctx.moveTo(at, sy); ctx.bezierCurveTo(at, (sy + wy) / 2, px, (sy + wy) / 2, px, wy); continue; }
        ctx.moveTo(sx, by); ctx.bezierCurveTo((sx + px) / 2, by, (sx + px) / 2, wy, px, wy); }
      ctx.stroke(); ctx.setLineDash([]); ctx.beginPath(); ctx.fillStyle = css("device"); ctx.arc(px, wy, 3.5, 0, 7); ctx.fill();
    });
    this.m.boxes.forEach((b, k) => this.box(ctx, b, moved.boxes[k], t));
    this.m.strips.forEach((s, k) => this.strip(ctx, s, k, t));
  }
  box(ctx, b, dx, t) {
    const [cx, y] = this.at(b.cx, b.cy), x = cx + dx, z = this.zoom, w = b.w * z, h = b.h * z, zone = b.row ? zoneAt(b.row, t) : null;
    ctx.fillStyle = b.fixed ? css("rule") : css("paper"); ctx.strokeStyle = zone === null ? css("device") : zoneColour(this.run, zone); ctx.lineWidth = zone === null ? 1.5 : 4;
    ctx.beginPath(); ctx.roundRect(x - w / 2, y - h / 2, w, h, 5); ctx.fill(); ctx.stroke();
    if (b.travels) { // a belt: ticks that run
      const d = this.value(b.xs, t) * 60 / (b.group.reach || 1) / 8, step = 12; ctx.lineWidth = 2; ctx.strokeStyle = css("accent"); ctx.beginPath();
      for (let q = ((d % step) + step) % step; q < w; q += step) { ctx.moveTo(x - w / 2 + q, y + h / 2 + 2); ctx.lineTo(x - w / 2 + q - 4, y + h / 2 + 9); } ctx.stroke();
    }
    if (b.angles) { const a = this.value(b.angles, t), r = Math.min(h / 2 - 3, 15); ctx.lineWidth = 2; ctx.strokeStyle = css("accent"); ctx.beginPath(); ctx.arc(x - w / 2 + r + 4, y, r, 0, 7);
      for (const q of [0, 2.0944, 4.1888]) { ctx.moveTo(x - w / 2 + r + 4, y); ctx.lineTo(x - w / 2 + r + 4 + r * Math.cos(a + q), y + r * Math.sin(a + q)); } ctx.stroke(); }
    const size = Math.max(10, Math.min(12.5, 12 * z)), left = b.angles ? 2 * Math.min(h / 2 - 3, 15) + 6 : 0; ctx.textAlign = "center"; ctx.fillStyle = css("ink"); ctx.font = `600 ${size}px system-ui, sans-serif`;
    const small = h < 26, room = w - left - 4;
    ctx.fillText(fitted(ctx, b.name, room), x + left / 2, small ? y + 4 : y - 2); ctx.font = `${size - 1.5}px system-ui, sans-serif`; ctx.fillStyle = css("soft");
    if (!small) ctx.fillText(fitted(ctx, zone === null ? b.type : this.run.zones.words[zone].name, room), x + left / 2, y + size);
    b.values.slice(0, b.lines).forEach((v, k) => { const text = `${v.name} ${shown(this.value(v.v, t), v.unit)}`; ctx.font = "11px system-ui, sans-serif"; const broad = ctx.measureText(text).width + 6; ctx.fillStyle = css("card");
      ctx.fillRect(x - broad / 2, y + h / 2 + 4 + 13 * k + (b.travels ? 8 : 0), broad, 13); ctx.fillStyle = css("soft"); ctx.fillText(text, x, y + h / 2 + 14 + 13 * k + (b.travels ? 8 : 0)); });
  }
  strip(ctx, s, k, t) {
    const n = s.v.length, left = 20, wide = this.width - 40, pitch = wide / n, y = this.stripTop + 40 + 92 * k, [i, j, f] = this.run.between(t);
    const reach = Math.max(2.2 * pitch, 24), scale = reach / s.most; let common = 0;
    ctx.font = "11px system-ui, sans-serif"; ctx.textAlign = "left"; ctx.fillStyle = css("soft"); ctx.fillText(`${s.family}: each mark at its place, moved by at most ${shown(s.most, s.unit)}`, left, y - 30);
    ctx.fillStyle = css("rule"); ctx.fillRect(left, y + 23, wide, 2);
    for (let e = 0; e < n; e++) {
      const v = s.v[e], d = v[i] + f * (v[j] - v[i]) - v[0], row = s.zones && (s.zones.rows[e] || null);
      ctx.fillStyle = row ? zoneColour(this.run, zoneAt(row, t)) : css("accent");
      ctx.fillRect(left + (e + .5) * pitch + scale * d - Math.max(pitch * .32, 1), y - 16, Math.max(pitch * .64, 2), 38);
    }
  }
  words(t) {
    const zoned = this.m.boxes.filter(b => b.row), told = zoned.length > 6 ? [`${zoned.length} parts have zones: ${this.counted(zoned.map(b => b.row), t)}`] : zoned.map(b => `${b.name} is ${this.run.zones.words[zoneAt(b.row, t)].name}`);
    for (const s of this.m.strips) if (s.zones) told.push(`${s.zones.name}: ${this.counted(s.zones.rows, t)}`);
    return told.join("; ") || this.m.boxes.filter(b => b.values.length).slice(0, 4).map(b => `${b.name}.${b.values[0].name} ${shown(this.value(b.values[0].v, t), b.values[0].unit)}`).join("; ");
  }
  /* How many rows are in which zone. */
  counted(rows, t) {
    const n = {}; for (const r of rows) { const w = this.run.zones.words[zoneAt(r, t)].name; n[w] = (n[w] || 0) + 1; }
    return Object.entries(n).map(([w, c]) => `${c} ${w}`).join(", ");
  }
  legend() {
    const words = new Set(); for (const b of this.m.boxes) if (b.row) { words.add(b.row.start); b.row.to.forEach(z => words.add(z)); }
    for (const s of this.m.strips) if (s.zones) for (const r of s.zones.rows) { words.add(r.start); r.to.forEach(z => words.add(z)); }
    return [...words].map(z => [zoneColour(this.run, z), this.run.zones.words[z].name]);
  }
  scale() { if (this.tiles) return `The ${this.m.boxes.length} parts are too many to draw as they are wired: here is a tile for each part that ${this.only ? "changes zone" : "has a zone or a value"}; its mark goes from the lowest to the highest value. The wiring stands under Scene.${this.left()}`;
    const moving = this.groups.filter(g => g.reach > 0).sort((a, b) => b.reach - a.reach), first = g => g.boxes.find(b => b.range && !b.travels).name;
    const said = moving.length > 1 ? `${moving.slice(0, 3).map(g => `${shown(g.reach, "m")} of ${first(g)}`).join(", ")}${moving.length > 3 ? " and more" : ""} (each with what is joined to it)` : moving.length ? shown(moving[0].reach, "m") : "";
    return said ? `Boxes move with their recorded positions, ${said} drawn as 34 px${this.m.boxes.some(b => b.travels) ? "; running ticks are what travels far" : ""}.${this.left()}` : "No position of a part was recorded, so boxes stand still; values and zones move with time." + this.left(); }
  left() { return this.m.left_out ? ` ${this.m.left_out} more parts are not drawn.` : ""; }
}
