"use strict";
/* What the page knows: signals are unpacked a family at a time, when somebody looks at them. */
const DATA = JSON.parse(document.getElementById("data").textContent);
const NAN = 65535;

async function inflated(text) {
  const raw = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

class Run {
  constructor(data) {
    Object.assign(this, data);
    this.family = new Map(data.families.map(f => [f.name, f]));
    this.known = new Map();
  }
  async begin() {
    this.times = new Float64Array(await inflated(this.t));
    const whole = n => inflated(n);
    for (const z of this.zones.families) {
      const t = new Float64Array(await whole(z.t)), to = new Uint16Array(await whole(z.to));
      let at = 0;
      z.rows = z.elements.map((element, k) => {
        const from = at; at += z.counts[k];
        return {element, start: z.start[k], t: t.subarray(from, at), to: to.subarray(from, at),
          name: element < 0 ? z.name : z.name.replace("[*]", `[${element}]`)};
      });
    }
  }
  /* The values of a family: {first, low, high}, each a list of Float32Array by element. */
  async values(name) {
    if (!this.known.has(name)) this.known.set(name, this.unpack(this.family.get(name)));
    return this.known.get(name);
  }
  async unpack(f) {
    const bytes = new Uint8Array(await inflated(f.b)), n = bytes.length / 2, kinds = this.bucket > 1 ? 3 : 1;
    const rows = this.rows, out = [[], [], []];
    let at = 0;
    for (let k = 0; k < f.lo.length; k++) {
      let code = 0;
      for (let kind = 0; kind < kinds; kind++) {
        const values = new Float32Array(rows);
        for (let i = 0; i < rows; i++, at++) {
          code = (code + bytes[at] + 256 * bytes[n + at]) & 65535;
          values[i] = code === NAN ? NaN : f.lo[k] + code * f.st[k];
        }
        out[kind].push(values);
      }
    }
    return kinds === 3 ? {first: out[0], low: out[1], high: out[2]} : {first: out[0], low: out[0], high: out[0]};
  }
  /* The row that holds at time t: the last one that is not later, but for the rounding of a sum of time steps. */
  row(t) { return Math.max(upper(this.times, t + 1e-9 * Math.max(1, this.end)) - 1, 0); }
  /* A place between two rows: [row, share of the way to the next]. */
  between(t) {
    const i = this.row(t), j = Math.min(i + 1, this.rows - 1), span = this.times[j] - this.times[i];
    return [i, j, span > 0 ? Math.min(Math.max((t - this.times[i]) / span, 0), 1) : 0];
  }
}

/* How many numbers of a rising list are not above x. */
function upper(list, x) {
  let a = 0, b = list.length;
  while (a < b) { const m = (a + b) >> 1; if (list[m] <= x) a = m + 1; else b = m; }
  return a;
}

/* The zone of a row at time t. */
function zoneAt(row, t) { const k = upper(row.t, t); return k ? row.to[k - 1] : row.start; }

/* A curve with at most `most` points between two times, in which the lowest and the highest value of every stretch stay. */
function thinned(run, values, k, from, to, most) {
  const t = run.times, a = Math.max(upper(t, from) - 2, 0), b = Math.min(upper(t, to) + 1, run.rows);
  const n = b - a, size = Math.max(1, Math.ceil(2 * n / most)), x = [], y = [];
  const first = values.first[k], low = values.low[k], high = values.high[k], own = low === first;
  for (let i = a; i < b; i += size) {
    const end = Math.min(i + size, b);
    if (size === 1) {
      x.push(t[i]); y.push(first[i]);
      if (!own) { const next = i + 1 < run.rows ? t[i + 1] : t[i]; x.push((2 * t[i] + next) / 3, (t[i] + 2 * next) / 3); y.push(low[i], high[i]); }
      continue;
    }
    let lo = Infinity, hi = -Infinity, tl = t[i], th = t[i];
    for (let j = i; j < end; j++) {
      if (low[j] < lo) { lo = low[j]; tl = t[j]; }
      if (high[j] > hi) { hi = high[j]; th = t[j]; }
    }
    if (lo === Infinity) { x.push(t[i]); y.push(NaN); }
    else if (tl <= th) { x.push(tl, th); y.push(lo, hi); } else { x.push(th, tl); y.push(hi, lo); }
  }
  return {x, y};
}

// Large and small values get a prefix where their unit takes one: 18 MPa, 0.177 mrad.
const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"]];
const shown = (value, unit = "") => {
  if (!Number.isFinite(value)) return "no value";
  const size = Math.abs(value), behind = unit && unit !== "1" ? " " + unit : "", digits = one => `${+one.toPrecision(4)}`;
  if (size === 0 || (size >= 1e-3 && size < 1e5)) return digits(value) + behind;
  const [scale, prefix] = PREFIXES.find(([scale]) => size >= scale) || [0, ""];
  return scale && size < 1e12 && /^(Pa|N|W|J|Hz|m|s|V|A|rad)\b(?!\^)/.test(unit) ? `${digits(value / scale)} ${prefix}${unit}` : value.toExponential(2) + behind;
};
/* From when to when and how long, the ends with as many decimals as the length needs. */
const spell = (from, to) => {
  const long = to - from, decimals = long > 0 ? Math.min(Math.max(2 - Math.floor(Math.log10(long)), 0), 12) : 3, t = at => `${+at.toFixed(decimals)} s`;
  return `${t(from)} to ${t(to)}, ${shown(long, "s")} long`;
};
/* Round values of a colour bar, at most n steps apart. */
const ticks = (low, high, n = 8) => {
  const wide = high - low, raw = wide / n, ten = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(k => k * ten).find(one => one >= raw), found = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * wide; k++) found.push(Math.abs(k * step) < step / 2 ? 0 : k * step);
  return found;
};
/* Values side by side in one power of ten: [[value, text]], and the factor that stands with the unit. */
const scaled = (values, unit) => {
  const size = Math.max(...values.map(Math.abs), 0), power = size && (size < 1e-3 || size >= 1e5) ? 3 * Math.floor(Math.log10(size) / 3) : 0;
  const prefix = (PREFIXES.find(([scale]) => Math.abs(Math.log10(scale) - power) < .1) || [])[1], takes = /^(Pa|N|W|J|Hz|m|s|V|A|rad)\b(?!\^)/.test(unit) && prefix;
  const text = one => `${+(one / 10 ** power).toPrecision(4)}`;
  return {texts: values.map(one => [one, text(one)]), power, unit: !power ? unit : takes ? prefix + unit : `1e${power} ${unit}`};
};
