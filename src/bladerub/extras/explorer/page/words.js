// What is written around the pictures: the numbers of the run, the peaks over the moduli, titles and notes. Names and
// values from the study go into the page as text, never as markup.

const page = (selector) => document.querySelector(selector);

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (typeof value === "boolean") made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

function digits(value, n = 4) {
  return value === null ? "none" : String(Number(value.toPrecision(n)));
}

function millimetres(value) {
  return value === null ? "none" : `${digits(value)} mm`;
}

function percent(value) {
  return digits(100 * value, 3).replace("-", "−");
}

// The band over the starts of an ensemble, in which a further start falls with 90 %; nothing without an ensemble.
function band(low, high, draws, write) {
  if (low === null) return "";
  return write(low) === write(high) ? `; the same from ${draws} starts` : `; 5–95 % band of ${draws} starts: ${write(low)} to ${write(high)}`;
}

function verdictInWords(coating, speed) {
  const kind = verdict(coating.runs, speed);
  const words = element("span", { class: `verdict ${kind}` }, `${VERDICTS[kind].sign} ${VERDICTS[kind].words}`);
  const longer = wasRepeated(coating, speed) ? " of the longer run" : "";
  const { draws, divergent_draws: share } = coating.runs;
  const starts = share[speed] === null ? "" : `; ${digits(draws[speed] * share[speed])} of ${draws[speed]} starts diverge`;
  if (kind === "unbounded") return [words, ` in revolution ${coating.runs.revolutions[speed]}${longer}${starts}`];
  return [words, `${wasRepeated(coating, speed) ? ` within ${coating.runs.revolutions[speed]} revolutions (longer run)` : ""}${starts}`];
}

function growthInWords({ runs }, speed) {
  const [rate, low, high] = ["growth_per_revolution", "growth_low", "growth_high"].map((name) => runs[name][speed]);
  if (rate === null) return "not measurable";
  const interval = low === null ? "" : ` (${percent(low)} to ${percent(high)} %)`;
  const over = band(runs.growth_rate_low[speed], runs.growth_rate_high[speed], runs.draws[speed], (value) => `${percent(value)} %`);
  return `${percent(rate)} %${interval}, at the end of ${runs.revolutions[speed]} revolutions${over}`;
}

function repeat(coating, speed) {
  const line = element("code", {}, `${coating.command} --f ${study.f_omega[speed]}`);
  if (!wasRepeated(coating, speed)) return [line];
  const longer = `--revolutions ${coating.growth[speed].longer.length}`;
  return [line, element("br"), "the longer run: add ", element("code", {}, longer)];
}

function peakRow(at, order, goTo) {
  const found = at.peaks.find((peak) => peak.order === order);
  if (!found) return ["none"];
  if (found.f === null) return [`none: ${found.reason}`];
  const label = `Show the speed ${found.f}, where order ${order} peaks`;
  return [
    `${millimetres(found.Y)} at `,
    element("button", { type: "button", "aria-label": label, onclick: () => goTo(nearest(study.f_omega, found.f)) }, `f${order} = ${found.f}`),
    band(found.low, found.high, found.draws, millimetres),
  ];
}

function lobesOfStarts({ lobes_lowest: low, lobes_highest: high, draws }, speed) {
  return low[speed] === null ? "" : `; ${low[speed] === high[speed] ? "the same" : `${low[speed]} to ${high[speed]}`} from ${draws[speed]} starts`;
}

function showRun(shown, choice, goTo) {
  const { speed } = choice;
  const own = shown[0].coating.growth[speed].own.length;
  const last = `revolutions ${own - study.spectrum_revolutions + 1} to ${own}`;
  const rows = [
    ["Vibration", (at) => verdictInWords(at, speed)],
    ["Growth per revolution", (at) => [growthInWords(at, speed)]],
    [`Peak displacement of node 1, radial, ${last}`, (at) => [millimetres(at.runs.peak[speed])]],
    [
      "Largest spectral amplitude, same revolutions",
      ({ runs }) => {
        if (runs.order_amplitude[speed] === null) return ["none: the run ended too early"];
        return [`${millimetres(runs.order_amplitude[speed])} at engine order ${digits(runs.order[speed])}`];
      },
    ],
    [`Worn lobes after ${own} revolutions`, ({ runs }) => [`${runs.lobes[speed]}${lobesOfStarts(runs, speed)}`]],
    [`Greatest wear after ${own} revolutions, any node`, ({ runs }) => [millimetres(runs.max_wear[speed]), band(runs.max_wear_low[speed], runs.max_wear_high[speed], runs.draws[speed], millimetres)]],
    ...PEAK_ORDERS.map((order) => [`Peak Y${order} of the coating`, (at) => peakRow(at, order, goTo)]),
    ["Key of the run", (at) => [element("code", {}, at.runs.run_key[speed])]],
    ["Repeat it by", (at) => repeat(at, speed)],
  ];
  const heads = shown.map(({ side, coating }) =>
    element("th", { scope: "col" }, element("span", { class: `badge ${side}` }, side), ` ${coating.title}`),
  );
  page("#run-title").replaceChildren("The run at ", element("i", {}, "f"), element("sub", {}, "Ω"), ` = ${speedInWords(speed)}`);
  page("#figures thead").replaceChildren(element("tr", {}, element("td"), ...heads));
  page("#figures tbody").replaceChildren(
    ...rows.map(([name, cell]) =>
      element("tr", {}, element("th", { scope: "row" }, name), ...shown.map(({ coating }) => element("td", {}, ...cell(coating)))),
    ),
  );
}

