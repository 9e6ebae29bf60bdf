"""Explorer and report of the tiny study in a real browser; skipped where there is none."""

import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bladerub.study.maps import read_map

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

STRAIGHT = "2nd_E2_K0.5_theta0"

FLAGS = [
    "headless",
    "no-sandbox",
    "disable-gpu",
    "disable-quic",
    "no-first-run",
    "disable-background-networking",
]
SECONDS_TO_OPEN = 3.0


class Explorer:
    """The page in a browser: what a user does, and what can be seen then."""

    def __init__(self, driver: Any, path: Path):
        self.driver, self.path = driver, path

    def open(self, link: str = "") -> "Explorer":
        """Open the page anew from its file, at `link`, and wait until it is drawn."""
        self.driver.get("about:blank")
        self.driver.get(self.path.as_uri() + link)
        return self.wait()

    def wait(self) -> "Explorer":
        """Wait until everything chosen is drawn, and the address holds it."""
        from selenium.webdriver.support.ui import WebDriverWait

        settled = (
            "return document.querySelector('#main')?.getAttribute('aria-busy') === 'false'"
            " && document.querySelector('#link').hash === location.hash"
        )
        WebDriverWait(self.driver, 30, poll_frequency=0.02).until(
            lambda driver: driver.execute_script(settled)
        )
        return self

    def find(self, selector: str) -> Any:
        return self.driver.find_element("css selector", selector)

    def click(self, selector: str) -> "Explorer":
        self.find(selector).click()
        return self.wait()

    def choose(self, selector: str, value: str) -> "Explorer":
        from selenium.webdriver.support.ui import Select

        Select(self.find(selector)).select_by_value(value)
        return self.wait()

    def click_map(self, name: str, x: float, y: float) -> "Explorer":
        """Click a picture at the values `x`, `y` of its axes."""
        from selenium.webdriver import ActionChains

        picture = self.find(f"#{name}")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        right, down = self.driver.execute_script(
            "const [picture, x, y] = arguments, { xaxis, yaxis } = picture._fullLayout;"
            "const box = picture.getBoundingClientRect();"
            "const [right, down] = [xaxis._offset + xaxis.l2p(x), yaxis._offset + yaxis.l2p(y)];"
            "return [right - box.width / 2, down - box.height / 2]",
            picture,
            x,
            y,
        )
        ActionChains(self.driver).move_to_element_with_offset(picture, right, down).pause(
            0.2
        ).click().perform()
        return self.wait()

    def drawn(self, name: str, key: str, trace: int = 0) -> np.ndarray:
        """Values of one trace of a picture."""
        values = self.driver.execute_script(
            f"return Array.from(document.getElementById('{name}').data[{trace}].{key})"
        )
        return np.array(values, dtype=float)

    @property
    def run(self) -> dict[str, list[str]]:
        """The table of the run: a text for each coating by the name of the row."""
        rows = self.driver.execute_script(
            "return [...document.querySelectorAll('#figures tbody tr')]"
            ".map((row) => [...row.children].map((cell) => cell.textContent))"
        )
        return {name: texts for name, *texts in rows}

    @property
    def speed(self) -> float:
        return float(self.find("#speed-text").text)

    @property
    def link(self) -> str:
        return self.driver.execute_script("return location.hash")

    @property
    def complaints(self) -> list[str]:
        return [entry["message"] for entry in self.driver.get_log("browser")]


