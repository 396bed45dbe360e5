"""Drives the report in a real browser, its family browser first, and fails where it does not follow.

    browser_test.py HOWL SOURCE_DIR

The family has ten thousand members on the closed form of equation (5c), so that what the page must
show is known beforehand. Exit status 77, after saying why, where no browser is at hand.
"""
import math
import os
import re
import subprocess
import sys
import tempfile
import time

from page_checks import check, test_rows, test_summary, test_zoom

SKIP = 77
MEMBERS = 10000
# Tables 2 and 3 of the paper.
EXPERIMENTS = [
    ("exp1", 0.56, 219.9, -5.74, 12.14, -0.703e-4), ("exp2", 0.53, 209.1, -9.44, 13.15, -0.707e-4),
    ("exp3", 0.51, 205.7, -14.35, 14.79, -0.670e-4), ("exp4", 0.49, 202.7, -19.18, 16.05, -0.626e-4),
    ("exp5", 0.47, 198.4, -22.92, 18.80, -0.401e-4), ("exp6", 0.45, 179.8, -42.72, 45.01, -0.0872e-4),
]
HEADER = ("member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,"
          "loop_phase_error_deg")


def on_closed_form(f, phase_deg, gain, xi):
    """(5c): omega and N for a damping ratio; the delay of (3)."""
    t = math.tan(math.radians(-phase_deg))
    omega = f * (-xi * t + math.sqrt(xi * xi * t * t + 1))
    n = gain * 2 * xi * 2 * math.pi * omega / math.cos(math.radians(phase_deg))
    tau = (270 + phase_deg) / (360 * f)
    return omega, n, tau


def write_family(folder):
    """Member m: xi from 0.01 to 0.4 at the first experiment, less with phi. Returns each one's xi."""
    spreads = []
    with open(os.path.join(folder, "family.csv"), "w", encoding="utf-8") as file:
        file.write(HEADER + "\n")
        for m in range(MEMBERS):
            # A permutation, so that a member's number is not its place along the trade-off.
            xi_first = 0.01 + 0.39 * ((m * 7919) % MEMBERS) / (MEMBERS - 1)
            omegas = []
            for name, phi, f, phase, gain, slope in EXPERIMENTS:
                xi = xi_first * (phi / 0.56) ** 2
                omega, n, tau = on_closed_form(f, phase, gain, xi)
                omegas.append(omega)
                loop_gain = gain * 2 * math.pi * f * abs(slope)
                file.write(f"{m + 1},{name},{phi},{omega!r},{xi!r},{n!r},0,{tau!r},{loop_gain!r},0,0,0\n")
            spreads.append((100 * (max(omegas) / min(omegas) - 1), xi_first))
    return spreads


class Page:
    def __init__(self, driver):
        self.driver = driver

    def text(self, css):
        return self.driver.execute_script("return document.querySelector(arguments[0]).textContent", css)

    def row(self, name):
        """A row of the table of predictions: its cells."""
        rows = self.driver.execute_script(
            "return [...document.querySelectorAll('#predictions tbody tr')]"
            ".map((r) => [...r.children].map((c) => c.textContent))")
        return next(cells for cells in rows if cells[0].startswith(name))

    def chosen(self):
        return int(re.match(r"Member (\d+) of", self.text("#chosen")).group(1))

    def settle(self):
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))")

    def set(self, css, value, event):
        self.driver.execute_script(
            "const e = document.querySelector(arguments[0]); e.value = arguments[1];"
            "e.dispatchEvent(new Event(arguments[2], {bubbles: true}))", css, str(value), event)
        self.settle()

    def pixels(self, css):
        """What a plot shows, as its canvas' picture."""
        return self.driver.execute_script(
            "return document.querySelector(arguments[0] + ' canvas').toDataURL()", css)


def close(a, b, relative=2e-4):
    return abs(a - b) <= relative * max(abs(a), abs(b))


def start_browser():
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.options import Options
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        return None, "python3-selenium is not installed"
    for program in ("/usr/bin/chromium", "/usr/bin/chromedriver"):
        if not os.path.exists(program):
            return None, f"{program} is not installed"
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--window-size=1280,1000"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options), ""


