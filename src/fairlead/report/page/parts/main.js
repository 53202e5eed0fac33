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
/* A link to a section makes what stands above it first, because plots that come into sight push the section down. */
function links() {
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
/* On paper: light colours, pictures of the plots, and what is folded open if it is for readers of paper; back again afterwards. */
function printing() {
  const opened = [], root = document.documentElement, stage = $("stage"); let undo = null;
  addEventListener("beforeprint", () => {
    if (undo) return;
    root.dataset.print = "yes";
    for (const d of document.querySelectorAll("#scene details, details.worth, #words, .legend details")) if (!d.open) { d.open = true; opened.push(d); }
    const back = pictured(), picture = new Image();
    stage.style.width = `${PAPER}px`; page.resized(); picture.className = "picture"; picture.src = stage.toDataURL(); picture.alt = $("state").textContent;
    stage.before(picture); stage.classList.add("screen");
    undo = () => { back(); picture.remove(); stage.style.width = ""; stage.classList.remove("screen"); page.resized(); };
  });
  addEventListener("afterprint", () => {
    delete root.dataset.print;
    for (const d of opened.splice(0)) d.open = false;
    if (undo) undo();
    undo = null;
  });
}

function player() {
  const scrub = $("scrub"), play = $("play"), end = clock.end, steps = 1000;
  const say = () => { play.textContent = clock.playing ? "Pause" : "Play"; play.setAttribute("aria-pressed", String(clock.playing)); };
  play.onclick = () => { clock.play(!clock.playing); say(); }; clock.stopped = [say];
  scrub.oninput = () => clock.set(end * scrub.value / steps);
  clock.heard.push(t => { scrub.value = end ? steps * t / end : 0; scrub.setAttribute("aria-valuetext", shown(t, "s")); $("now").textContent = `${t.toFixed(end < 1 ? 4 : 2)} s`; });
  const about = end / 16 || 1, rates = [.01, .02, .05, .1, .2, .5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const near = rates.reduce((a, b) => Math.abs(Math.log(b / about)) < Math.abs(Math.log(a / about)) ? b : a), k = rates.indexOf(near);
  const offered = [...new Set([...rates.slice(Math.max(k - 3, 0), k + 4), 1])].sort((a, b) => a - b);
  options($("speed"), offered.map(r => [r, r === 1 ? "as it is" : `${r} times`]), near); clock.rate = near;
  $("speed").onchange = () => { clock.rate = Number($("speed").value); };
  document.addEventListener("keydown", e => {
    if (/INPUT|SELECT|BUTTON|TEXTAREA|SUMMARY/.test(e.target.tagName) || e.ctrlKey || e.metaKey || e.altKey) return;
    if (e.target !== $("stage") && e.key !== "k") return;
    if (e.key === " " || e.key === "k") { e.preventDefault(); play.click(); }
    if (e.key === "ArrowRight" || e.key === "ArrowLeft") { e.preventDefault(); clock.set(clock.t + (e.key === "ArrowRight" ? 1 : -1) * end / 200); }
    if (e.key === "Home" || e.key === "End") { e.preventDefault(); clock.set(e.key === "Home" ? 0 : end); }
  });
}

async function stage(run) {
  const line = run.lines[0], canvas = $("stage"), view = line ? new RouteView(run, line, canvas) : new MechanismView(run, canvas);
  canvas.className = line ? "" : view.m.boxes.length > 8 ? "mechanism tall" : "mechanism"; await view.begin(); page.view = view;
  if (line) {
    $("by-label").hidden = !line.along.length; $("fit-label").hidden = !view.x;
    options($("by"), line.along.map(n => [n, `${n} [${run.family.get(n).unit}]`]), view.by);
    $("by").onchange = async () => { await view.colour($("by").value); tell(); };
    $("fit").onchange = () => { view.whole = $("fit").checked; view.fit(); view.resize(); view.back = null; view.draw(clock.t); };
  } else { $("by-label").hidden = $("fit-label").hidden = true; }
  const tell = () => { legend($("legend"), view.legend()); $("scale").textContent = view.scale() + (line && !view.x ? " The places of its nodes were not recorded, so the line is not drawn: run with --report." : ""); view.draw(clock.t); words(); };
  let spoken = 0;
  const words = () => { spoken = performance.now(); $("state").textContent = `At ${shown(clock.t, "s")}: ${view.words(clock.t) || "nothing was recorded that a picture could show"}.`; };
  page.draw = t => { view.draw(t); if (performance.now() - spoken > (clock.playing ? 400 : 60)) words(); else { clearTimeout(page.soon); page.soon = setTimeout(words, 120); } };
  page.resized = () => { view.resize(); view.back = null; view.draw(clock.t); };
  page.resized(); tell();
}

function signals(runs) {
  const list = $("panels"), all = [...new Set(runs.flatMap(r => [...r.family.keys()]))];
  options($("names"), all.map(n => [n, ""]));
  const first = runs[0].panels.filter(p => p.families.length);
  page.panels = [];
  const add = async (title, families, top) => { const p = new Panel(runs, title, families); page.panels.push(p); await p.show(list); if (top) list.prepend(p.box); return p; };
  whenSeen($("signals"), async () => { for (const p of first) await add(p.title, p.families); });
  $("add").onclick = async () => {
    const wanted = $("pick").value.trim(), found = all.filter(n => n === wanted), some = found.length ? found : all.filter(n => wanted && n.includes(wanted)).slice(0, 1);
    if (some.length) { await add(some[0], some, true); $("pick").value = ""; }
  };
  $("pick").onkeydown = e => { if (e.key === "Enter") $("add").click(); };
  $("whole").onclick = () => span.whole();
  const line = runs[0].lines[0];
  if (line && line.along.length) {
    $("profile-box").hidden = false; const profile = new Profile(runs, line);
    options($("profile-of"), line.along.map(n => [n, n]), line.along[0]);
    whenSeen($("profile-box"), () => profile.show($("profile-of").value));
    $("profile-of").onchange = () => profile.show($("profile-of").value);
    clock.heard.push(t => profile.draw(t));
  }
}

/* A choice of one of several runs for a section; nothing to choose where there is one. */
function ofRun(runs, id, make) {
  const list = $(id);
  list.parentElement.hidden = runs.length < 2;
  options(list, runs.map((r, k) => [k, r.label]), 0);
  list.onchange = () => make(runs[list.value], true);
  make(runs[0], false);
}
function zones(runs) {
  ofRun(runs, "zone-run", (run, now) => {
    const chart = new ZoneChart(run), choices = chart.choices(), before = $("zone-of").selectedOptions[0]?.textContent;
    $("zone-of").parentElement.hidden = !choices.length;
    if (!choices.length) { $("zone-note").textContent = "Nothing in this scene has zones."; $("zone-chart").replaceChildren(); $("zone-legend").replaceChildren(); return; }
    options($("zone-of"), choices.map(([text], k) => [k, text]), Math.max(0, choices.findIndex(([text]) => text === before)));
    const draw = () => chart.show(...choices[$("zone-of").value].slice(1));
    $("zone-of").onchange = draw;
    if (now) draw(); else whenSeen($("zones"), draw);
  });
}

function maps(runs) {
  const with_maps = runs.filter(run => mapped(run).length);
  $("maps").hidden = !with_maps.length;
  if (!with_maps.length) return;
  ofRun(with_maps, "map-run", (run, now) => {
    const draw = async gently => { const made = document.createElement("div"); $("map-list").replaceChildren(made); for (const name of mapped(run)) { await map(run, run.lines[0], name, made); if (gently) await idle(); } };
    if (now) draw(false); else whenSeen($("maps"), () => draw(true));
  });
}
function mapped(run) {
  const line = run.lines[0];
  return line ? line.along.filter(n => /\.(tension|torque|d|slip|angle|turned)$/.test(n) && run.family.get(n).elements.length > 3).slice(0, 5) : [];
}

async function begin() {
  page.runs = DATA.runs.map(d => new Run(d));
  for (const run of page.runs) await run.begin();
  const labels = page.runs.map(r => r.label.match(/^(.*) \((.*)\)$/)), alike = labels.every(m => m && m[1] === labels[0][1]);
  page.runs.forEach((r, k) => { r.short = alike ? labels[k][2] : r.label; });
  clock.end = Math.max(...page.runs.map(r => r.end)); span.begin(clock.end);
  const readable = page.runs.filter(r => r.rows > 0);
  if (!readable.length) { $("state").textContent = "No row of signals was recorded."; for (const id of ["signals", "zones", "maps"]) $(id).hidden = true; $("stage").hidden = true; return; }
  player();
  if (readable.length > 1) { $("run-label").hidden = false; options($("which"), readable.map((r, k) => [k, r.label]), 0); $("which").onchange = () => stage(readable[$("which").value]); }
  await stage(readable[0]);
  clock.heard.push(t => page.draw(t));
  let later; new ResizeObserver(() => { clearTimeout(later); later = setTimeout(() => page.resized(), 80); }).observe($("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!document.documentElement.dataset.print) location.reload(); });
  signals(readable); zones(readable); maps(readable); links();
  printing();
  const ruck = readable[0].rucks[0]; clock.set(ruck ? ruck.t : clock.end * .4);
  document.body.dataset.ready = "yes"; setTimeout(drawRest, 1500);
}
begin().catch(error => { $("state").textContent = `The moving picture could not be made: ${error.message}`; throw error; });
