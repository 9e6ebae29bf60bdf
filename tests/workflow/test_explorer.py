"""Explorer and report of the tiny study in a real browser; skipped where there is none."""

import shutil

import numpy as np
import pytest

from bladerub.study.maps import read_map

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

STRAIGHT = "2nd_E2_K0.5_theta0"

FLAGS = ["headless", "no-sandbox", "disable-gpu", "disable-background-networking", "window-size=1400,1000"]
SECONDS_TO_OPEN = 3.0


class Explorer:
    """The page in a browser: what a user does, and what can be seen then."""

    def __init__(self, driver, path):
        self.driver, self.path = driver, path

    def open(self, link=""):
        self.driver.get("about:blank")
        self.driver.get(self.path.as_uri() + link)
        return self.wait()

    def wait(self):
        from selenium.webdriver.support.ui import WebDriverWait

        settled = (
            "return document.querySelector('#main')?.getAttribute('aria-busy') === 'false'"
            " && document.querySelector('#link').hash === location.hash"
        )
        wait = WebDriverWait(self.driver, 30, poll_frequency=0.02)
        wait.until(lambda driver: driver.execute_script(settled))
        return self

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def click(self, selector):
        self.find(selector).click()
        return self.wait()

    def click_map(self, name, x, y):
        """Click a picture at the values `x`, `y` of its axes."""
        from selenium.webdriver import ActionChains

        picture = self.find(f"#{name}")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        place = (
            "const [picture, x, y] = arguments, { xaxis, yaxis } = picture._fullLayout;"
            "const box = picture.getBoundingClientRect();"
            "const [right, down] = [xaxis._offset + xaxis.l2p(x), yaxis._offset + yaxis.l2p(y)];"
            "return [right - box.width / 2, down - box.height / 2]"
        )
        right, down = self.driver.execute_script(place, picture, x, y)
        mouse = ActionChains(self.driver).move_to_element_with_offset(picture, right, down)
        mouse.pause(0.2).click().perform()
        return self.wait()

    def drawn(self, name, key, trace=0):
        values = self.asked(f"Array.from(document.getElementById('{name}').data[{trace}].{key})")
        return np.array(values, dtype=float)

    def asked(self, script):
        return self.driver.execute_script(f"return {script}")


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    reason = "no selenium; .venv/bin/pip install -e .[browser]"
    webdriver = pytest.importorskip("selenium.webdriver", reason=reason)
    chromium, chromedriver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not chromedriver:
        pytest.skip("no chromium and chromedriver; apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in [*FLAGS, f"user-data-dir={tmp_path_factory.mktemp('browser')}"]:
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(chromedriver))
    yield driver
    driver.quit()


@pytest.fixture
def explorer(study, driver):
    return Explorer(driver, study.results / "explorer.html").open(f"#A={STRAIGHT}&f=0.206")


def test_it_opens_soon_from_a_file_and_asks_nobody(explorer):
    taken = [explorer.open().asked("performance.now()") / 1e3 for _ in range(3)]
    assert min(taken) < SECONDS_TO_OPEN  # others may be at work on this machine
    assert explorer.driver.get_log("browser") == []
    assert explorer.asked("performance.getEntriesByType('resource').length") == 0


def test_the_pictures_are_those_of_the_study(explorer, study):
    coating = read_map(study.results / "maps" / f"{STRAIGHT}.h5")
    at = int(np.flatnonzero(coating.f_omega == 0.206)[0])
    wear = 1e3 * coating.wear[at].reshape(500, 4).mean(axis=1)
    np.testing.assert_allclose(explorer.drawn("polar", "r")[:-1], wear, atol=wear.max() / 500)
    amplitude = 1e3 * np.maximum(coating.spectrum_amplitude[at], 1e-8)
    drawn = explorer.drawn("line", "y")
    np.testing.assert_allclose(drawn, amplitude[: drawn.size], rtol=0.04)
    frequency = 0.206 * coating.spectrum_order[: drawn.size]
    np.testing.assert_allclose(explorer.drawn("line", "x"), frequency, rtol=1e-9)
    trace = explorer.asked("document.getElementById('growth').data.findIndex((at) => at.mode === 'markers')")
    markers = explorer.drawn("growth", "y", trace)
    np.testing.assert_allclose(markers, 1e3 * coating.revolution_amplitude[at], rtol=2e-3)


@pytest.mark.parametrize(("name", "x", "y"), [("wear-A", 0.27, 100), ("spectrum-A", 1.0, 0.27)])
def test_a_click_in_a_map_chooses_the_speed(explorer, name, x, y):
    def run():
        return explorer.drawn("polar", "r").tolist(), explorer.find("#figures tbody").text

    before = run()
    explorer.click_map(name, x, y)
    assert explorer.find("#speed-text").text.startswith("0.27, ")
    assert all(now != then for now, then in zip(run(), before, strict=True))
    line = "document.getElementById('{}').layout.shapes.at(-1).{}"
    assert [explorer.asked(line.format(*of)) for of in (("wear-A", "x0"), ("spectrum-A", "y0"))] == [0.27] * 2


def test_a_link_restores_the_view(explorer):
    explorer.click("#compare").click("#coating-B [name=E] [value='0.11']").click("#axis [value='order']")
    explorer.click("#same-scale").click("#order [value='6']").click_map("spectrum-A", 4.0, 0.31)
    state = """JSON.stringify([
        [...document.querySelectorAll('select, input')].map((each) => [each.value, each.checked]),
        [...document.querySelectorAll('h2, #moduli, #figures')].map((each) => each.innerText),
        [...document.querySelectorAll('.picture')].map(
            ({ data }) => data?.map(({ x, y, z, r }) => [x, y, z, r])),
    ])"""
    link, seen = explorer.asked("location.hash"), explorer.asked(state)
    explorer.open()
    assert explorer.asked("location.hash") != link
    assert explorer.asked(state) != seen
    explorer.open(link)
    assert explorer.asked("location.hash") == link
    assert explorer.asked(state) == seen


@pytest.mark.parametrize("width", [1400, 420])
def test_the_report_fits_a_screen_and_a_phone(study, driver, tmp_path, width):
    page = tmp_path / "report.html"
    study.said("bladerub", "report", "-o", page)
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
