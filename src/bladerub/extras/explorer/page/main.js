// From a choice to what is seen: controls change the choice, the choice is drawn.

let { choice, errors } = fromHash(location.hash);
let drawn = {}; // what the maps show now
let drawing = null;
let again = false;

function change(part) {
  choice = { ...choice, ...part };
  page("#status").textContent = "";
  showControls();
  draw();
}

// One drawing at a time; whatever was chosen meanwhile is drawn after it.
function draw() {
  page("#main").setAttribute("aria-busy", "true");
  again = true;
  drawing ??= (async () => {
    try {
      while (again) {
        again = false;
        await drawChoice(choice);
      }
      page("#main").setAttribute("aria-busy", "false");
    } catch (error) {
      page("#status").textContent = `This page is damaged: ${error.message}. Make it again.`;
      throw error;
    } finally {
      drawing = null;
    }
  })();
}

async function drawChoice(now) {
  const sides = now.compare ? SIDES : ["A"];
  const shown = await Promise.all(sides.map(async (each) => ({ side: each, coating: await coating(now[each]) })));
  document.body.classList.toggle("comparing", now.compare);
  const deepest = Math.max(...shown.map((each) => each.coating.deepest));
  const pictures = [];
  for (const { side: each, coating: at } of shown) {
    const top = now.sameScale ? deepest : at.deepest;
    pictures.push(
      map(`wear-${each}`, [at.index, top, now.compare], wearShapes(now.speed), () => wearMap(at, now.speed, top)),
      map(`spectrum-${each}`, [at.index, now.axis, now.compare], spectrumShapes(now), () => spectrumMap(at, now)),
    );
  }
  for (const [name, picture] of Object.entries({ polar, line: spectrumLine, growth })) {
    const { data, layout } = picture(shown, now);
    pictures.push(Plotly.react(name, data, layout, CONFIG));
  }
  showTitles(shown);
  showRun(shown, now, (speed) => change({ speed }));
  showModuli(now, (index) => change({ [now.side]: index }));
  describe(shown, now);
  await Promise.all(pictures);
  await new Promise(requestAnimationFrame);
  remember();
}

// A map is drawn again only if it shows something else; a changed speed moves its line.
function map(name, shows, shapes, draft) {
  const key = JSON.stringify(shows);
  if (drawn[name] === key) return Plotly.relayout(name, { shapes });
  const first = !(name in drawn);
  drawn[name] = key;
  const { data, layout } = draft();
  const done = Plotly.react(name, data, layout, CONFIG);
  if (first) {
    const picture = document.getElementById(name);
    picture.on("plotly_click", ({ points: [point] }) => {
      change({ speed: nearest(study.f_omega, name.startsWith("wear") ? point.x : point.y) });
    });
    picture.on("plotly_relayout", (update) => mirror(name, update));
  }
  return done;
}

// What is zoomed in one map is zoomed in the map beside it.
let mirroring = false;
async function mirror(name, update) {
  const zoom = Object.fromEntries(Object.entries(update).filter(([setting]) => setting.includes(".range")));
  const other = name.endsWith("A") ? name.replace("A", "B") : name.replace("B", "A");
  if (mirroring || !choice.compare || !(other in drawn) || Object.keys(zoom).length === 0) return;
  mirroring = true;
  await Plotly.relayout(other, zoom);
  mirroring = false;
}

// The address follows a moment later: browsers take it amiss if it changes with every key.
let remembering;
function remember() {
  const link = toHash(choice);
  page("#link").href = link;
  clearTimeout(remembering);
  remembering = setTimeout(() => history.replaceState(null, "", link), 150);
}

function fill(select, values, value) {
  select.replaceChildren(...values.map((each) => element("option", { value: String(each) }, String(each))));
  select.value = String(value);
}

