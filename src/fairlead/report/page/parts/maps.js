/* Devices of a route as bands across a map. */
function devices(p, line, bottom, top, from, to, colour) {
  for (const s of line.stations) if (s.type !== "Straight") {
    const a = s.begin ?? bottom, b = s.end ?? top; if (b < bottom || a > top) continue;
    p.add_layout(new Bokeh.BoxAnnotation({bottom: Math.max(a, bottom), top: Math.min(b, top), fill_color: null, line_color: colour, line_dash: "dashed", line_alpha: .8}));
    p.add_layout(new Bokeh.Label({x: from + .006 * (to - from), y: (Math.max(a, bottom) + Math.min(b, top)) / 2, text: s.name, text_font_size: "11px", text_baseline: "middle", text_color: "#ffffff", background_fill_color: "#000000", background_fill_alpha: .55, padding: 2}));
  }
}

/* From where to where a map goes along the route: the devices and what rucks, or all that the line covers. */
function reach(run, line, whole) {
  const all = run.family.get(line.positions), ends = line.stations.flatMap(s => [s.begin, s.end]).filter(v => v !== null);
  if (whole || !ends.length) return [all.min, all.max];
  const a = Math.min(...ends), b = Math.max(...ends), pad = Math.max(1, .5 * (b - a)), rucks = run.rucks.filter(one => one.line === line.line).flatMap(one => one.places || []);
  return [Math.max(all.min, Math.min(a - pad, ...rucks.map(p => p.low))), Math.min(all.max, Math.max(b + pad, ...rucks.map(p => p.high)))];
}
const meters = x => `${+x.toPrecision(3)}`;
/* Says that a map shows a part of the line only; "" where it shows all. */
function cut(run, line, bottom, top) {
  const all = line.positions && run.family.get(line.positions), near = all ? .01 * (all.max - all.min) : 0;
  return all && (bottom > all.min + near || top < all.max - near) ? `Shown are ${meters(bottom)} to ${meters(top)} m of the route; during the run the line lies from ${meters(all.min)} to ${meters(all.max)} m.` : "";
}
/* Where and when the lowest and the highest recorded value are. */
function worst(run, values, place) {
  const found = {low: {v: Infinity}, high: {v: -Infinity}};
  for (let k = 0; k < values.low.length; k++) for (let i = 0; i < run.rows; i++) {
    if (values.low[k][i] < found.low.v) found.low = {v: values.low[k][i], t: run.times[i], y: place(k, i)};
    if (values.high[k][i] > found.high.v) found.high = {v: values.high[k][i], t: run.times[i], y: place(k, i)};
  }
  return found;
}
/* Values (W, H) over time and place, NaN where the line is not. */
function gridded(run, values, place, bottom, top, W, H) {
  const grid = new Float32Array(W * H).fill(NaN), n = values.first.length;
  for (let c = 0; c < W; c++) {
    const i = run.row(run.times[0] + (run.end - run.times[0]) * (c + .5) / W);
    let k = 0;
    for (let h = 0; h < H; h++) {
      const y = bottom + (top - bottom) * (h + .5) / H;
      while (k < n - 2 && place(k + 1, i) < y) k++;
      const a = place(k, i), b = place(k + 1, i);
      if (!(y >= a - (b - a) / 2 && y <= b + (b - a) / 2)) continue;
      const f = Math.min(Math.max((y - a) / (b - a), 0), 1);
      grid[c + W * h] = values.first[k][i] + f * (values.first[k + 1][i] - values.first[k][i]);
    }
  }
  return grid;
}
function painted(grid, W, H, low, high) {
  const canvas = document.createElement("canvas"); canvas.width = W; canvas.height = H;
  const ctx = canvas.getContext("2d"), image = ctx.createImageData(W, H);
  for (let h = 0; h < H; h++) for (let c = 0; c < W; c++) { const v = grid[c + W * h]; if (Number.isFinite(v)) image.data.set([...ramp((v - low) / (high - low)), 255], 4 * (c + W * (H - 1 - h))); }
  ctx.putImageData(image, 0, 0);
  return canvas.toDataURL();
}

