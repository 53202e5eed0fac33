/* Plots over time and along the line, drawn by Bokeh; all share one range of time and the cursor of the clock. */
const B = () => Bokeh.Plotting;
const TOOLS = "xbox_zoom,xpan,xwheel_zoom,xzoom_in,xzoom_out,reset,save";
const MOST_POINTS = 60000;

function styled(p, x, y) {
  Object.assign(p, {background_fill_color: null, border_fill_color: null, sizing_mode: "stretch_width"});
  for (const [axis, label] of [[p.xaxis, x], [p.yaxis, y]]) for (const a of [].concat(axis))
    Object.assign(a, {axis_label: label, axis_label_text_font_style: "normal", axis_label_text_font_size: "12px", minor_tick_line_color: null, major_label_text_font_size: "11px"});
  p.min_border_left = innerWidth < 600 ? 56 : 74; // plots that stand above each other have one time axis
  for (const a of [].concat(p.xaxis)) if (x === "time [s]") measuredAxis(a, "time", "s", [0, span.whole_end], 1e-3);
  p.toolbar.logo = null;
  for (const tool of p.toolbar.tools) if (tool.type === "WheelZoomTool") tool.modifiers = {ctrl: true}; // the wheel alone scrolls the page
  p.toolbar.active_drag = p.toolbar.tools.find(tool => tool.type === "BoxZoomTool") || "auto";
  return inked(p);
}
/* Numbers along an axis in one power of ten, which stands with the unit: 5, 10, 15 and [MPa]. `least` is what is small. */
function measuredAxis(axis, what, unit, values, least = 1e-3) {
  const known = values.filter(Number.isFinite), size = Math.max(...known.map(Math.abs), 0), {power, unit: said} = size >= least && size < 1e5 ? {power: 0, unit} : scaled(known, unit);
  const plain = said === "1" || said === "" ? "" : said.replace(/ 1$/, "");
  axis.axis_label = [what, plain && `[${plain}]`].filter(Boolean).join(" ") || "value";
  const formatter = new Bokeh.BasicTickFormatter(); // a class of its own would need eval, which the page forbids
  formatter.doFormat = at => {
    const step = at.length > 1 ? Math.min(...at.slice(1).map((v, k) => Math.abs(v - at[k]))) : Math.abs(at[0] || 1), decimals = Math.min(Math.max(1 - Math.floor(Math.log10(step / 10 ** power)), 0), 20);
    return at.map(v => { const one = +(v / 10 ** power).toFixed(decimals), text = Math.abs(one) < 1e-6 && one ? String(one) : one.toLocaleString("en", {useGrouping: false, maximumFractionDigits: 12}); return text.replace("-", "\u2212"); });
  };
  axis.formatter = formatter;
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
async function put(p, element) { const found = await B().show(p, element), view = Array.isArray(found) ? found[0] : found; view.notify_about = () => {}; views.set(element, view); return view; }
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
