// The pictures, in the style of the figures of the paper: data and layout for plotly.js.

const LOOK = study.look;
const SPEED = "rotational frequency <i>f</i><sub>Ω</sub> / <i>f</i>₁(0)";
const FREQUENCY = "frequency <i>f</i> / <i>f</i>₁(0)";
const LAST_SPEED = study.speed_edges.at(-1);
const LINES = { A: { color: LOOK.A, width: 2 }, B: { color: LOOK.B, width: 2, dash: "dash" } };
const CONFIG = {
  displaylogo: false,
  responsive: true,
  modeBarButtons: [["toImage", "zoom2d", "pan2d", "resetScale2d"]],
};
const AXIS = { ticks: "outside", showline: true, linecolor: LOOK.dark, zeroline: false, showgrid: false, title: { standoff: 8 } };

function axis(title, more) {
  return { ...AXIS, ...more, title: { ...AXIS.title, ...more?.title, text: title } };
}

function layout(more) {
  return {
    font: { family: '"DejaVu Sans", Verdana, Arial, sans-serif', size: 12, color: LOOK.dark },
    margin: { l: 62, r: 14, t: 48, b: 48 },
    paper_bgcolor: "white",
    plot_bgcolor: "white",
    hovermode: "closest",
    showlegend: false,
    ...more,
  };
}

// Stretches of bins of equal width without a gap: plotly.js draws such maps many times faster than others.
const STRETCHES = (() => {
  const stretches = [];
  let width = null;
  study.speed_of_bin.forEach((speed, i) => {
    const own = study.speed_edges[i + 1] - study.speed_edges[i];
    if (speed === null) width = null;
    else if (width !== null && Math.abs(own - width) < 1e-3 * width) stretches.at(-1).speeds.push(speed);
    else {
      stretches.push({ first: i, speeds: [speed] });
      width = own;
    }
  });
  return stretches.map(({ first, speeds }) => ({ speeds, edges: study.speed_edges.slice(first, first + speeds.length + 1) }));
})();

// A map over the speeds: `row` gives what is coloured at each, `place` where a stretch goes.
function maps(row, place, more) {
  return STRETCHES.map(({ speeds, edges }) => ({
    type: "heatmap",
    ...place(edges),
    z: speeds.map(row),
    coloraxis: "coloraxis",
    hoverongaps: false,
    ...more(speeds),
  }));
}

function colourAxis(colours, [low, high], title, more) {
  const colorbar = { title: { text: title, side: "right" }, thickness: 13, outlinewidth: 0.5, ticks: "outside", ...more };
  return { cmin: low, cmax: high, colorscale: colours.map((colour, i) => [i / (colours.length - 1), colour]), colorbar };
}

// Two lines over each other, to be seen on light and dark.
function marker(line) {
  return [
    { ...line, type: "line", line: { color: "white", width: 4 } },
    { ...line, type: "line", line: { color: LOOK.dark, width: 1.6 } },
  ];
}

const VERDICTS = {
  steady: { words: "steady", sign: "●", symbol: "circle", color: LOOK.dark, size: 4 },
  saturating: { words: "saturating", sign: "○", symbol: "circle-open", color: LOOK.blue, size: 7 },
  divergent: { words: "divergent", sign: "▲", symbol: "triangle-up", color: LOOK.orange, size: 8 },
  unbounded: { words: "exceeded the limit", sign: "✕", symbol: "x-thin-open", color: LOOK.red, size: 6 },
};

function verdict(runs, speed) {
  if (runs.status[speed] !== "completed" || runs.verdict_status[speed] !== "completed") return "unbounded";
  if (runs.divergent[speed]) return "divergent";
  return runs.saturating[speed] ? "saturating" : "steady";
}

// Whether the run was repeated for longer, because its amplitude grew.
function wasRepeated(coating, speed) {
  return coating.growth[speed].longer.some((value) => value > 0);
}