/* A map: time to the right, place upward, value as colour. */
async function map(run, line, name, element, whole) {
  const family = run.family.get(name), {unit, elements} = family, values = await run.values(name), xs = line.positions ? (await run.values(line.positions)).first : null;
  const between = xs && values.first.length === xs.length - 1 && elements[0] === 0, n = values.first.length;
  const place = (k, i) => !xs ? elements[k] : between ? (xs[elements[k]][i] + xs[elements[k] + 1][i]) / 2 : xs[elements[k]] ? xs[elements[k]][i] : NaN;
  let [bottom, top] = xs ? reach(run, line, whole) : [elements[0], elements[n - 1]];
  if (!(top > bottom)) { bottom = elements[0]; top = elements[n - 1] + 1; }
  const W = Math.min(700, Math.max(run.rows, 2)), H = 200, grid = gridded(run, values, place, bottom, top, W, H);
  const all = grid.filter((v, k) => k % 11 === 0 && Number.isFinite(v)).sort(), low = all[Math.floor(.003 * all.length)] ?? 0, high0 = all[Math.floor(.997 * all.length)] ?? 1, high = high0 > low ? high0 : low + 1;
  const ends = worst(run, values, place), bar = scaled(ticks(low, high), unit), t0 = run.times[0];

  const box = document.createElement("div"), title = document.createElement("b"), note = document.createElement("p"), at = document.createElement("div"); box.className = "panel"; note.className = "small";
  title.textContent = `${name} [${unit}]`;
  const told = (word, one) => `${word} ${shown(one.v, unit)} at ${shown(one.t, "s")}, ${xs ? shown(one.y, "m") : `element ${one.y}`}`;
  note.textContent = [`${told("\u25bc lowest", ends.low)}; ${told("\u25b2 highest", ends.high)}, of recorded rows.`, xs ? cut(run, line, bottom, top) : ""].join(" ").trim();
  box.append(title, note, at); element.append(box);
  const p = figure({height: 280, x_range: span.range(), y_range: new Bokeh.Range1d({start: bottom, end: top})}, "time [s]", xs ? "place on the route [m]" : "element");
  p.image_url({value: painted(grid, W, H, low, high)}, t0, bottom, run.end - t0, top - bottom, {anchor: "bottom_left"});
  if (xs) devices(p, line, bottom, top, t0, run.end, "#ffffff");
  for (const [marker, one] of [["inverted_triangle", ends.low], ["triangle", ends.high]]) if (Number.isFinite(one.v)) p.scatter([one.t], [one.y], {marker, size: 12, line_width: 1.5, line_color: "#ffffff", fill_color: "#d3261a"});
  p.add_layout(new Bokeh.ColorBar({color_mapper: new Bokeh.LinearColorMapper({palette: PALETTE, low, high}), ticker: new Bokeh.FixedTicker({ticks: bar.texts.map(([v]) => v)}), major_label_overrides: new Map(bar.texts),
    background_fill_color: null, major_label_text_color: css("soft"), width: 12, title: `[${bar.unit}]`, title_text_color: css("soft"), title_text_font_size: "11px", title_text_font_style: "normal"}), "right");
  const view = await put(p, at); cursor(at, view);
  hover(at, view, (t, y) => {
    const i = run.row(t); let k = -1, far = Infinity;
    for (let j = 0; j < n; j++) { const d = Math.abs(place(j, i) - y); if (d < far) { far = d; k = j; } }
    return k < 0 ? null : [`${name.replace("[*]", `[${elements[k]}]`)} = ${shown(values.first[k][i], unit)}`, `t = ${clock.said(run.times[i])}, ${xs ? shown(place(k, i), "m") + " on the route" : ""}`];
  });
}

function maps(runs) {
  const with_maps = runs.filter(run => mapped(run).length);
  $("maps").hidden = !with_maps.length;
  if (!with_maps.length) return;
  ofRun(with_maps, "map-run", (run, now) => {
    const draw = async gently => { const made = document.createElement("div"); $("map-list").replaceChildren(made); for (const name of mapped(run)) { await map(run, run.lines[0], name, made, $("map-whole").checked); if (gently) await idle(); } };
    $("map-whole").onchange = () => draw(false); $("map-whole").parentElement.hidden = !run.lines[0].positions;
    if (now) draw(false); else whenSeen($("maps"), () => draw(true));
  });
}
function mapped(run) {
  const line = run.lines[0];
  return line ? line.along.filter(n => /\.(tension|torque|d|slip|angle|turned)$/.test(n) && run.family.get(n).elements.length > 3).slice(0, 5) : [];
}