const ascending = (values) => [...new Set(values)].sort((a, b) => a - b);

// The abradable coatings to be compared over E and K with the one at `index`: same casing and angle.
function family(index) {
  const { casing, rigid, theta, law, variant } = study.coatings[index];
  const abradable = study.coatings.filter((each) => each.casing === casing && each.variant === variant && !each.rigid);
  const angle = rigid ? Math.min(...abradable.map((each) => each.theta)) : theta;
  const alike = abradable.filter((each) => each.theta === angle);
  const wanted = rigid ? alike[0]?.law : law;
  return {
    angle,
    members: alike.filter((each) => each.law === wanted),
    E: ascending(abradable.map((each) => each.E)),
    K: ascending(abradable.map((each) => each.K)),
  };
}

const QUANTITIES = {
  Y: { of: ({ Y }) => Y, unit: "mm", decimals: 2, floor: () => 0 },
  f: { of: ({ f }) => f, unit: "normalised", decimals: 3, floor: (values) => Math.min(...values) - 0.01 },
};

function showModuli(choice, choose) {
  const kin = family(choice[choice.side]);
  kin.members = kin.members.filter(({ peaks }) => peaks.some(({ order }) => order === choice.order));
  const { casing, name } = study.coatings[choice[choice.side]];
  page("#moduli-seen").textContent = kin.members.length
    ? `Height Y${choice.order} (mm) and speed f${choice.order} (normalised) of the peak where engine order ${choice.order} meets C₁, ` +
      `casing ${casing}, θ = ${kin.angle}. Darker is lower; a cell chooses its coating.`
    : `The study has no abradable coating on casing ${casing} with a peak on engine order ${choice.order}.`;
  const held = document.activeElement.dataset?.coating;
  const heldIn = held && document.activeElement.closest("table").id;
  const tables = Object.entries(QUANTITIES).map(([letter, quantity]) => moduliTable(letter, quantity, kin, choice, choose));
  page("#moduli-grid").replaceChildren(...(kin.members.length ? tables : []));
  for (const table of tables) {
    const cells = [...table.querySelectorAll("[data-coating]")];
    const wanted = heldIn === table.id ? held : name;
    const reached = cells.find((cell) => cell.dataset.coating === wanted) ?? cells[0];
    reached?.setAttribute("tabindex", "0");
    if (heldIn === table.id) reached?.focus();
  }
}

function moduliTable(letter, { of, unit, decimals, floor }, kin, choice, choose) {
  const name = `${letter}${choice.order}`;
  const value = (coating) => of(coating.peaks.find(({ order }) => order === choice.order));
  const values = kin.members.map(value).filter((each) => each !== null);
  const words = (coating) => (value(coating) === null ? "no peak" : `${digits(value(coating))} ${unit}`);
  const [low, high] = [floor(values), Math.max(...values)];
  const cell = (E, K) => {
    const coating = kin.members.find((each) => each.E === E && each.K === K);
    if (!coating) return element("td", {}, element("button", { type: "button", disabled: true, "aria-label": `E ${E}, K ${K}: not in the study` }, "–"));
    const index = study.coatings.indexOf(coating);
    const missing = value(coating) === null;
    const share = high > low ? (value(coating) - low) / (high - low) : 1;
    const marks = (choice.compare ? SIDES : ["A"]).filter((each) => choice[each] === index);
    const button = element(
      "button",
      {
        type: "button",
        tabindex: "-1",
        "data-coating": coating.name,
        "aria-label": `E ${E}, K ${K}: ${name} ${words(coating)}${marks.map((mark) => `, coating ${mark}`).join("")}`,
        title: `${coating.title}: ${name} = ${words(coating)}`,
        style: missing
          ? `background: ${LOOK.missing}; color: black`
          : `background: ${LOOK.height[Math.round(share * (LOOK.height.length - 1))]}; color: ${share < 0.6 ? "white" : "black"}`,
        onclick: () => choose(index),
      },
      ...marks.map((mark) => element("span", { class: `badge ${mark}` }, mark)),
      missing ? "–" : value(coating).toFixed(decimals),
    );
    return element("td", { class: marks.join(" ") }, button);
  };
  const head = (text, scope = "row") => element("th", { scope }, text);
  const rows = kin.K.toReversed().map((K) => element("tr", {}, head(`${K}`, "row"), ...kin.E.map((E) => cell(E, K))));
  const foot = element("tr", {}, head("K↑ E→"), ...kin.E.map((E) => head(`${E}`, "col")));
  const caption = element("caption", {}, `${name} (${unit})`);
  const table = element("table", { id: `moduli-${letter}`, style: `max-width: ${90 * (kin.E.length + 1)}px` }, caption, element("tbody", {}, ...rows, foot));
  table.addEventListener("keydown", walkTable);
  return table;
}

