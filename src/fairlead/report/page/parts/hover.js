/* A small box beside the pointer that says what a plot shows there: `tell(x, y, frame)` gives its lines, or nothing. */
function hover(box, view, tell) {
  const tip = document.createElement("div"); tip.className = "tip"; tip.hidden = true; box.append(tip);
  const away = () => { tip.hidden = true; };
  box.addEventListener("pointerleave", away);
  box.addEventListener("pointermove", e => {
    const f = view.frame && view.frame.bbox;
    if (!f || !box.isConnected) return away();
    const inner = view.el.getBoundingClientRect(), outer = box.getBoundingClientRect(), xr = view.frame.x_range, yr = view.frame.y_range;
    const u = (e.clientX - inner.left - f.left) / f.width, v = 1 - (e.clientY - inner.top - f.top) / f.height;
    const lines = u >= 0 && u <= 1 && v >= 0 && v <= 1 ? tell(xr.start + u * (xr.end - xr.start), yr.start + v * (yr.end - yr.start), f.height / (yr.end - yr.start)) : null;
    if (!lines || !lines.length) return away();
    tip.replaceChildren(...lines.map(text => { const p = document.createElement("div"); p.textContent = text; return p; })); tip.hidden = false;
    const left = e.clientX - outer.left, top = e.clientY - outer.top, wide = tip.offsetWidth;
    tip.style.transform = `translate(${left + 14 + wide > outer.width ? left - 14 - wide : left + 14}px, ${top + 12}px)`;
  });
}

/* Lines across a plot: what a hose or a signal must not pass, and when a hose rucks first. */
function marked(p, runs, names, time) {
  const told = [], ruck = css("ruck"), across = (location, label) => {
    p.add_layout(new Bokeh.Span({location, dimension: "width", line_color: ruck, line_width: 1.4, line_dash: [7, 4]})); told.push([dashed(ruck, "7 4"), label]);
  };
  const once = new Set();
  for (const run of runs) {
    for (const line of run.lines) if (line.ruck_force && names.includes(`${line.line}.${line.layers[0]}[*].tension`)) once.add(-line.ruck_force);
    if (time) for (const one of run.rucks) {
      p.add_layout(new Bokeh.Span({location: one.t, dimension: "height", line_color: ruck, line_width: 1.4, line_dash: [2, 3]}));
      told.push([upright(ruck, "2 3"), `first ruck, ${shown(one.t, "s")}${runs.length > 1 ? ", " + run.short : ""}`]);
    }
  }
  for (const at of once) across(at, `below ${shown(at, "N")} the hose rucks`);
  const limits = new Map(runs.flatMap(run => run.limits || []).filter(one => names.some(n => n === one.signal || n.replace("[*]", "") === one.signal.replace(/\[[^\]]*\]/, ""))).map(one => [one.text + one.signal, one]));
  for (const one of limits.values()) if (!once.has(one.bound)) across(one.bound, `limit: ${one.text}`);
  return told;
}
