"use strict";
(() => {
  const get = id => document.getElementById(id);
  const text = get("text"), lines = get("lines"), offers = get("offers"), messages = get("messages"), status = get("status");
  const base = location.pathname;
  let saved = text.value, marks = new Map(), shown = 0, begin = 0, chosen = 0, wait = 0, asked = 0;

  const post = async (what, more = {}) => {
    const answer = await fetch(base + what, { method: "POST", headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ text: text.value, ...more }) });
    return answer.json();
  };
  const say = (words, bad = false) => { status.textContent = words; status.className = bad ? "bad" : ""; };
  const lost = () => say("fairlead view does not answer any more. Copy your text before you close this page.", true);

  // --- line numbers, marked where a message stands
  const number = () => {
    const count = text.value.split("\n").length;
    lines.replaceChildren(...Array.from({ length: count }, (_, k) => {
      const one = document.createElement("div");
      one.textContent = k + 1;
      if (marks.has(k + 1)) one.className = marks.get(k + 1);
      return one;
    }));
    lines.scrollTop = text.scrollTop;
  };
  const goTo = (line, column) => {
    const before = text.value.split("\n").slice(0, line - 1).join("\n");
    const at = Math.min((line > 1 ? before.length + 1 : 0) + Math.max(column - 1, 0), text.value.length);
    text.focus();
    text.setSelectionRange(at, at);
    text.scrollTop = Math.max(0, (line - 6) * 20);
  };

  // --- messages
  const tell = answer => {
    marks = new Map();
    const made = [];
    for (const [mood, list] of [["bad", answer.faults], ["fair", answer.warnings || []]]) for (const one of list) {
      if (one.here && one.line && !marks.has(one.line)) marks.set(one.line, mood);
      const item = document.createElement("li"), button = document.createElement("button");
      item.className = mood;
      button.type = "button";
      button.textContent = (mood === "fair" ? "warning: " : "") + one.said;
      if (one.here && one.line) button.addEventListener("click", () => goTo(one.line, one.column));
      item.append(button);
      made.push(item);
    }
    if (!answer.faults.length) {
      const item = document.createElement("li");
      item.className = "good";
      item.textContent = "No mistakes found.";
      made.unshift(item);
    }
    messages.replaceChildren(...made);
    number();
  };
  const check = async () => {
    const mine = ++asked;
    document.body.dataset.checked = "";
    try {
      const answer = await post("check");
      if (mine !== asked || answer.newer) return;
      tell(answer);
      document.body.dataset.checked = "yes";
    } catch { lost(); }
  };

  // --- offers
  const close = () => { offers.hidden = true; text.removeAttribute("aria-activedescendant"); };
  const choose = k => {
    const all = [...offers.children];
    chosen = (k + all.length) % all.length;
    all.forEach((one, j) => one.setAttribute("aria-selected", String(j === chosen)));
    text.setAttribute("aria-activedescendant", all[chosen].id);
    all[chosen].scrollIntoView({ block: "nearest" });
  };
  const take = k => {
    const word = offers.children[k].dataset.text;
    text.setRangeText(word, begin, text.selectionStart, "end");
    close();
    text.focus();
    changed();
  };
  const place = () => {  // below the line of the cursor, or above it where there is more room
    const before = text.value.slice(0, begin), row = before.split("\n").length, column = before.length - before.lastIndexOf("\n") - 1;
    const top = row * 20 + 6 - text.scrollTop, left = lines.offsetWidth + 8 + column * 7.8 - text.scrollLeft;
    const room = text.clientHeight - top, above = room < 150 && top > text.clientHeight / 2;
    offers.style.setProperty("top", above ? "auto" : `${Math.max(0, top)}px`);
    offers.style.setProperty("bottom", above ? `${get("pane").clientHeight - top + 20}px` : "auto");
    offers.style.setProperty("left", `${Math.max(8, Math.min(left, text.clientWidth - 160))}px`);
  };
  const offer = async () => {
    const mine = ++shown, cursor = text.selectionStart;
    let answer;
    try { answer = await post("complete", { cursor: [...text.value.slice(0, cursor)].length }); } catch { return lost(); }
    if (mine !== shown || text.selectionStart !== cursor) return;
    const typed = [...text.value.slice(0, cursor)].slice(answer.begin).join("");
    begin = cursor - typed.length;
    const items = answer.items.filter(one => one.text.trim() !== typed.trim());
    if (!items.length) return close();
    offers.replaceChildren(...items.map((one, k) => {
      const item = document.createElement("li"), word = document.createElement("b"), about = document.createElement("span");
      item.id = `offer-${k}`;
      item.setAttribute("role", "option");
      item.dataset.text = one.text;
      word.textContent = one.text;
      about.textContent = one.about;
      item.append(word, about);
      item.addEventListener("mousedown", event => { event.preventDefault(); take(k); });
      return item;
    }));
    offers.hidden = false;
    place();
    choose(0);
  };

  // --- typing
  const changed = () => {
    number();
    document.title = (text.value === saved ? "" : "* ") + document.querySelector("h1").textContent;
    clearTimeout(wait);
    document.body.dataset.checked = "";
    wait = setTimeout(check, 300);
  };
  text.addEventListener("input", event => {
    changed();
    if (!offers.hidden || (event.inputType === "insertText" && /[\w. ]/.test(event.data || ""))) offer(); else close();
  });
  text.addEventListener("scroll", () => { lines.scrollTop = text.scrollTop; close(); });
  text.addEventListener("blur", () => setTimeout(close, 150));
  text.addEventListener("keydown", event => {
    if (event.key === " " && event.ctrlKey) { event.preventDefault(); offer(); return; }
    if (offers.hidden) return;
    if (event.key === "ArrowDown") choose(chosen + 1);
    else if (event.key === "ArrowUp") choose(chosen - 1);
    else if (event.key === "Enter" && !event.ctrlKey) take(chosen);
    else if (event.key === "Escape") close();
    else { if (["ArrowLeft", "ArrowRight", "Home", "End", "Tab"].includes(event.key)) close(); return; }
    event.preventDefault();
  });

  // --- run, stop, save
  const going = on => { get("run").disabled = on; get("stop").disabled = !on; get("progress").hidden = !on; };
  const follow = async () => {
    let now;
    try { now = await (await fetch(base + "state")).json(); } catch { going(false); return lost(); }
    if (now.state === "running") {
      get("progress").value = now.fraction;
      say(now.stopping ? "stopping" : `running, t = ${now.t.toPrecision(4)} s`);
      return setTimeout(follow, 200);
    }
    going(false);
    if (now.page) {
      const page = get("page");
      page.src = `${base}report/${now.number}`;
      page.hidden = false;
      get("empty").hidden = true;
      if (matchMedia("(max-width: 860px)").matches) page.scrollIntoView();
      get("keep").disabled = false;
      say(`${now.status}. ${now.sentence}`, now.status !== "finished");
    } else {
      if (now.faults.some(one => one.here)) tell(now);
      say(now.faults.length ? now.faults[0].said : "", true);
    }
    document.body.dataset.run = String(now.number);
  };
  const run = async () => {
    if (get("run").disabled) return;
    going(true);
    say("starting");
    try { await post("run"); } catch { going(false); return lost(); }
    follow();
  };
  const once = what => async () => {
    const held = text.value;
    let answer;
    try { answer = await post(what); } catch { return lost(); }
    if (answer.refused) return say(answer.refused, true);
    if (what === "save") { saved = held; changed(); }
    say(answer.saved || "");
  };
  const save = once("save");
  get("run").addEventListener("click", run);
  get("stop").addEventListener("click", () => post("stop").catch(lost));
  get("save").addEventListener("click", save);
  get("keep").addEventListener("click", once("keep"));
  document.addEventListener("keydown", event => {
    if (!event.ctrlKey && !event.metaKey) return;
    if (event.key === "Enter") { event.preventDefault(); close(); run(); }
    else if (event.key === "s") { event.preventDefault(); if (!get("save").disabled) save(); }
  });
  window.addEventListener("beforeunload", event => { if (text.value !== saved) event.preventDefault(); });

  number();
  check();
  document.body.dataset.ready = "yes";
})();