@pytest.fixture(scope="module")
def driver(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    webdriver = pytest.importorskip(
        "selenium.webdriver", reason="no selenium; .venv/bin/pip install -e .[browser]"
    )
    chromium, chromedriver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not chromedriver:
        pytest.skip("no chromium and chromedriver; apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in [*FLAGS, "window-size=1400,1000", f"user-data-dir={tmp_path_factory.mktemp('browser')}"]:
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(chromedriver))
    yield driver
    driver.quit()


@pytest.fixture
def explorer(study, driver) -> Explorer:
    return Explorer(driver, study.folder / "results" / "explorer.html").open(f"#A={STRAIGHT}&f=0.206")


@pytest.fixture
def map_of(study) -> Callable:
    return lambda name: read_map(study.folder / "results" / "maps" / f"{name}.h5")


def test_it_opens_soon_from_a_file_and_asks_nobody(explorer):
    since = "return performance.now()"
    taken = [explorer.open().driver.execute_script(since) / 1e3 for _ in range(3)]
    assert min(taken) < SECONDS_TO_OPEN  # others may be at work on this machine
    assert explorer.complaints == []
    assert explorer.driver.execute_script("return performance.getEntriesByType('resource').length") == 0
    assert explorer.path.stat().st_size < 15e6


def test_the_pictures_are_those_of_the_study(explorer, map_of):
    coating = map_of(STRAIGHT)
    at = int(np.flatnonzero(coating.f_omega == 0.206)[0])
    wear = 1e3 * coating.wear[at].reshape(500, 4).mean(axis=1)
    np.testing.assert_allclose(explorer.drawn("polar", "r")[:-1], wear, atol=wear.max() / 500)
    amplitude = 1e3 * np.maximum(coating.spectrum_amplitude[at], 1e-8)
    drawn = explorer.drawn("line", "y")
    np.testing.assert_allclose(drawn, amplitude[: drawn.size], rtol=0.04)
    np.testing.assert_allclose(
        explorer.drawn("line", "x"), 0.206 * coating.spectrum_order[: drawn.size], rtol=1e-9
    )
    markers = explorer.drawn(
        "growth",
        "y",
        trace=explorer.driver.execute_script(
            "return document.getElementById('growth').data.findIndex(({ mode }) => mode === 'markers')"
        ),
    )
    np.testing.assert_allclose(markers, 1e3 * coating.revolution_amplitude[at], rtol=2e-3)


@pytest.mark.parametrize(("name", "x", "y"), [("wear-A", 0.27, 100), ("spectrum-A", 1.0, 0.27)])
def test_a_click_in_a_map_chooses_the_speed(explorer, name, x, y):
    before = explorer.drawn("polar", "r").tolist(), explorer.run["Key of the run"]
    explorer.click_map(name, x, y)
    assert explorer.speed == 0.27
    assert explorer.drawn("polar", "r").tolist() != before[0]
    assert explorer.run["Key of the run"] != before[1]
    lines = explorer.driver.execute_script(
        "return ['wear-A', 'spectrum-A'].map((name) => document.getElementById(name).layout.shapes.at(-1))"
    )
    assert (lines[0]["x0"], lines[1]["y0"]) == (0.27, 0.27)


def test_a_link_restores_the_view(explorer):
    explorer.click("#compare").choose("#coating-B [name=E]", "0.11").choose("#axis", "order")
    explorer.click("#same-scale").click("#order [value='6']").click_map("spectrum-A", 4.0, 0.31)
    state = """return JSON.stringify([
        [...document.querySelectorAll('select, input')].map((each) => [each.value, each.checked]),
        [...document.querySelectorAll('h2, #moduli, #figures')].map((each) => each.innerText),
        [...document.querySelectorAll('.picture')].map(
            ({ data }) => data?.map(({ x, y, z, r }) => [x, y, z, r])),
    ])"""
    link, seen = explorer.link, explorer.driver.execute_script(state)
    explorer.open()
    assert explorer.link != link
    assert explorer.driver.execute_script(state) != seen
    explorer.open(link)
    assert explorer.link == link
    assert explorer.driver.execute_script(state) == seen


@pytest.mark.parametrize("width", [1400, 420])
def test_the_report_fits_a_screen_and_a_phone(study, driver, tmp_path, width):
    page = tmp_path / "report.html"
    done = study.call(Path(sys.executable).with_name("bladerub"), "report", "-o", page)
    assert done.returncode == 0, done.stderr
    assert page.stat().st_size < 5e6
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    driver.get(page.as_uri())
    pictures = "return [...document.images].every((image) => image.complete && image.naturalWidth > 0)"
    assert driver.execute_script(pictures)
    assert driver.execute_script("return document.documentElement.scrollWidth") <= width
    assert driver.execute_script("return performance.getEntriesByType('resource').length") == 0
    assert driver.get_log("browser") == []
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