// Arrow keys go from cell to cell of a table; the tab key reaches one of its cells.
function walkTable(event) {
  const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
  const step = steps[event.key];
  if (!step) return;
  event.preventDefault();
  event.stopPropagation();
  const rows = [...event.currentTarget.querySelectorAll("tr")];
  const [cell, row] = [event.target.closest("td"), event.target.closest("tr")];
  let [i, j] = [rows.indexOf(row), [...row.children].indexOf(cell)];
  for (;;) {
    [i, j] = [i + step[0], j + step[1]];
    if (!rows[i]?.children[j]) return;
    const next = rows[i].children[j].querySelector("[data-coating]");
    if (next) {
      event.currentTarget.querySelector('[tabindex="0"]').setAttribute("tabindex", "-1");
      next.setAttribute("tabindex", "0");
      next.focus();
      return;
    }
  }
}

function showTitles(shown) {
  for (const { side, coating } of shown) {
    for (const [picture, name] of Object.entries({ wear: "Wear", spectrum: "Spectrum" })) {
      const badge = element("span", { class: `badge ${side}` }, side);
      page(`#${picture}-${side}-title`).replaceChildren(`${name}: `, badge, ` ${coating.title}`);
    }
  }
}

// What the pictures show, in words, for those who do not see them.
function describe(shown, choice) {
  const f = study.f_omega[choice.speed];
  const whole = (picture, words) => page(picture).setAttribute("aria-label", words);
  for (const { side, coating } of shown) {
    whole(`#wear-${side}`, `Map of worn depth over speed and casing angle, ${coating.title}; deepest ${digits(coating.deepest, 2)} mm in the mean of the nodes; speed ${f} marked`);
    whole(`#spectrum-${side}`, `Map of amplitude over speed and ${choice.axis}, ${coating.title}; speed ${f} marked`);
  }
  const each = (words) => shown.map(({ side, coating }) => `${side}, ${coating.title}: ${words(coating)}`).join("; ");
  whole("#polar", `Worn depth around the casing at speed ${f}. ${each(({ runs }) => `${runs.lobes[choice.speed]} lobes`)}`);
  whole("#line", `Spectrum at speed ${f}. ${each(({ runs }) => `strongest at engine order ${digits(runs.order[choice.speed])}`)}`);
  whole("#growth", `Amplitude of each revolution at speed ${f}. ${each((coating) => growthInWords(coating, choice.speed))}`);
  page("#growth-seen").textContent =
    "Half the range of the radial displacement of node 1 in each revolution of the run (markers) and of its longer " +
    `repetition (line), if it grew. Red: the growth found over the last ${study.growth_revolutions}.`;
}

// A speed as the study has it, and as an engine has it.
function speedInWords(speed) {
  const hz = study.f_omega[speed] * study.f1_hz;
  return `${study.f_omega[speed]}, ${(60 * hz).toFixed(0)} rpm, ${hz.toFixed(1)} Hz`;
}

function showUnits() {
  page("#f1").textContent = `, ${study.f1_hz.toFixed(2)} Hz`;
  for (const place of document.querySelectorAll(".unit")) place.textContent = ` E, K in ${digits(study.modulus_unit / 1e6)} MPa`;
}

function showThinned() {
  const stretches = study.angle_edges.length - 1;
  page("#doubts").textContent = study.doubts.map((doubt) => `Blade: ${doubt}.`).join(" ");
  page("#thinned").textContent =
    `Pictures of wear show the mean of the 8 nodes, averaged over ${stretches} stretches of the circumference, in steps of ` +
    "1/255 of the deepest of each run. Spectra are kept up to the frequency " +
    `${study.max_frequency} or engine order ${study.last_order}, whichever is higher, from ${study.amplitude_floor} mm up, to about 3 %; amplitudes of revolutions to ` +
    "0.1 %. Values read from a picture therefore begin with ≈. Numbers in the tables above are those of the study, as computed. " +
    `Everything in full: results/maps and results/tables. Made by ${study.made_by}; drawn by plotly.js.`;
}
