"""`fairlead view` in a real browser: a mistake is told at its line, mended, and the run is shown.

All are skipped where there is no browser (`make browser`).
"""

import threading
from pathlib import Path

import pytest

import fairlead
from fairlead.view import View
from tests.browser.browser import complaints, missing, opened, until

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(missing()), reason=missing()),
    pytest.mark.xdist_group("browser"),
]
BELT = (Path(fairlead.__file__).parents[2] / "models" / "belt.yaml").read_text(encoding="utf-8")
LINE = BELT[: BELT.index("stiffness")].count("\n") + 1


@pytest.fixture(scope="module")
def browser():
    with opened() as driver:
        yield driver


@pytest.fixture
def view(tmp_path: Path):
    file = tmp_path / "belt.yaml"
    file.write_text(BELT.replace("stop: 40 s", "stop: 2 s"), encoding="utf-8")
    made = View(str(file))
    threading.Thread(target=made.serve, daemon=True).start()
    yield made
    made._server.shutdown()
    made.close()


def show(browser, view: View, width: int = 1440) -> None:
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    browser.get(view.address)
    until(browser, lambda: browser.execute_script("return document.body.dataset.checked === 'yes'"))


def messages(browser) -> list[str]:
    return texts(browser, "#messages button")


def marked(browser) -> list[str]:
    return texts(browser, "#lines .bad")


def texts(browser, which: str) -> list[str]:
    return browser.execute_script(f"return [...document.querySelectorAll('{which}')].map(one => one.textContent)")


def cursor_behind(browser, words: str) -> None:
    browser.execute_script(
        "const area = document.getElementById('text'), at = area.value.indexOf(arguments[0]) + arguments[0].length;"
        "area.focus(); area.setSelectionRange(at, at);", words,
    )  # fmt: skip


@pytest.mark.parametrize("width", [400, 1440, 1920])
def test_a_mistake_is_told_at_its_line_and_the_mended_netlist_runs_on_a_key(browser, view, width):
    from selenium.webdriver.common.keys import Keys

    show(browser, view, width)
    assert messages(browser) == []
    area = browser.find_element("id", "text")
    cursor_behind(browser, "stiffness")
    area.send_keys(Keys.BACKSPACE)
    until(browser, lambda: len(messages(browser)) == 1)
    assert f":{LINE}:" in messages(browser)[0]
    assert "Did you mean stiffness" in messages(browser)[0]
    assert marked(browser) == [str(LINE)]
    area.send_keys("s")
    until(browser, lambda: messages(browser) == [] and marked(browser) == [])
    area.send_keys(Keys.ESCAPE)
    area.send_keys(Keys.CONTROL, Keys.ENTER)
    until(browser, lambda: browser.execute_script("return document.body.dataset.run === '1'"))
    browser.switch_to.frame("page")
    until(browser, lambda: browser.execute_script("return document.body.dataset.ready === 'yes'"))
    assert "Finished" in browser.find_element("id", "verdict").text
    assert browser.execute_script("return document.getElementById('stage').width") > 100
    browser.switch_to.default_content()
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width
    assert complaints(browser) == []
    assert "stop: 2 s" in view.draft.file.read_text(encoding="utf-8")


def test_what_may_stand_at_the_cursor_is_chosen_by_key_and_saved_by_key(browser, view):
    from selenium.webdriver.common.keys import Keys

    show(browser, view)
    area = browser.find_element("id", "text")
    cursor_behind(browser, "type: Spring")
    area.send_keys(", ")
    area.send_keys(Keys.CONTROL, Keys.SPACE)
    until(browser, lambda: browser.execute_script("return !document.getElementById('offers').hidden"))
    chosen = "return document.getElementById(document.getElementById('text').getAttribute('aria-activedescendant'))"
    while not browser.execute_script(f"{chosen}.dataset.text").startswith("free_length"):
        area.send_keys(Keys.ARROW_DOWN)
    area.send_keys(Keys.ENTER)
    area.send_keys("0.5 m")
    until(browser, lambda: browser.execute_script("return document.body.dataset.checked === 'yes'"))
    assert messages(browser) == []
    assert "free_length" not in view.draft.file.read_text(encoding="utf-8")
    area.send_keys(Keys.ESCAPE)
    area.send_keys(Keys.CONTROL, "s")
    until(browser, lambda: "free_length: 0.5 m" in view.draft.file.read_text(encoding="utf-8"))
