/* Legends: a swatch looks like what it stands for, a curve with its dash, an upright line, a mark, or a patch of colour. */
/* Dashes that differ also when they are shifted along the curve; lengths in px, drawn alike in plot and legend. */
const DASHES = ["solid", "9 4", "2 3", "11 3 2 3", "20 5", "2 8", "11 3 2 3 2 3", "5 9"];
const ROLE_DASHES = {first: DASHES[0], lowest: DASHES[1], middle: DASHES[2], highest: DASHES[3], last: DASHES[4], picked: DASHES[5]};

function chip(swatch) {
  if (typeof swatch === "string") { const patch = document.createElement("i"); patch.style.background = swatch; return patch; }
  const make = (name, about, inside) => { const e = document.createElementNS("http://www.w3.org/2000/svg", name); for (const [k, v] of Object.entries(about)) e.setAttribute(k, v); inside?.append(e); return e; };
  const {colour, dash = "solid", upright, shape} = swatch, wide = upright || shape ? 16 : 52, svg = make("svg", {class: "swatch", width: wide, height: 12, "aria-hidden": "true"});
  const line = {stroke: colour, "stroke-width": 2, fill: "none", "stroke-dasharray": dash === "solid" ? "none" : dash};
  if (shape === "square") make("rect", {x: 4, y: 2, width: 8, height: 8, fill: colour}, svg);
  else if (shape === "right" || shape === "left") make("path", {d: shape === "right" ? "M3 1 L14 6 L3 11 Z" : "M13 1 L2 6 L13 11 Z", fill: colour}, svg);
  else if (shape === "zigzag") make("path", {...line, d: "M1 10 L4 2 L8 10 L12 2 L15 10"}, svg);
  else if (shape === "dots") make("path", {...line, d: "M1 6 H16", "stroke-dasharray": "2 3"}, svg);
  else make("path", {...line, d: upright ? "M8 0 V12" : `M0 6 H${wide}`}, svg);
  return svg;
}
const dashed = (colour, dash) => ({colour, dash}), upright = (colour, dash) => ({colour, dash, upright: true});
const NOW = () => [upright(css("ink"), "solid"), "time of the picture"];

function legend(list, entries) {
  list.replaceChildren(...entries.map(([swatch, text]) => { const item = document.createElement("li"); item.append(chip(swatch), text); return item; }));
}
/* What a legend does not show at first. */
function rest(text, items) {
  const more = document.createElement("details"), head = document.createElement("summary"); head.textContent = text; more.append(head, ...items);
  return more;
}
