/* Colours that the colour-blind can tell apart: Okabe and Ito (2008) for lines, viridis for values. */
const LINES = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#7b68c8", "#8a8a2a"];
const OWN = ["#d55e00", "#ddcc77", "#8a8a2a", "#b07aa1", "#9c755f", "#76b7b2", "#009e73", "#4e79a7"];
const VIRIDIS = [[68,1,84],[72,40,120],[62,74,137],[49,104,142],[38,130,142],[31,158,137],[53,183,121],[110,206,88],[181,222,43],[253,231,37]];

function ramp(share) {
  if (!Number.isFinite(share)) return [128, 128, 128];
  const x = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1), i = Math.min(Math.floor(x), VIRIDIS.length - 2), f = x - i;
  return VIRIDIS[i].map((c, k) => Math.round(c + f * (VIRIDIS[i + 1][k] - c)));
}
const css = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const hex = rgb => "#" + rgb.map(c => c.toString(16).padStart(2, "0")).join("");
const PALETTE = Array.from({length: 256}, (_, k) => hex(ramp(k / 255)));

/* The colour of a zone: by what it means, else one of its own, always the same for the same word. */
function zoneColour(run, zone) {
  const word = run.zones.words[zone];
  if (word.means) return css(word.means);
  if (word.own === undefined) {
    const unknown = run.zones.words.filter(w => !w.means);
    word.own = OWN[unknown.indexOf(word) % OWN.length];
  }
  return word.own;
}
