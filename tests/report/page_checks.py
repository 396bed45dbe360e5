"""What browser_test.py asks of the page around the family browser: rows of figures, summary, enlarging."""
import json
import os
import re


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def test_rows(driver):
    """No row of figures is half empty: two stand in a row, or one takes all of it."""
    rows = driver.execute_script("""
        const rows = {};
        for (const f of document.querySelectorAll('section > figure')) {
          const box = f.getBoundingClientRect();
          const key = f.parentElement.id + ' ' + Math.round(box.top);
          (rows[key] = rows[key] || []).push(box.width);
        }
        const whole = document.querySelector('main').getBoundingClientRect().width;
        return [whole, rows];""")
    for place, widths in rows[1].items():
        check(sum(widths) > 0.9 * rows[0], f"the row at {place} fills {widths} of {rows[0]}")


def test_summary(driver, folder, members):
    """The summary says what the files say."""
    with open(os.path.join(folder, "solution.json"), encoding="utf-8") as file:
        solution = json.load(file)
    text = driver.execute_script("return document.querySelector('#summary').innerText")
    check("All 6 experiments (phi 0.45 to 0.56) show a limit cycle, at 180 to 220 Hz" in text,
          f"the summary does not say what table 2 has: {text}")
    delays = [1e3 * each["tau_s"] for each in solution["experiments"]]
    said = re.search(r"a delay of ([\d.]+) to ([\d.]+) ms", text)
    check(said and abs(float(said.group(1)) - min(delays)) < 0.0051
          and abs(float(said.group(2)) - max(delays)) < 0.0051,
          f"the summary's delay is {said and said.groups()}, the fit has {min(delays)} to {max(delays)}")
    check(f"{members} models that the data cannot reject are listed" in text, f"the family: {text}")
    first = driver.execute_script("return document.querySelector('main').firstElementChild.id")
    check(first == "summary", f"the page begins with {first}")


def view_box(driver):
    return [float(x) for x in driver.execute_script(
        "return document.querySelector('#zoom svg').getAttribute('viewBox')").split()]


def test_zoom(driver):
    """A figure enlarges by click and by keyboard; wheel, drag and keys zoom and move it."""
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    drawing = driver.find_element("css selector", "#figure-delay .drawing")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", drawing)
    is_open = "return document.querySelector('#zoom').open"
    small = drawing.size["width"]
    drawing.click()
    check(driver.execute_script(is_open), "a click does not enlarge a figure")
    title = driver.execute_script("return document.querySelector('#zoom-title').textContent")
    check(title.startswith("Delay"), f"the enlarged figure is called {title!r}")
    stage = driver.find_element("css selector", "#zoom .drawing")
    check(stage.size["width"] > 1.3 * small, f"enlarged from {small} to {stage.size['width']}")
    whole = view_box(driver)
    # The point under the pointer stays where it is.
    dx, dy = stage.size["width"] // 4, -stage.size["height"] // 5
    about = [whole[0] + whole[2] * 0.75, whole[1] + whole[3] * 0.3]
    ActionChains(driver).scroll_from_origin(ScrollOrigin.from_element(stage, dx, dy), 0, -200).perform()
    after = view_box(driver)
    check(after[2] < 0.9 * whole[2], f"the wheel does not zoom: {whole} to {after}")
    for k in (0, 1):
        share = (about[k] - after[k]) / after[k + 2]
        expected = (about[k] - whole[k]) / whole[k + 2]
        check(abs(share - expected) < 0.02, f"the point under the pointer moved to {share}")
    drag = ActionChains(driver, duration=60)
    drag.move_to_element(stage).click_and_hold().move_by_offset(60, 0).release().perform()
    dragged = view_box(driver)
    check(dragged[0] < after[0] - 1 and dragged[2] == after[2], f"dragging: {after} to {dragged}")
    stage.send_keys("0")
    check(view_box(driver) == whole, "0 does not show all of it")
    stage.send_keys("+")
    check(abs(view_box(driver)[2] * 1.25 - whole[2]) < 1e-6 * whole[2], "+ does not zoom")
    before = view_box(driver)
    stage.send_keys(Keys.ARROW_RIGHT)
    check(view_box(driver)[0] > before[0], "the arrow does not move it")
    for _ in range(30):
        stage.send_keys("-")
    check(view_box(driver) == whole, "zooming out goes beyond the figure")
    driver.find_element("css selector", "#zoom [data-zoom='in']").click()
    check(view_box(driver)[2] < whole[2], "the button does not zoom")
    stage.send_keys(Keys.ESCAPE)
    check(not driver.execute_script(is_open), "Escape does not close it")
    driver.execute_script("arguments[0].focus()", drawing)
    drawing.send_keys(Keys.ENTER)
    check(driver.execute_script(is_open), "Enter does not enlarge a figure")
    driver.find_element("css selector", "#zoom [data-zoom='close']").click()
    check(not driver.execute_script(is_open), "the button does not close it")
    check(driver.execute_script("return document.querySelectorAll('#zoom svg').length") == 0,
          "the closed figure stays in the page")