const MISSING = { type: "rect", layer: "below", line: { width: 0 }, fillcolor: LOOK.missing };
// Speeds at which nothing was computed, from the lower end of the axis on.
const GAPS = [[0, study.speed_edges[0]]];
study.speed_of_bin.forEach((speed, i) => speed ?? GAPS.push([study.speed_edges[i], study.speed_edges[i + 1]]));

function wearShapes(speed) {
  const f = study.f_omega[speed];
  return [
    ...GAPS.map(([x0, x1]) => ({ ...MISSING, xref: "x", yref: "y domain", x0, x1, y0: 0, y1: 1 })),
    ...marker({ xref: "x", yref: "paper", x0: f, x1: f, y0: 0, y1: 1 }),
  ];
}

// As Fig. 6: worn depth over speed and casing angle, below it the worn lobes.
function wearMap(coating, speed, deepest) {
  const { runs } = coating;
  const map = maps((i) => coating.wear[i], (edges) => ({ x: edges, y: study.angle_edges }), () => ({
    transpose: true,
    hovertemplate: "<i>f</i><sub>Ω</sub> = %{x:.4~f}<br>%{y:.0f}°<br>≈ %{z:.2g} mm<extra></extra>",
  }));
  const lobes = Object.entries(VERDICTS).map(([kind, { words, symbol, color, size }]) => {
    const at = study.f_omega.map((_, i) => i).filter((i) => verdict(runs, i) === kind);
    return {
      type: "scatter",
      mode: "markers",
      name: words,
      x: at.map((i) => study.f_omega[i]),
      y: at.map((i) => runs.lobes[i]),
      yaxis: "y2",
      visible: at.length > 0,
      marker: { symbol, size, color, line: { color, width: 1.5 } },
      hovertemplate: "<i>f</i><sub>Ω</sub> = %{x}<br>%{y} lobes<extra>%{fullData.name}</extra>",
    };
  });
  return {
    data: [...map, ...lobes],
    layout: layout({
      margin: { l: 62, r: 10, t: 52, b: 48 },
      uirevision: "wear",
      coloraxis: colourAxis(LOOK.wear, [0, deepest || 1], "worn depth (mm)", { len: 0.74, y: 1, yanchor: "top" }),
      showlegend: true,
      legend: { orientation: "h", x: 0, y: 1.005, yanchor: "bottom", font: { size: 11.5 }, itemclick: false, itemdoubleclick: false },
      xaxis: axis(SPEED, { range: [0, LAST_SPEED], anchor: "y2" }),
      yaxis: axis("casing angle (°)", { domain: [0.26, 1], range: [0, 360], tickvals: [0, 60, 120, 180, 240, 300, 360] }),
      yaxis2: axis("worn lobes", { domain: [0, 0.2], range: [0, 1.15 * Math.max(4, ...runs.lobes)], nticks: 4, showgrid: true }),
      shapes: wearShapes(speed),
    }),
  };
}

// Column of a spectrum at each of `n` equal steps of frequency: the bins that Figs. 7 to 9 have.
const FREQUENCY_BINS = 500;

function overFrequency(row, speed) {
  const scale = study.max_frequency / FREQUENCY_BINS / study.f_omega[speed] / study.order[1];
  return Array.from({ length: FREQUENCY_BINS }, (_, i) => row[Math.round((i + 0.5) * scale)] ?? NaN);
}

const ORDER_BINS = study.order.filter((order) => order <= study.last_order).length;

