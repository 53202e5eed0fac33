/* Puts the page together: the moving picture first, every plot when it comes into sight. */
const $ = id => document.getElementById(id);
const page = {runs: [], view: null, waiting: []};
window.fairlead = {clock, span, page};

function options(list, entries, chosen) {
  list.replaceChildren(...entries.map(([value, text]) => { const o = document.createElement("option"); o.value = value; o.textContent = text; return o; }));
  if (chosen !== undefined) list.value = chosen;
}
/* Make something once, when it comes into sight or when it is asked for. */
function whenSeen(element, make) {
  let made;
  const once = () => { watch.disconnect(); once.made = true; return made ??= make(); };
  const watch = new IntersectionObserver(found => { if (found.some(one => one.isIntersecting)) once(); }, {rootMargin: "500px"});
  watch.observe(element); once.element = element; page.waiting.push(once);
}
/* The menu names no section that this page does not have. */
function absent() { for (const link of document.querySelectorAll("nav a")) link.hidden = document.querySelector(link.hash).hidden; }
/* A link to a section makes what stands above it first, because plots that come into sight push the section down. */
function links() {
  absent();
  document.querySelector("nav").addEventListener("click", async e => {
    const link = e.target.closest("a"), to = link && document.querySelector(link.hash);
    if (!to) return;
    e.preventDefault(); history.replaceState(null, "", link.hash);
    await Promise.all(page.waiting.filter(make => to.compareDocumentPosition(make.element) & Node.DOCUMENT_POSITION_PRECEDING).map(make => make()));
    to.scrollIntoView(); to.focus({preventScroll: true});
  });
}

