/* The section of signals: what is drawn first, and a field to add more. */
const MOST_OFFERED = 300, MOST_LISTED = 4;

/* What a typed name stands for: {families, only}, else {said}, a sentence why it is not drawn. */
function asked(runs, all, text) {
  if (!text) return {said: "Type the name of a signal, or a part of it."};
  if (all.includes(text)) return {families: [text]};
  const single = text.match(/^(.*)\[(\d+)\](.*)$/), family = single && `${single[1]}[*]${single[3]}`;
  if (family && all.includes(family)) {
    const only = Number(single[2]), has = [...new Set(runs.flatMap(r => r.family.get(family)?.elements ?? []))];
    return has.includes(only) ? {families: [family], only} : {said: `${family} has no element ${only}: those recorded go from ${Math.min(...has)} to ${Math.max(...has)}.`};
  }
  const within = all.filter(n => n.toLowerCase().includes(text.toLowerCase()));
  if (within.length === 1) return {families: within};
  if (within.length) return {said: `${within.length} names contain "${text}": ${within.slice(0, MOST_LISTED).join(", ")}${within.length > MOST_LISTED ? " and more" : ""}. Type more of the name.`};
  return {said: `No recorded signal has "${text}" in its name. The field offers the ${all.length} names there are; what is missing has to stand under record: in the netlist.`};
}
/* Names for the field: families, and the single elements of the one that is being typed. */
function offered(runs, all, text) {
  const begun = text.match(/^(.*\[)\d*\]?/);
  const elements = begun ? all.filter(n => n.startsWith(begun[1] + "*]")).flatMap(n => (runs.find(r => r.family.has(n)).family.get(n).elements).map(e => n.replace("[*]", `[${e}]`))) : [];
  return [...all, ...elements.slice(0, MOST_OFFERED)].map(n => [n, ""]);
}

function signals(runs) {
  const list = $("panels"), all = [...new Set(runs.flatMap(r => [...r.family.keys()]))], pick = $("pick");
  options($("names"), offered(runs, all, ""));
  const first = runs[0].panels.filter(p => p.families.length);
  page.panels = [];
  const add = async (title, families, {top = false, only = null} = {}) => { const p = new Panel(runs, title, families, only); page.panels.push(p); await p.show(list, top); return p; };
  whenSeen($("signals"), async () => { for (const p of first) await add(p.title, p.families); });
  const say = text => { $("picked").textContent = text; };
  $("add").onclick = async () => {
    const found = asked(runs, all, pick.value.trim());
    if (found.said) return say(found.said);
    const title = found.only === undefined ? found.families[0] : found.families[0].replace("[*]", `[${found.only}]`);
    say(`${title} is being drawn.`); pick.value = "";
    const panel = await add(title, found.families, {top: true, only: found.only ?? null});
    panel.box.scrollIntoView({block: "nearest"}); say(`${title} is the first plot below.`);
  };
  pick.oninput = () => { say(""); options($("names"), offered(runs, all, pick.value)); };
  pick.onkeydown = e => { if (e.key === "Enter") $("add").click(); };
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