// Each order as a line, and its name where it leaves the picture; names too close to the last one are left out.
function engineOrders(choice) {
  const across = choice.axis === "order" ? study.last_order : study.max_frequency;
  const [x, y, named] = [[], [], { x: [], y: [], text: [], textposition: [] }];
  let last = [Infinity, Infinity];
  for (const k of study.orders) {
    const end = choice.axis === "order" ? [k, LAST_SPEED] : [Math.min(across, k * LAST_SPEED), Math.min(LAST_SPEED, across / k)];
    x.push(choice.axis === "order" ? k : 0, end[0], null);
    y.push(0, end[1], null);
    if (Math.abs(end[0] - last[0]) < 0.06 * across && Math.abs(end[1] - last[1]) < 0.045 * LAST_SPEED) continue;
    last = end;
    named.x.push(end[0]);
    named.y.push(end[1]);
    named.text.push(choice.axis === "order" ? `${k}` : `eo(${k})`);
    named.textposition.push(end[1] < LAST_SPEED ? "middle right" : "top center");
  }
  const common = { type: "scatter", hoverinfo: "skip", cliponaxis: false, showlegend: false };
  return [
    { ...common, x, y, mode: "lines", cliponaxis: true, line: { color: "#8f8f8f", width: 0.8 }, name: "engine orders", showlegend: true },
    { ...common, ...named, mode: "text", textfont: { size: 10.5, color: "#555555" } },
  ];
}

function spectrumShapes(choice) {
  const f = study.f_omega[choice.speed];
  return [
    { ...MISSING, xref: "x domain", yref: "y domain", x0: 0, x1: 1, y0: 0, y1: 1 },
    ...marker({ xref: "x domain", yref: "y", x0: 0, x1: 1, y0: f, y1: f }),
  ];
}

// Decades as the figures have them, in mm.
function decades([low, high]) {
  const powers = [];
  for (let power = Math.ceil(Math.log10(low)); power <= Math.log10(high); power += 1) powers.push(power);
  return { tickvals: powers, ticktext: powers.map((power) => String(Number(`1e${power}`))) };
}

// As Figs. 7 to 9: amplitude over speed and frequency, or engine order, with the engine orders and C1.
function spectrumMap(coating, choice) {
  const byOrder = choice.axis === "order";
  const across = byOrder ? study.last_order : study.max_frequency;
  const step = byOrder ? study.order[1] : across / FREQUENCY_BINS;
  const level = (value) => (Number.isNaN(value) ? null : Math.log10(value));
  const scale = study.amplitude_range;
  const row = (i) => (byOrder ? Array.from(coating.spectrum[i].subarray(0, ORDER_BINS)) : overFrequency(coating.spectrum[i], i));
  const place = (edges) => ({ x0: byOrder ? 0 : step / 2, dx: step, y: edges });
  const map = maps((i) => row(i).map(level), place, (speeds) => ({
    customdata: speeds.map(row),
    hovertemplate: `<i>f</i><sub>Ω</sub> = %{y:.4~f}<br>${byOrder ? "order" : "<i>f</i> ="} %{x:.2f}<br>≈ %{customdata:.2g} mm<extra></extra>`,
  }));
  const first = {
    type: "scatter",
    mode: "lines",
    name: "C₁",
    x: study.C1.map((C1, i) => (byOrder ? C1 / study.f_omega[i] : C1)),
    y: study.f_omega,
    hoverinfo: "skip",
    line: { color: LOOK.blue, width: 2, dash: "7px,4px" },
  };
  const found = coating.peaks.filter(({ f }) => f !== null);
  const peaks = {
    type: "scatter",
    mode: "markers",
    name: `${found.map(({ order }) => `Y${order}`).join(", ")}`,
    x: found.map(({ order, f }) => (byOrder ? order : order * f)),
    y: found.map(({ f }) => f),
    text: found.map(({ order, f, Y }) => `Y${order} = ${digits(Y)} mm<br>f${order} = ${f}`),
    hovertemplate: "%{text}<extra></extra>",
    marker: { symbol: "diamond", size: 9, color: "white", line: { color: LOOK.blue, width: 2 } },
  };
  return {
    data: [...map, ...engineOrders(choice), first, peaks],
    layout: layout({
      margin: { l: 62, r: 10, t: 68, b: 48 },
      uirevision: choice.axis,
      coloraxis: colourAxis(LOOK.amplitude, scale.map(Math.log10), "amplitude of node 1, radial (mm)", decades(scale)),
      showlegend: true,
      legend: { orientation: "h", x: 0, y: 1.055, yanchor: "bottom", font: { size: 11.5 }, itemclick: false, itemdoubleclick: false },
      xaxis: axis(byOrder ? "engine order <i>f</i> / <i>f</i><sub>Ω</sub>" : FREQUENCY, { range: [0, across], domain: [0, 0.93] }),
      yaxis: axis(SPEED, { range: [0, LAST_SPEED] }),
      shapes: spectrumShapes(choice),
    }),
  };
}