/* What nobody scrolled to is drawn when the browser has nothing else to do, a plot at a time: paper wants all of them. */
const idle = () => new Promise(done => (window.requestIdleCallback || (f => setTimeout(f, 300)))(done));
async function drawRest() {
  for (let k = 0; k < page.waiting.length; k++) { await idle(); if (!page.waiting[k].made) await page.waiting[k](); }
  document.body.dataset.drawn = "yes";
}
/* Steps of the slider: one for each row that was recorded, within what a slider can resolve and a key can cross. */
function slides(runs) {
  const t = runs[0].times, apart = Array.from(t.subarray(1), (one, k) => one - t[k]).filter(d => d > 0).sort((a, b) => a - b), usual = apart[apart.length >> 1];
  return Math.min(Math.max(usual ? Math.round(clock.end / usual) : 0, 1000), 20000);
}
/* Buttons that set the time to an instant of a verdict, which may lie between two rows. */
function instants(run) {
  const found = run.rucks.flatMap(one => [["first ruck", one.t], ...(one.most ? [["most compressed", one.most.t]] : [])].map(([text, t]) => [run.rucks.length > 1 ? `${one.line}: ${text}` : text, t]));
  if (!found.length) found.push(...run.instants.filter(([, t]) => t > 0 && t < clock.end).slice(0, 3));
  $("instants").replaceChildren(...found.map(([text, t]) => { const one = document.createElement("button"); one.type = "button"; one.textContent = text; one.title = clock.said(t); one.onclick = () => clock.set(t); return one; }));
}
function player(runs) {
  const scrub = $("scrub"), play = $("play"), end = clock.end, steps = slides(runs); scrub.max = steps;
  const say = () => { play.textContent = clock.playing ? "Pause" : "Play"; play.setAttribute("aria-pressed", String(clock.playing)); $("state").setAttribute("aria-live", clock.playing ? "off" : "polite"); };
  play.onclick = () => { clock.play(!clock.playing); say(); }; clock.stopped = [say];
  scrub.oninput = () => clock.set(end * scrub.value / steps);
  clock.heard.push(t => { scrub.value = end ? steps * t / end : 0; scrub.setAttribute("aria-valuetext", clock.said(t)); $("now").textContent = clock.said(t); });
  const about = end / 16 || 1, rates = [.01, .02, .05, .1, .2, .5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const near = rates.reduce((a, b) => Math.abs(Math.log(b / about)) < Math.abs(Math.log(a / about)) ? b : a), k = rates.indexOf(near);
  const offered = [...new Set([...rates.slice(Math.max(k - 3, 0), k + 4), 1])].sort((a, b) => a - b);
  options($("speed"), offered.map(r => [r, r === 1 ? "real time" : `${r} \u00d7`]), near); clock.rate = near;
  $("speed").onchange = () => { clock.rate = Number($("speed").value); };
  document.addEventListener("keydown", e => {
    if (/INPUT|SELECT|BUTTON|TEXTAREA|SUMMARY/.test(e.target.tagName) || e.ctrlKey || e.metaKey || e.altKey) return;
    if (e.target !== $("stage") && e.key !== "k") return;
    if (e.key === " " || e.key === "k") { e.preventDefault(); play.click(); }
    if (e.key === "ArrowRight" || e.key === "ArrowLeft") { e.preventDefault(); clock.set(clock.t + (e.key === "ArrowRight" ? 1 : -1) * end / 200); }
    if (e.key === "Home" || e.key === "End") { e.preventDefault(); clock.set(e.key === "Home" ? 0 : end); }
  });
}

async function stage(run, runs) {
  const line = run.lines[0], canvas = $("stage"), view = line ? new RouteView(run, line, canvas) : new MechanismView(run, canvas);
  canvas.className = line ? "" : view.m.boxes.length > 8 ? "mechanism tall" : "mechanism"; await view.begin(); page.view = view;
  let all = [];
  if (line) {
    $("by-label").hidden = !line.along.length; $("fit-label").hidden = !view.x;
    options($("by"), line.along.map(n => [n, `${n} [${run.family.get(n).unit}]`]), view.by);
    const paint = async () => { all = view.by ? await scales(runs, view.by) : []; $("same-label").hidden = all.length < 2; await view.colour(view.by, $("same").checked && all.length ? {low: Math.min(...all.map(s => s.low)), high: Math.max(...all.map(s => s.high))} : undefined); };
    $("by").onchange = async () => { view.by = $("by").value; await paint(); tell(); };
    $("same").onchange = async () => { await paint(); tell(); };
    await paint();
    $("fit").onchange = () => { view.whole = $("fit").checked; view.fit(); view.resize(); view.back = null; view.draw(clock.t); };
  } else { $("by-label").hidden = $("fit-label").hidden = $("same-label").hidden = $("bar").hidden = true; }
  const tell = () => { legend($("legend"), view.legend()); if (line) colourBar($("bar"), view); $("scale").textContent = view.scale() + (view.values && !$("same").checked ? apart(view, all) : "") + (line && !view.x ? " The places of its nodes were not recorded, so the line is not drawn: run with --report." : ""); view.draw(clock.t); words(); };
  const words = () => { $("state").textContent = `At ${clock.said(clock.t)}: ${view.words(clock.t) || "nothing was recorded that a picture could show"}.`; };
  page.draw = t => { view.draw(t); words(); };
  page.resized = () => { view.resize(); view.back = null; view.draw(clock.t); };
  page.resized(); tell(); instants(run);
  $("picture-of").textContent = runs.length > 1 ? `Run: ${run.label}` : "";
}

/* A choice of one of several runs for a section; nothing to choose where there is one. */
function ofRun(runs, id, make) {
  const list = $(id);
  list.parentElement.hidden = runs.length < 2;
  options(list, runs.map((r, k) => [k, r.label]), 0);
  const name = run => { $(`${id}-name`).textContent = runs.length > 1 ? `Run: ${run.label}` : ""; }; // for paper, which has no list
  list.onchange = () => { name(runs[list.value]); make(runs[list.value], true); };
  name(runs[0]);
  make(runs[0], false);
}
function zones(runs) {
  ofRun(runs, "zone-run", (run, now) => {
    const chart = new ZoneChart(run), choices = chart.choices(), before = $("zone-of").selectedOptions[0]?.textContent;
    $("zone-of").parentElement.hidden = !choices.length;
    if (!choices.length) { $("zone-note").textContent = "Nothing in this scene has zones."; $("zone-chart").replaceChildren(); $("zone-legend").replaceChildren(); return; }
    options($("zone-of"), choices.map(([text], k) => [k, text]), Math.max(0, choices.findIndex(([text]) => text === before)));
    const draw = () => chart.show(...choices[$("zone-of").value].slice(1));
    $("zone-of").onchange = $("zone-whole").onchange = draw; $("zone-whole").parentElement.hidden = !run.lines.some(one => one.positions);
    if (now) draw(); else whenSeen($("zones"), draw);
  });
}

async function begin() {
  page.runs = DATA.runs.map(d => new Run(d));
  for (const run of page.runs) await run.begin();
  const labels = page.runs.map(r => r.label.match(/^(.*) \((.*)\)$/)), alike = labels.every(m => m && m[1] === labels[0][1]);
  page.runs.forEach((r, k) => { r.short = alike ? labels[k][2] : r.label; });
  clock.end = Math.max(...page.runs.map(r => r.end)); span.begin(clock.end);
  const readable = page.runs.filter(r => r.rows > 0);
  if (!readable.length) { $("state").textContent = "No row of signals was recorded."; for (const id of ["signals", "zones", "maps"]) $(id).hidden = true; $("stage").hidden = true; absent(); return; }
  player(readable);
  if (readable.length > 1) { $("run-label").hidden = false; options($("which"), readable.map((r, k) => [k, r.label]), 0); $("which").onchange = () => stage(readable[$("which").value], readable); }
  await stage(readable[0], readable);
  clock.heard.push(t => page.draw(t));
  let later; new ResizeObserver(() => { clearTimeout(later); later = setTimeout(() => page.resized(), 80); }).observe($("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!document.documentElement.dataset.print) location.reload(); });
  signals(readable); zones(readable); maps(readable); links();
  printing();
  const ruck = readable[0].rucks[0]; clock.set(ruck ? ruck.t : clock.end * .4);
  document.body.dataset.ready = "yes"; setTimeout(drawRest, 1500);
}
begin().catch(error => { $("state").textContent = `The moving picture could not be made: ${error.message}`; throw error; });
