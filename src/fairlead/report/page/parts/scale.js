/* The scale of the colours along a line: from where to where it goes, drawn as a bar with values and unit. */
/* What holds 99 % of the recorded values of a family; single peaks do not take the colours from all others. */
async function levels(run, name) {
  const values = (await run.values(name)).first, some = [], step = Math.max(1, Math.floor(values.length * run.rows / 20000));
  let i = 0;
  for (const v of values) for (let r = (i++ * 7) % step; r < v.length; r += step) if (Number.isFinite(v[r])) some.push(v[r]);
  some.sort((a, b) => a - b);
  const low = some[Math.floor(.005 * some.length)] ?? 0, high = some[Math.floor(.995 * some.length)] ?? 1;
  return {low, high: high > low ? high : low + 1};
}
/* The scales of all runs that have a family, each with its run. */
async function scales(runs, name) {
  const found = [];
  for (const run of runs) if (run.family.has(name)) found.push({run, ...await levels(run, name)});
  return found;
}
function colourBar(box, view) {
  box.hidden = !view.values;
  if (!view.values) return;
  const {low, high} = view, {texts, unit} = scaled(ticks(low, high), view.family.unit), strip = document.createElement("div"), of = document.createElement("b");
  strip.className = "strip"; strip.style.background = `linear-gradient(90deg, ${VIRIDIS.map(hex).join(", ")})`;
  for (const [value, text] of texts) { const one = document.createElement("span"); one.textContent = text; one.style.left = `${100 * (value - low) / (high - low)}%`; strip.append(one); }
  of.textContent = `${view.by} [${unit}]`; box.replaceChildren(of, strip);
  box.setAttribute("aria-label", `Colours: ${view.by} from ${shown(low, view.family.unit)}, dark, to ${shown(high, view.family.unit)}, bright`);
}
/* Says that another run has another scale, so that nobody compares the colours of two runs; "" where there is none. */
function apart(view, all) {
  const others = all.filter(one => one.run !== view.run && (one.low !== view.low || one.high !== view.high));
  return others.length ? ` The scale is that of ${view.run.short}. ${others.map(one => `That of ${one.run.short} goes from ${shown(one.low, view.family.unit)} to ${shown(one.high, view.family.unit)}`).join("; ")}: one colour means two values.` : "";
}