def test_load(driver, path):
    """Under ten megabytes, and drawn when loaded. How long it takes is printed, not asserted."""
    size = os.path.getsize(path)
    check(size < 10e6, f"the page has {size} bytes")
    begin = time.monotonic()
    driver.get("file://" + path)
    check(driver.execute_script("return document.documentElement.dataset.browserReady") == "true",
          "the browser is not ready after loading")
    seconds = time.monotonic() - begin
    print(f"{MEMBERS} members: {size / 1e6:.2f} MB, loaded in {seconds:.2f} s")


def test_choose(page, spreads):
    for number in (1, 4321, MEMBERS):
        before = page.pixels("#plot-gain")
        page.set("#member", number, "input")
        check(page.chosen() == number, f"asked for member {number}, shown is {page.chosen()}")
        check(page.pixels("#plot-gain") != before, f"|G| did not change with member {number}")
        name, _, f, phase, gain, slope = EXPERIMENTS[0]
        xi = spreads[number - 1][1]
        omega, n, tau = on_closed_form(f, phase, gain, xi)
        for row, expected in (("ω", omega), ("ξ", xi), ("N", n), ("τ", 1e3 * tau),
                              ("|G| at", gain), ("phase of G", phase),
                              ("loop gain", gain * 2 * math.pi * f * abs(slope))):
            shown = float(page.row(row)[1])
            check(close(shown, expected), f"member {number}, {row}: {shown}, expected {expected}")
        # The loop closes where the data say: without noise the cycle's frequency is close to it.
        shown = float(page.row("frequency of the cycle")[1])
        check(abs(shown / f - 1) < 0.01, f"member {number} cycles at {shown} Hz, measured {f}")


def test_growth(page, spreads):
    """1 - k L(s) = 0 at s = sigma + j w, from an independent root finder."""
    import cmath
    page.set("#member", 4321, "input")
    name, _, f, phase, gain, k = EXPERIMENTS[0]
    omega, n, tau = on_closed_form(f, phase, gain, spreads[4320][1])
    xi, w = spreads[4320][1], 2 * math.pi * omega

    def balance(s):
        return 1 - k * n * s * s * cmath.exp(-tau * s) / (s * s + 2 * xi * w * s + w * w)

    a, b = complex(1, 2 * math.pi * f), complex(20, 2 * math.pi * f)
    for _ in range(60):  # secants
        fa, fb = balance(a), balance(b)
        if fa == fb:
            break
        a, b = b, b - fb * (b - a) / (fb - fa)
    shown = float(page.row("growth rate")[1])
    check(close(shown, b.real), f"growth rate {shown}, expected {b.real}")


def test_slider(page, spreads):
    order = sorted(range(MEMBERS), key=lambda m: spreads[m])
    for place in (0, 5000, MEMBERS - 1):
        page.set("#along", place, "input")
        expected = order[place]
        shown = page.chosen() - 1
        check(close(spreads[shown][0], spreads[expected][0], 1e-3),
              f"place {place}: member {shown + 1} with spread {spreads[shown][0]}")


def test_experiment(page, spreads):
    before = page.pixels("#plot-nyquist")
    page.set("#experiment", 3, "change")
    name, phi, f, phase, gain, slope = EXPERIMENTS[3]
    check(close(float(page.row("|G| at")[1]), gain), "the table does not follow the experiment")
    check(page.pixels("#plot-nyquist") != before, "Nyquist's curve does not follow the experiment")
    page.set("#experiment", 0, "change")


