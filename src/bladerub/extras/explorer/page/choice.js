// What is shown: two coatings, a speed and the displays; kept in the address, so that a link restores it.

const SIDES = ["A", "B"];
// Those of all coatings: a casing may have its own.
const PEAK_ORDERS = [...new Set(study.coatings.flatMap(({ peaks }) => peaks.map(({ order }) => order)))].sort((a, b) => a - b);

function nearest(values, wanted) {
  return values.reduce((best, value, i) => (Math.abs(value - wanted) < Math.abs(values[best] - wanted) ? i : best), 0);
}

// The coating that vibrates most, at the speed of its first peak; the next one to compare it with.
function firstChoice() {
  const height = ({ rigid, peaks }) => (rigid ? 0 : (peaks[0].Y ?? 0));
  const heights = study.coatings.map(height);
  const A = heights.indexOf(Math.max(...heights));
  return {
    A,
    B: (A + 1) % study.coatings.length,
    compare: false,
    side: "A", // that a cell of the tables over the moduli chooses, and whose relatives they show
    speed: speedOfPeak(A),
    axis: "frequency",
    order: study.coatings[A].peaks[0].order,
    sameScale: true,
  };
}

function speedOfPeak(index) {
  return nearest(study.f_omega, study.coatings[index].peaks[0].f);
}

function toHash(choice) {
  const link = new URLSearchParams();
  link.set("A", study.coatings[choice.A].name);
  if (choice.compare) {
    link.set("B", study.coatings[choice.B].name);
    link.set("cells", choice.side);
  }
  link.set("f", study.f_omega[choice.speed]);
  link.set("spectra", choice.axis);
  link.set("peaks", choice.order);
  if (!choice.sameScale) link.set("scale", "own");
  return `#${link}`;
}

// The choice that a link stands for, and what in it is not of this study.
function fromHash(hash) {
  const link = new URLSearchParams(hash.slice(1));
  const choice = firstChoice();
  const errors = [];
  for (const side of SIDES) {
    if (!link.has(side)) continue;
    const index = study.coatings.findIndex(({ name }) => name === link.get(side));
    if (index < 0) errors.push(`coating "${link.get(side)}" is not in this study`);
    else choice[side] = index;
    choice.compare ||= side === "B" && index >= 0;
  }
  if (link.has("f")) {
    const wanted = Number(link.get("f"));
    if (link.get("f") === "" || Number.isNaN(wanted)) errors.push(`f "${link.get("f")}" is not a speed`);
    else choice.speed = nearest(study.f_omega, wanted);
  } else choice.speed = speedOfPeak(choice.A);
  for (const [key, name, allowed] of [
    ["spectra", "axis", ["frequency", "order"]],
    ["peaks", "order", PEAK_ORDERS],
    ["cells", "side", choice.compare ? SIDES : ["A"]],
  ]) {
    if (!link.has(key)) continue;
    const value = allowed.find((each) => String(each) === link.get(key));
    if (value !== undefined) choice[name] = value;
    else errors.push(`${key} "${link.get(key)}" is not ${allowed.join(" or ")}`);
  }
  choice.sameScale = link.get("scale") !== "own";
  return { choice, errors };
}

// Properties in the order in which they are chosen; each offers what the study has with those before it.
const PROPERTIES = ["casing", "E", "K", "angle", "variant"];

function property(coating, name) {
  if (name === "angle") {
    if (coating.rigid) return coating.friction;
    return coating.law === "coulomb" ? `μ = ${Number(coating.friction.toPrecision(6))}` : coating.theta;
  }
  if (name === "variant") return coating.variant || "none";
  return coating[name] === null ? "rigid" : coating[name];
}

function fitting(coating, names) {
  return study.coatings.filter((other) => names.every((name) => property(other, name) === property(coating, name)));
}

// The coating with another value of one property, all others as near as the study has them.
function changed(index, name, value) {
  const now = study.coatings[index];
  const before = PROPERTIES.slice(0, PROPERTIES.indexOf(name));
  let candidates = fitting(now, before).filter((other) => String(property(other, name)) === value);
  for (const after of PROPERTIES.slice(PROPERTIES.indexOf(name) + 1)) {
    const distances = candidates.map((other) => distance(property(other, after), property(now, after)));
    const least = Math.min(...distances);
    candidates = candidates.filter((_, i) => distances[i] === least);
  }
  return study.coatings.indexOf(candidates[0]);
}

function distance(a, b) {
  if (a === b) return 0;
  return typeof a === "number" && typeof b === "number" ? Math.abs(a - b) : 1e9;
}