// As Fig. 19: worn depth around the casing.
function polar(shown, choice) {
  const angles = study.angle_edges.slice(1).map((edge, i) => (edge + study.angle_edges[i]) / 2);
  const deepest = Math.max(...shown.map(({ coating }) => Math.max(...coating.wear[choice.speed])));
  return {
    data: shown.map(({ side, coating }) => ({
      type: "scatterpolar",
      mode: "lines",
      name: side,
      theta: [...angles, angles[0]],
      r: [...coating.wear[choice.speed], coating.wear[choice.speed][0]],
      line: LINES[side],
      hovertemplate: `%{theta:.0f}°<br>≈ %{r:.2g} mm<extra>${side}</extra>`,
    })),
    layout: layout({
      margin: { l: 40, r: 40, t: 44, b: 28 },
      showlegend: shown.length > 1,
      legend: { x: 0, y: 1.14 },
      polar: {
        hole: 0.36,
        angularaxis: { rotation: 90, direction: "counterclockwise", tick0: 0, dtick: 45, gridcolor: "#dcdcdc", linecolor: LOOK.dark },
        radialaxis: { range: [0, 1.06 * deepest || 1], angle: 0, nticks: 4, gridcolor: "#dcdcdc", ticks: "outside", tickangle: 0 },
      },
    }),
  };
}

// Ticks of an axis that spans little more than a decade; plotly.js would name all but the decades by one digit.
const ONE_TWO_FIVE = [-5, -4, -3, -2, -1, 0, 1, 2].flatMap((decade) => [1, 2, 5].map((digit) => Number(`${digit}e${decade}`)));

// Log axis in mm, which names its decades in full.
function amplitudeAxis(more) {
  return axis("amplitude (mm)", { type: "log", exponentformat: "none", dtick: 1, showgrid: true, gridcolor: "#e8e8e8", ...more });
}

// One line of the spectrum map for each coating.
function spectrumLine(shown, choice) {
  const byOrder = choice.axis === "order";
  const f = study.f_omega[choice.speed];
  const across = byOrder ? study.last_order : study.max_frequency;
  const unit = byOrder ? 1 : f;
  const highest = Math.max(...shown.map(({ coating }) => coating.highest));
  const upright = (at, line) => ({ type: "line", xref: "x", yref: "y domain", x0: at, x1: at, y0: 0, y1: 1, layer: "below", line });
  const orders = study.orders.filter((k) => k * unit <= across);
  const named = orders.filter((k) => k % Math.ceil((0.055 * across) / unit) === 0);
  return {
    data: shown.map(({ side, coating }) => ({
      type: "scatter",
      mode: "lines",
      name: side,
      x: study.order.slice(0, study.kept[choice.speed]).map((order) => order * unit),
      y: coating.spectrum[choice.speed],
      line: { ...LINES[side], width: 1.5 },
      hovertemplate: `%{x:.3f}<br>≈ %{y:.2g} mm<extra>${side}</extra>`,
    })),
    layout: layout({
      showlegend: shown.length > 1,
      legend: { x: 1, xanchor: "right", y: 1, bgcolor: "rgba(255,255,255,0.85)" },
      xaxis: axis(byOrder ? "engine order" : FREQUENCY, { range: [0, across] }),
      yaxis: amplitudeAxis({ range: [Math.log10(study.amplitude_floor), Math.log10(2 * highest)] }),
      shapes: [
        ...orders.map((k) => upright(k * unit, { color: "#c4c4c4", width: 0.8 })),
        upright(study.C1[choice.speed] * (byOrder ? 1 / f : 1), { color: LOOK.blue, width: 2, dash: "7px,4px" }),
      ],
      annotations: [
        ...named.map((k) => ({ x: k * unit, y: 1, yref: "paper", yanchor: "bottom", text: String(k), showarrow: false, font: { size: 10.5, color: "#555555" } })),
        { x: 0, xref: "paper", xanchor: "right", xshift: -6, y: 1, yref: "paper", yanchor: "bottom", text: "eo", showarrow: false, font: { size: 10.5, color: "#555555" } },
        { x: study.C1[choice.speed] * (byOrder ? 1 / f : 1), y: 0.02, yref: "y domain", yanchor: "bottom", xanchor: "left", text: "C₁", showarrow: false, font: { color: LOOK.blue } },
      ],
    }),
  };
}

