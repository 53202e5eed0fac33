/* On paper: light colours, pictures of the plots, and what is folded open if it is for readers of paper; back again afterwards. */
function printing() {
  const opened = [], root = document.documentElement, stage = $("stage"); let undo = null;
  addEventListener("beforeprint", () => {
    if (undo) return;
    root.dataset.print = "yes";
    for (const d of document.querySelectorAll("#scene details, #settings details, details.worth, #words, .legend details")) if (!d.open) { d.open = true; opened.push(d); }
    const words = $("words"), before = words.parentNode; $("settings").after(words); // the glossary stands last on paper
    const back = pictured(), picture = new Image();
    stage.style.width = `${PAPER}px`; page.resized(); picture.className = "picture"; picture.src = stage.toDataURL(); picture.alt = $("state").textContent;
    stage.before(picture); stage.classList.add("screen");
    undo = () => { before.append(words); back(); picture.remove(); stage.style.width = ""; stage.classList.remove("screen"); page.resized(); };
  });
  addEventListener("afterprint", () => {
    delete root.dataset.print;
    for (const d of opened.splice(0)) d.open = false;
    if (undo) undo();
    undo = null;
  });
}