def test_nyquist(driver, page, spreads):
    """|Phi'(0)| L with the measured slope, also where that is too small for a cycle (exp5: 0.94)."""
    import cmath
    from selenium.webdriver.common.action_chains import ActionChains
    page.set("#member", 4321, "input")
    for index, raised in ((4, True), (0, False)):
        page.set("#experiment", index, "change")
        name, phi, f, phase, gain, slope = EXPERIMENTS[index]
        xi = spreads[4320][1] * (phi / 0.56) ** 2
        omega, n, tau = on_closed_form(f, phase, gain, xi)
        w = 2 * math.pi * omega
        over = driver.find_element("css selector", "#plot-nyquist .u-over")
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", over)
        for x, y in ((-80, 0), (0, 60), (50, -40)):
            ActionChains(driver).move_to_element_with_offset(over, x, y).perform()
            page.settle()
            text = page.text("#hover-nyquist")
            hz, re_, im_ = map(float, re.match(r"([\d.]+) Hz: (\S+) \+ (\S+) j", text).groups())
            s = 2j * math.pi * hz
            expected = abs(slope) * n * s * s * cmath.exp(-tau * s) / (s * s + 2 * xi * w * s + w * w)
            # The frequency is shown with five digits.
            check(abs(complex(re_, im_) - expected) < 2e-3 * (1 + abs(expected)),
                  f"{name}: Nyquist's curve shows {text}, expected {expected}")
        loop_gain = gain * 2 * math.pi * f * abs(slope)
        noted = re.search(r"loop gain at the cycle is ([\d.]+\d), below", page.text("#nyquist-note"))
        check(bool(noted) == raised and (not noted or close(float(noted.group(1)), loop_gain)),
              f"{name}: Nyquist's note says {page.text('#nyquist-note')!r}, expected {loop_gain}")
        check(("raised to a loop gain of 1.1" in page.text("#time-note")) == raised,
              f"{name}: the time course's note says {page.text('#time-note')!r}")


