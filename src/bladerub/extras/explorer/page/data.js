// The data of the page: the study, read at once, and each coating, unpacked when it is first looked at.

const study = JSON.parse(document.getElementById("study").textContent);

async function unpacked(id) {
  const text = atob(document.getElementById(id).textContent);
  const bytes = Uint8Array.from(text, (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// Depth by speed: differences along the circumference, in steps of 1/255 of the deepest. All lengths are in mm.
function wear(buffer, deepest) {
  const steps = new Uint8Array(buffer);
  const width = steps.length / deepest.length;
  return deepest.map((depth, speed) => {
    const row = new Float32Array(width);
    let step = 0;
    for (let i = 0; i < width; i += 1) {
      step = (step + steps[speed * width + i]) & 255;
      row[i] = (depth * step) / 255;
    }
    return row;
  });
}

// Values on a scale of equal ratios from `low` to `high`; step 0 stands for no value.
function ratios(steps, top, [low, high]) {
  const ratio = Math.log(high / low) / (top - 1);
  return Float32Array.from(steps, (step) => (step ? low * Math.exp((step - 1) * ratio) : NaN));
}

function split(values, lengths) {
  let end = 0;
  return lengths.map((length) => values.subarray(end, (end += length)));
}

async function open(index) {
  const [figures, ...buffers] = await Promise.all(
    ["figures", "wear", "spectrum", "growth"].map((part) => unpacked(`${part}-${index}`)),
  );
  const numbers = JSON.parse(new TextDecoder().decode(figures));
  const spectrum = ratios(new Uint8Array(buffers[1]), 255, numbers.spectrum_range);
  const growth = ratios(new Uint16Array(buffers[2]), 65535, numbers.growth_range);
  const { revolutions, confirmation_revolutions: longer } = numbers;
  return {
    ...study.coatings[index],
    index,
    runs: numbers.runs,
    revolutions,
    deepest: Math.max(...numbers.deepest),
    highest: numbers.spectrum_range[1],
    wear: wear(buffers[0], numbers.deepest),
    spectrum: split(spectrum, study.kept),
    growth: split(growth, study.f_omega.map(() => revolutions + longer)).map((row) => ({
      own: row.subarray(0, revolutions),
      longer: row.subarray(revolutions),
    })),
  };
}

const opened = new Map();

function coating(index) {
  if (!opened.has(index)) opened.set(index, open(index));
  return opened.get(index);
}