// A steady amplitude looks steady: the axis spans a factor of three at least.
function growthAxis(low, high) {
  const [middle, half] = [Math.log10(low * high) / 2, Math.max(Math.log10(3), 1.15 * Math.log10(high / low)) / 2];
  return amplitudeAxis({ range: [middle - half, middle + half], tickvals: ONE_TWO_FIVE, ticktext: ONE_TWO_FIVE.map(String) });
}

// Amplitude of each revolution, of the study's run and of the longer one, and the line of the growth found.
function growth(shown, choice) {
  const [data, amplitudes] = [[], []];
  let most = 1;
  for (const { side, coating } of shown) {
    const { own, longer } = coating.growth[choice.speed];
    const confirmed = wasRepeated(coating, choice.speed);
    const judged = (confirmed ? longer : own).filter((value) => !Number.isNaN(value));
    most = Math.max(most, judged.length, own.length);
    amplitudes.push(...judged, ...own.filter((value) => !Number.isNaN(value)));
    const common = { type: "scatter", hovertemplate: `revolution %{x}<br>≈ %{y:.3g} mm<extra>${side}</extra>` };
    const revolutions = (values) => Array.from(values, (_, i) => i + 1);
    if (confirmed) {
      data.push({ ...common, mode: "lines", showlegend: false, x: revolutions(longer), y: longer, line: { ...LINES[side], width: 1.2 } });
    }
    data.push({
      ...common,
      mode: "markers",
      name: side,
      x: revolutions(own),
      y: own,
      marker: { color: LINES[side].color, symbol: side === "A" ? "circle" : "diamond-open", size: 6 },
    });
    const rate = coating.runs.growth_per_revolution[choice.speed];
    const window = judged.slice(-study.growth_revolutions);
    if (rate !== null && window.length > 1 && Math.min(...window) > 0) {
      const last = judged.length;
      const middle = last - (window.length - 1) / 2;
      const mean = Math.exp(window.reduce((sum, value) => sum + Math.log(value), 0) / window.length);
      const ends = [last - window.length + 1, last];
      data.push({
        ...common,
        hoverinfo: "skip",
        hovertemplate: undefined,
        mode: "lines",
        showlegend: false,
        x: ends,
        y: ends.map((at) => mean * (1 + rate) ** (at - middle)),
        line: { color: LOOK.red, width: 2, dash: side === "A" ? "solid" : "dot" },
      });
    }
  }
  if (!amplitudes.length) amplitudes.push(1); // of a run that completed no revolution
  return {
    data,
    layout: layout({
      showlegend: shown.length > 1,
      legend: { orientation: "h", x: 0, y: 1.01, yanchor: "bottom" },
      xaxis: axis("revolution", { range: [0, most + 1] }),
      yaxis: growthAxis(Math.min(...amplitudes), Math.max(...amplitudes)),
    }),
  };
}