function showControls() {
  for (const each of SIDES) {
    const now = study.coatings[choice[each]];
    const group = page(`#coating-${each}`);
    PROPERTIES.forEach((name, i) => {
      const options = fitting(now, PROPERTIES.slice(0, i)).map((other) => property(other, name));
      const distinct = [...new Set(options)];
      if (name !== "casing") distinct.sort((a, b) => isNaN(a) - isNaN(b) || a - b);
      const select = group.querySelector(`[name=${name}]`);
      fill(select, distinct, property(now, name));
      select.disabled = each === "B" && !choice.compare;
    });
    group.querySelector(".variant").hidden = study.coatings.every(({ variant }) => !variant);
    group.querySelector(".angle").textContent = now.rigid ? "friction μ" : "θ (rad)";
  }
  page("#compare").checked = choice.compare;
  page("#axis").value = choice.axis;
  page("#same-scale").checked = choice.sameScale;
  page("#speed").value = choice.speed;
  page("#speed").setAttribute("aria-valuetext", speedInWords(choice.speed));
  page("#speed-text").textContent = speedInWords(choice.speed);
  page("#slower").disabled = choice.speed === 0;
  page("#faster").disabled = choice.speed === study.f_omega.length - 1;
  page(`#side [value=${choice.side}]`).checked = true;
  page(`#order [value="${choice.order}"]`).checked = true;
}

function goBy(steps) {
  const speed = Math.min(study.f_omega.length - 1, Math.max(0, choice.speed + steps));
  if (speed !== choice.speed) change({ speed });
}

const KEYS = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10, Home: -Infinity, End: Infinity };

// The slider and the pictures take all of these keys; elsewhere the vertical ones scroll the page.
function key(event) {
  const onControl = event.target.closest("select, input:not(#speed), button, #moduli-grid");
  const onSpeed = event.target.closest("#speed, .picture");
  const sideways = event.key === "ArrowLeft" || event.key === "ArrowRight";
  if (event.ctrlKey || event.altKey || event.metaKey || onControl || !(event.key in KEYS) || !(onSpeed || sideways)) return;
  event.preventDefault();
  goBy(KEYS[event.key]);
}

function listen() {
  for (const each of SIDES) {
    for (const name of PROPERTIES) {
      page(`#coating-${each} [name=${name}]`).addEventListener("change", ({ target }) => {
        change({ side: each, [each]: changed(choice[each], name, target.value) });
      });
    }
  }
  page("#choice").addEventListener("submit", (event) => event.preventDefault());
  page("#compare").addEventListener("change", ({ target }) => {
    change({ compare: target.checked, side: target.checked ? "B" : "A" });
  });
  page("#axis").addEventListener("change", ({ target }) => change({ axis: target.value }));
  page("#same-scale").addEventListener("change", ({ target }) => change({ sameScale: target.checked }));
  page("#speed").addEventListener("input", ({ target }) => change({ speed: Number(target.value) }));
  page("#slower").addEventListener("click", () => goBy(-1));
  page("#faster").addEventListener("click", () => goBy(1));
  page("#order").addEventListener("change", ({ target }) => change({ order: Number(target.value) }));
  page("#side").addEventListener("change", ({ target }) => change({ side: target.value }));
  document.addEventListener("keydown", key);
  window.addEventListener("hashchange", () => {
    ({ choice, errors } = fromHash(location.hash));
    begin();
  });
  page("#link").addEventListener("click", async (event) => {
    event.preventDefault();
    const { href } = event.currentTarget;
    try {
      await navigator.clipboard.writeText(href);
      page("#status").textContent = "The link is copied.";
    } catch {
      page("#status").textContent = `Copy the address of this page, it holds the view: ${href}`;
    }
  });
}

function begin() {
  showControls();
  page("#status").textContent = errors.length ? `Not all of the link could be restored: ${errors.join("; ")}.` : "";
  draw();
}

page("#speed").max = study.f_omega.length - 1;
page("#order").append(
  "Engine order ",
  ...PEAK_ORDERS.map((order) => element("label", {}, element("input", { type: "radio", name: "order", value: order }), ` ${order}`)),
);
showThinned();
showUnits();
listen();
begin();