def test_family_alone(driver, page, howl, source):
    """Records and their family, neither analysed nor fitted: the browser is whole all the same."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([howl, "simulate", source + "/configs/r228.yaml", "--out", folder, "--quiet"],
                       check=True)
        records = os.path.join(folder, "records.yaml")
        with open(records, encoding="utf-8") as file:
            asked = file.read().split("\nfamily:")[0]
        with open(records, "w", encoding="utf-8") as file:
            file.write(asked + "\n")
            file.write("family: {members: 40, test: {transfer_distance_max: null, "
                       "loop_gain_min: null, xi_max: 0.9}}\n")
        out = os.path.join(folder, "out")
        subprocess.run([howl, "family", os.path.join(folder, "records.yaml"), "--out", out, "--quiet"],
                       check=True)
        subprocess.run([howl, "report", out, "--quiet"], check=True)
        driver.get("file://" + os.path.join(out, "report.html"))
        check(driver.execute_script("return document.documentElement.dataset.browserReady") == "true",
              "the browser is not ready")
        for index, (name, _, f, _, gain, _) in enumerate(EXPERIMENTS):
            page.set("#experiment", index, "change")
            cells = page.row("|G| at")
            check(len(cells) == 3, f"{name}: without a joint fit the table has no column for it: {cells}")
            check(abs(float(cells[1]) / gain - 1) < 0.05, f"{name}: the member's |G| is {cells[1]}")
            check(re.fullmatch(r"[\d.]+ ± [\d.]+", cells[2]), f"{name}: the data's |G| is {cells[2]}")
            shown = page.row("frequency of the cycle")[2]
            check(abs(float(shown.split()[0]) / f - 1) < 0.01, f"{name}: the data's cycle is {shown}")
        legends = driver.execute_script(
            "return [...document.querySelectorAll('.u-legend tr')].filter((r) => r.offsetParent)"
            ".map((r) => r.textContent)")
        check(not any("joint fit" in text for text in legends), f"legends name a joint fit: {legends}")
        check("joint fit" not in page.text("#figure-bounds figcaption"), "bounds name a joint fit")


def test_drag(driver, page, spreads):
    from selenium.webdriver.common.action_chains import ActionChains
    page.set("#member", 1, "input")
    over = driver.find_element("css selector", "#plot-tradeoff .u-over")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", over)
    width, height = over.size["width"], over.size["height"]
    seen = []
    drag = ActionChains(driver, duration=60)
    drag.move_to_element_with_offset(over, int(-0.4 * width), int(0.3 * height)).click_and_hold()
    drag.perform()
    page.settle()
    seen.append(page.chosen())
    for _ in range(3):
        ActionChains(driver, duration=60).move_by_offset(int(0.25 * width), int(-0.2 * height)).perform()
        page.settle()
        seen.append(page.chosen())
    ActionChains(driver).release().perform()
    check(len(set(seen)) == len(seen), f"dragging chose {seen}")
    # Less spread comes with more damping: a drag to the right goes down the trade-off.
    shown = [spreads[m - 1][0] for m in seen]
    check(shown == sorted(shown), f"dragging to the right gave spreads {shown}")
    # Moving without the button held chooses nothing.
    ActionChains(driver).move_by_offset(-int(0.5 * width), 0).perform()
    page.settle()
    check(page.chosen() == seen[-1], "the choice follows the pointer after its release")


def test_hover(driver, page):
    from selenium.webdriver.common.action_chains import ActionChains
    for plot in ("gain", "phase", "time"):
        over = driver.find_element("css selector", f"#plot-{plot} .u-over")
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", over)
        shown = []
        for share in (-0.2, 0.2):
            ActionChains(driver).move_to_element_with_offset(
                over, int(share * over.size["width"]), 0).perform()
            page.settle()
            shown.append([cell.text for cell in driver.find_elements(
                "css selector", f"#plot-{plot} .u-legend .u-value")][:2])
        check(all(re.fullmatch(r"-?[\d.]+(e[-+]?\d+)?", cell) for row in shown for cell in row),
              f"hovering over {plot} shows {shown}")
        check(shown[0][0] != shown[1][0], f"hovering over {plot} does not follow: {shown}")
    for plot, pattern in (("nyquist", r"[\d.]+ Hz: -?[\d.]"), ("tradeoff", r"member \d+: spread")):
        over = driver.find_element("css selector", f"#plot-{plot} .u-over")
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", over)
        ActionChains(driver).move_to_element_with_offset(over, 40, 10).perform()
        page.settle()
        text = page.text(f"#hover-{plot}")
        check(re.match(pattern, text), f"hovering over {plot} shows {text!r}")


def test_appearance(driver):
    """No figure wider than the page, and ink that differs from paper, by day and by night."""
    for width in (1280, 700, 400):
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        for scheme in ("light", "dark"):
            driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": scheme}]})
            state = driver.execute_script("""
                const style = (e) => getComputedStyle(e);
                const text = document.querySelector('.drawing text');
                return [document.documentElement.scrollWidth, style(document.body).color,
                        style(document.documentElement).backgroundColor,
                        text ? style(text).fill : style(document.body).color];""")
            check(state[0] <= width, f"the page is {state[0]} wide in a window of {width}")
            check(state[1] != state[2], f"{scheme}: ink and paper are both {state[1]}")
            check(state[3] == state[1], f"{scheme}: figures write in {state[3]}, the page in {state[1]}")
        wide = driver.execute_script("""
            return [...document.querySelectorAll('main *')].filter((e) => !e.closest('.scroll, svg')
              && e.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
              .map((e) => e.tagName + '#' + e.id + '.' + e.className)""")
        check(not wide, f"in a window of {width} these are cut off: {wide[:5]}")
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def main():
    howl, source = sys.argv[1], sys.argv[2]
    driver, why_not = start_browser()
    if driver is None:
        print("skipped: " + why_not)
        return SKIP
    try:
        with tempfile.TemporaryDirectory() as folder:
            for command in ("fit", "simulate"):
                subprocess.run([howl, command, source + "/configs/r228.yaml", "--out", folder,
                                "--quiet"], check=True)
            spreads = write_family(folder)
            subprocess.run([howl, "report", folder, "--quiet"], check=True)
            test_load(driver, os.path.join(folder, "report.html"))
            page = Page(driver)
            test_summary(driver, folder, MEMBERS)
            test_rows(driver)
            test_zoom(driver)
            test_choose(page, spreads)
            test_growth(page, spreads)
            test_slider(page, spreads)
            test_experiment(page, spreads)
            test_nyquist(driver, page, spreads)
            test_drag(driver, page, spreads)
            test_hover(driver, page)
            test_appearance(driver)
            test_family_alone(driver, page, howl, source)
            messages = driver.get_log("browser")
            check(not messages, f"the console says {messages}")
            print("the page follows")
    finally:
        driver.quit()
    return 0


if __name__ == "__main__":
    sys.exit(main())
