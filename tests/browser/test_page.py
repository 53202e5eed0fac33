"""The page of a run in a real browser: it opens from disk, moves, zooms, escapes, and answers quickly.

A test of its own for every promise; the runs are short. All are skipped where there is no browser (`make browser`).
"""

import contextlib
from pathlib import Path

import pytest

import fairlead
from fairlead.analysis.statics.to_show import shown_besides
from fairlead.report import page
from tests.browser import __main__ as pictures
from tests.browser.browser import complaints, missing, opened, requests, settled, show, until

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(missing()), reason=missing()),
    pytest.mark.xdist_group("browser"),
]
MOST_MEMORY = 300e6
MOST_BYTES = 8e6
"""What a page may have, docs/report.md."""
MODELS = Path(__file__).resolve().parents[2] / "models"
SINGLE, MACHINES = MODELS / "single_parts", MODELS / "machines"
EVIL = "<script>document.title='hacked'</script>"


@pytest.fixture(scope="module")
def browser():
    with opened() as driver:
        yield driver


def made(folder: Path, name: str, **settings) -> Path:
    """The page of a bundled model that recorded what a page wants."""
    model = fairlead.load(name)
    shown_besides(model)
    with contextlib.suppress(fairlead.RunError):
        return page.write(model.run(out=folder / Path(name).stem, **settings))
    raise AssertionError(name)


@pytest.fixture(scope="module")
def bend(tmp_path_factory) -> Path:
    return made(tmp_path_factory.mktemp("bend"), "single_bend", stop=3.0)


def picture(browser) -> str:
    return browser.execute_script("return document.getElementById('stage').toDataURL()")


@pytest.mark.parametrize("name", ["single_bend", "belt", "winch_drive", "torsion", "hundred_blocks"])
@pytest.mark.parametrize("width", [400, 1440, 1920])
def test_a_page_opens_from_disk_without_a_complaint_or_a_request(browser, bend, tmp_path, name, width):
    file = bend if name == "single_bend" else made(tmp_path, name, stop=1.0)
    show(browser, file, width, dark=width == 1440)
    assert settled(browser) is None
    assert complaints(browser) == []
    assert requests(browser) == []
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width


def test_playing_moves_the_picture_and_the_time(browser, bend):
    show(browser, bend)
    browser.execute_script("fairlead.clock.set(0)")
    before = picture(browser)
    browser.execute_script("document.getElementById('play').click()")
    until(browser, lambda: picture(browser) != before)  # it goes on: the first frame may be less than a pixel away
    assert browser.execute_script("return fairlead.clock.t") > 0
    browser.execute_script("document.getElementById('play').click()")


def test_the_picture_of_a_scene_without_a_line_moves_as_well(browser, tmp_path):
    show(browser, made(tmp_path, "belt", stop=2.0))
    browser.execute_script("fairlead.clock.set(0)")
    before = picture(browser)
    browser.execute_script("fairlead.clock.set(0.3)")
    assert picture(browser) != before


def test_a_signal_is_picked_and_zoomed_into_by_dragging(browser, bend):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By

    show(browser, bend)
    settled(browser)
    panels = len(browser.find_elements(By.CLASS_NAME, "panel"))
    browser.find_element(By.ID, "pick").send_keys("line.hose_node[*].v")
    browser.find_element(By.ID, "add").click()
    until(browser, lambda: len(browser.find_elements(By.CLASS_NAME, "panel")) == panels + 1)
    settled(browser)
    plot = browser.find_element(By.CSS_SELECTOR, "#panels .panel > div:nth-child(2)")
    browser.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", plot)
    whole = browser.execute_script("return fairlead.span.end - fairlead.span.start")
    drag = ActionChains(browser).move_to_element_with_offset(plot, -200, 0).click_and_hold()
    drag.move_by_offset(150, 0).move_by_offset(50, 0).release().perform()
    span = "return fairlead.span.end - fairlead.span.start"
    until(browser, lambda: 0 < browser.execute_script(span) < whole / 2)
    browser.find_element(By.ID, "whole").click()
    until(browser, lambda: browser.execute_script(span) == pytest.approx(whole))


def test_the_keyboard_plays_and_steps(browser, bend):
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys

    show(browser, bend)
    browser.execute_script("fairlead.clock.set(1)")
    stage = browser.find_element(By.ID, "stage")
    stage.send_keys(Keys.ARROW_RIGHT)
    assert browser.execute_script("return fairlead.clock.t") > 1
    stage.send_keys(" ")
    assert browser.execute_script("return fairlead.clock.playing")


@pytest.fixture(scope="module")
def two_bends(tmp_path_factory) -> Path:
    runs = []
    for mu in ("0.35", "0.6"):
        model = fairlead.load("single_bend", set={"mu": mu})
        shown_besides(model)
        runs.append(model.run(out=tmp_path_factory.mktemp("bends") / mu, stop=3.0))
    return page.write(runs)


@pytest.mark.parametrize("section", ["energy", "slow", "zones"])
def test_a_link_lands_on_its_section_the_first_time(browser, two_bends, section):
    """Plots come into sight while the page scrolls smoothly, and push down what stands below them."""
    show(browser, two_bends)
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    browser.find_element("css selector", f"nav a[href='#{section}']").click()
    top = f"return document.getElementById('{section}').getBoundingClientRect().top"
    until(browser, lambda: abs(browser.execute_script(top)) < 40, times=8)  # it comes there, and stays


RESIZED = """
const t = fairlead.clock.t, off = [];
for (const bar of document.querySelectorAll(".cursor")) {
  const box = bar.closest(".layer").parentElement, canvas = box.querySelector("*").getBoundingClientRect();
  const at = bar.getBoundingClientRect().left;
  if (getComputedStyle(bar).display === "none" || !(at > canvas.left && at < canvas.right)) off.push(at);
}
return [document.querySelectorAll(".cursor").length, off.length, document.documentElement.scrollWidth];
"""


def test_the_line_of_time_stays_on_every_plot_when_the_window_becomes_narrow_or_wide(browser, two_bends):
    show(browser, two_bends, 1440)
    settled(browser)
    browser.execute_script("fairlead.clock.set(0.9 * fairlead.clock.end)")
    for width in (700, 500, 1200):
        size = {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        until(browser, lambda width=width: browser.execute_script(RESIZED)[1:] == [0, width], times=3)
        assert browser.execute_script(RESIZED)[0] > 5


def test_no_name_in_a_table_is_broken_on_a_narrow_page(browser, two_bends):
    show(browser, two_bends, 400)
    settled(browser)
    lines = (
        "return [...document.querySelectorAll('#slow tbody th')].filter(th => !th.textContent.includes(' '))"
        ".map(th => th.getClientRects()[0].height)"
    )
    heights = browser.execute_script(lines)
    assert len(heights) > 5
    assert max(heights) < 1.5 * min(heights)
    assert browser.execute_script("return document.documentElement.scrollWidth") <= 400


def test_names_that_are_markup_are_shown_as_text(browser, tmp_path):
    from tests.unit.test_report_page import SIGNALS, Result, RunDirectory

    scene = {
        "files": {"a.yaml": EVIL}, "set": {}, "parameters": {EVIL: EVIL}, "connections": [],
        "components": {EVIL: {"type": EVIL, "line": 1, "file": "a.yaml", "fixed": False, "parameters": {}}},
        "plots": [{"title": EVIL, "signals": [SIGNALS[1].name]}],
    }  # fmt: skip
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {"name": EVIL, "description": EVIL, "scene": scene})
    run.append([0.0, 1.0], [[0.0] * len(SIGNALS), [1.0] * len(SIGNALS)], [0, 0])
    run.event(0.5, EVIL, "held", EVIL, EVIL)
    run.finish("finished", {"sentence": EVIL})
    show(browser, page.write(Result.open(tmp_path / "run")))
    settled(browser)
    assert browser.title == EVIL
    assert EVIL in browser.execute_script("return document.body.innerText")
    assert complaints(browser) == []


def test_the_page_of_a_whole_route_stays_small_and_tells_how_soon_it_answers(browser, tmp_path):
    file = made(tmp_path, "guidance_route")
    assert file.stat().st_size < MOST_BYTES
    show(browser, file)
    settled(browser)
    took = browser.execute_script(
        "const took = []; for (let k = 0; k < 9; k++) { const t = performance.now();"
        "fairlead.clock.set(fairlead.clock.end * (k + 1) / 10); took.push(performance.now() - t); }"
        "for (let k = 0; k < 5; k++) { const t = performance.now(); fairlead.span.set(k, 10 + k);"
        "for (const tell of fairlead.span.heard) tell(); took.push(performance.now() - t); } return took"
    )
    print(f"ms after an input: {[round(one, 1) for one in took]}")
    browser.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
    memory = browser.execute_cdp_cmd("Runtime.getHeapUsage", {})
    print(f"heap: {memory['usedSize'] / 1e6:.0f} MB")
    assert memory["usedSize"] + memory.get("backingStorageSize", 0) < MOST_MEMORY


def test_zones_and_maps_of_several_runs_are_chosen_by_the_name_of_the_run(browser, tmp_path):
    runs = []
    for mu in (0.35, 0.6):
        model = fairlead.load("single_bend", set={"mu": mu})
        shown_besides(model)
        runs.append(model.run(out=tmp_path / str(mu), stop=3.0))
    show(browser, page.write(runs, tmp_path / "both.html"))
    assert settled(browser) is None
    choose = (
        "const list = document.getElementById(arguments[0]); list.value = arguments[1];"
        "list.dispatchEvent(new Event('change')); return list.options.length"
    )
    for select, drawing in (("zone-run", "zone-chart"), ("map-run", "map-list")):
        drawn = browser.find_element("id", drawing)
        first = drawn.screenshot_as_png
        assert browser.execute_script(choose, select, "1") == 2
        until(browser, lambda drawn=drawn, first=first: drawn.screenshot_as_png != first)
        browser.execute_script(choose, select, "0")
        until(browser, lambda drawn=drawn, first=first: drawn.screenshot_as_png == first)
    assert complaints(browser) == []


def test_a_page_with_one_run_offers_no_choice_of_runs(browser, bend):
    show(browser, bend)
    hidden = "return ['zone-run', 'map-run'].every(id => document.getElementById(id).closest('label').hidden)"
    assert browser.execute_script(hidden)


OWN = """
from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone


class Snubber(Component):
    \"\"\"A pad of one's own, engaged or not.\"\"\"

    a, b = Translational("one"), Translational("other")
    rate = Parameter("N/m", "Stiffness while engaged.", above=0)
    push = Output("N", "Force.")
    zones = Zones("aloof", "engaged")

    @zone("aloof")
    def aloof(p, a, b):
        \"\"\"Nothing.\"\"\"
        return Law(a=0.0, b=0.0, push=0.0)

    @zone("engaged")
    def engaged(p, a, b):
        \"\"\"A spring.\"\"\"
        force = p.rate * (b.x - a.x)
        return Law(a=-force, b=+force, push=force, stored=force * (b.x - a.x) / 2)

    @guard("aloof", to="engaged", unit="m")
    def meets(p, a, b):
        \"\"\"They meet.\"\"\"
        return b.x - a.x

    @guard("engaged", to="aloof", unit="m")
    def parts(p, a, b):
        \"\"\"They part.\"\"\"
        return a.x - b.x
"""
SCENE = """
schema: 1
name: own
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  catch: {type: Snubber, rate: 500 N/m}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
connections: [[wall.flange, spring.a, catch.a], [spring.b, catch.b, block.flange]]
run: {stop: 2 s}
"""


def test_a_class_of_ones_own_stands_in_signals_zone_chart_and_scene_without_more_work(browser, tmp_path):
    (tmp_path / "own.py").write_text(OWN, encoding="utf-8")
    (tmp_path / "own.yaml").write_text(SCENE, encoding="utf-8")
    model = fairlead.load(tmp_path / "own.yaml", libraries=[str(tmp_path / "own.py")])
    shown_besides(model)
    show(browser, page.write(model.run(out=tmp_path / "run")))
    assert settled(browser) is None
    assert "Snubber" in browser.execute_script("return document.getElementById('scene').textContent")
    legend = browser.execute_script("return document.getElementById('zone-legend').textContent")
    assert "aloof" in legend
    assert "engaged" in legend
    names = browser.execute_script("return [...document.getElementById('names').options].map(o => o.value)")
    assert "catch.push" in names
    assert "catch" in browser.execute_script("return document.getElementById('zone-of').textContent")
    assert complaints(browser) == []


def test_printed_the_page_has_its_verdict_and_no_buttons_and_every_control_has_a_name(browser, bend):
    show(browser, bend)
    assert settled(browser) is None
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    shown = "return getComputedStyle(document.querySelector(arguments[0])).display"
    try:
        assert browser.execute_script(shown, "nav") == "none"
        assert browser.execute_script(shown, ".player") == "none"
        assert browser.execute_script(shown, "#verdict") != "none"
        assert browser.execute_script("return getComputedStyle(document.body).color") == "rgb(0, 0, 0)"
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    tree = browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
    roles = ("button", "combobox", "slider", "checkbox", "textbox", "image", "link")
    nameless = [one["role"]["value"] for one in tree
                if not one.get("ignored") and one.get("role", {}).get("value") in roles
                and not one.get("name", {}).get("value")]  # fmt: skip
    assert nameless == []
    headings = [one for one in tree if one.get("role", {}).get("value") == "heading" and not one.get("ignored")]
    assert len(headings) >= 6


@pytest.mark.parametrize("dark", [False, True])
def test_on_paper_every_plot_is_a_picture_in_light_colours_and_afterwards_all_is_as_it_was(browser, bend, dark):
    """Nobody scrolled: what stands below is drawn all the same, and no plot is wider than paper."""
    from selenium.webdriver.support.ui import WebDriverWait

    show(browser, bend, dark=dark)
    WebDriverWait(browser, 60).until(lambda it: it.execute_script("return document.body.dataset.drawn === 'yes'"))
    look = (
        "const plots = [...views.keys()].filter(e => e.isConnected);"
        "return {plots: plots.length, pictures: document.querySelectorAll('.picture').length,"
        "width: Math.max(0, ...[...document.querySelectorAll('.picture')].map(p => p.naturalWidth)),"
        "hidden: plots.filter(e => e.classList.contains('screen')).length,"
        "ink: [...views.values()][0].model.below[0].axis_label_text_color, wide: plots[0].offsetWidth,"
        "open: document.querySelectorAll('details[open]').length}"
    )
    before = browser.execute_script(look)
    assert before["plots"] > 6
    assert before["pictures"] == 0
    browser.execute_script("dispatchEvent(new Event('beforeprint'))")
    browser.execute_async_script(
        "const done = arguments[0]; Promise.all([...document.images].map(i => i.decode().catch(() => 0))).then(done)"
    )
    printed = browser.execute_script(look)
    assert printed["pictures"] == printed["plots"] + 1  # and the moving picture
    assert printed["hidden"] == printed["plots"]
    assert 0 < printed["width"] <= 800
    assert printed["ink"] == "#000"
    assert printed["open"] > before["open"]
    browser.execute_script("dispatchEvent(new Event('afterprint'))")
    until(browser, lambda: browser.execute_script(look) == before)
    assert len(browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"]) > 100_000
    until(browser, lambda: browser.execute_script(look) == before)
    assert complaints(browser) == []


def told_under_the_pointer(browser, plot, across=0.5, up=0.5) -> str:
    """What the box beside the pointer says at a share of a plot's frame."""
    return browser.execute_async_script(
        "const [plot, u, v, done] = arguments; plot.scrollIntoView({block: 'center', behavior: 'instant'});"
        "setTimeout(() => { const r = plot.getBoundingClientRect();"
        "const at = {clientX: r.left + u * r.width, clientY: r.top + (1 - v) * r.height};"
        "plot.dispatchEvent(new PointerEvent('pointermove', at));"
        "const tip = plot.querySelector('.tip'); done(tip && !tip.hidden ? tip.innerText : ''); }, 300)",
        plot, across, up,
    )  # fmt: skip


def test_of_many_elements_a_few_are_drawn_and_others_are_picked(browser, two_bends):
    """Sixty lines of one colour tell nothing: ends, middle and extremes over a band that holds all."""
    show(browser, two_bends)
    assert settled(browser) is None
    drawn = "return fairlead.page.panels.map(p => p.curves.length)"
    title = "return fairlead.page.panels.map(p => p.title)"
    hose = browser.execute_script(title).index("Hose tension")
    few = browser.execute_script(drawn)[hose]
    assert 3 <= few <= 2 * 5
    panel = browser.find_elements("css selector", "#panels .panel")[hose]
    assert "below -160 N the hose rucks" in panel.text
    legend = panel.find_elements("css selector", ".legend > li")
    assert [one.text.split("\n")[0] for one in legend[:2]] == [
        "line.hose[*].tension, mu = 0.35", "line.hose[*].tension, mu = 0.6",
    ]  # fmt: skip
    assert all("[0] first" in one.text and "all 60 lie in here" in one.text for one in legend[:2])
    assert len(legend) <= 5  # a line a run, then the marks
    choose = (
        "const [panel, value] = arguments, list = panel.querySelector('select'); list.value = value;"
        "list.dispatchEvent(new Event('change'))"
    )
    browser.execute_script(choose, panel, "17")
    until(browser, lambda: browser.execute_script(drawn)[hose] == few + 2)  # of either run
    until(browser, lambda: panel.text.count("[17] picked") == 2)
    browser.execute_script(choose, panel, "all")
    until(browser, lambda: browser.execute_script(drawn)[hose] == 2 * 60)
    assert complaints(browser) == []


def test_the_band_of_a_family_holds_every_recorded_value(browser, bend):
    show(browser, bend)
    assert settled(browser) is None
    outside = browser.execute_async_script(
        "const done = arguments[0], run = fairlead.page.runs[0]; let bad = 0;"
        "(async () => { for (const panel of fairlead.page.panels) for (const band of panel.bands) {"
        "  const all = await run.values(band.name), d = band.source.data; const t = run.times;"
        "  all.first.forEach(v => d.x.forEach((x, k) => { const next = k + 1 < d.x.length ? d.x[k + 1] : Infinity;"
        "    for (let i = t.indexOf(x); i >= 0 && i < t.length && t[i] < next; i++)"
        "      if (v[i] < d.y1[k] - 1e-6 || v[i] > d.y2[k] + 1e-6) bad++; })); } done(bad); })()"
    )
    assert outside == 0


def test_zones_of_many_alike_contacts_are_a_map_that_tells_what_is_under_the_pointer(browser, bend):
    show(browser, bend)
    assert settled(browser) is None
    titles = browser.execute_script("return [...document.querySelectorAll('#zone-chart b')].map(b => b.textContent)")
    assert any(title.startswith("line.inner[*] (core on hose)") for title in titles)
    assert any(title.startswith("line.outer[*] (line on its devices)") for title in titles)
    plots = browser.find_elements("css selector", "#zone-chart .panel > div")
    told = told_under_the_pointer(browser, plots[0])
    assert "line.outer[" in told
    assert " long" in told
    assert "held: sticks" in browser.find_element("id", "zone-legend").text
    assert complaints(browser) == []


def test_a_signal_tells_its_name_and_value_under_the_pointer(browser, bend):
    show(browser, bend)
    assert settled(browser) is None
    plots = browser.find_elements("css selector", "#panels .panel > div:nth-child(2)")
    said = [told_under_the_pointer(browser, plots[-1], 0.5, share / 40) for share in range(6, 38)]
    assert any("haul.force" in one and " N at " in one for one in said)


def test_single_parts_keep_a_row_each(browser, tmp_path):
    show(browser, made(tmp_path, "winch_drive", stop=1.0))
    assert settled(browser) is None
    assert browser.find_elements("css selector", "#zone-chart b") == []
    rows = browser.execute_script(
        "return [...views].find(([e]) => e.closest('#zone-chart'))[1].model.left[0].ticker.ticks.length"
    )
    assert rows == 2


def chained(parts: int) -> str:
    """A netlist of bodies in a row, each held to the next by a spring."""
    lines = ["schema: 1", "name: chain", "components:", "  wall: {type: Ground}"]
    for k in range(parts):
        lines += [f"  spring_{k}: {{type: Spring, stiffness: 1 kN/m}}",
                  f"  body_{k}: {{type: Mass, mass: 1 kg, velocity: {k} mm/s}}"]  # fmt: skip
    lines += ["connections:", "  - [wall.flange, spring_0.a]"]
    for k in range(parts):
        more = f", spring_{k + 1}.a" if k + 1 < parts else ""
        lines.append(f"  - [spring_{k}.b, body_{k}.flange{more}]")
    return "\n".join([*lines, "run: {stop: 100 ms}", ""])


def test_a_long_chain_of_parts_is_broken_into_rows_that_can_be_read(browser, tmp_path):
    (tmp_path / "chain.yaml").write_text(chained(20), encoding="utf-8")
    model = fairlead.load(tmp_path / "chain.yaml")
    shown_besides(model)
    show(browser, page.write(model.run(out=tmp_path / "run")), 1440)
    larger, apart, inside = browser.execute_script(
        "const v = fairlead.page.view, all = v.m.boxes, at = all.map(b => v.at(b.cx, b.cy)), z = v.zoom;"
        "const near = (i, j, axis, size) =>"
        "  Math.abs(at[i][axis] - at[j][axis]) < z * (all[i][size] + all[j][size]) / 2 - 1;"
        "const over = all.some((_, i) => all.some((_, j) => j > i && near(i, j, 0, 'w') && near(i, j, 1, 'h')));"
        "const out = at.some(([x, y]) => x < 0 || x > v.width || y < 0 || y > v.height), xs = all.map(b => b.cx);"
        "return [z / ((v.width - 70) / (Math.max(...xs) - Math.min(...xs))), !over, !out]"
    )
    assert larger > 1.3  # than all in one row
    assert apart
    assert inside
    assert complaints(browser) == []


def fan(parts: int) -> str:
    """A netlist of so many blocks with long names, each on a pad of its own, on one shaking table."""
    lines = ["schema: 1", "name: fan", "components:", "  wall: {type: Ground}",
             "  table: {type: MotionSource, velocity: {sine: {amplitude: 0.3 m/s, frequency: 3 Hz}}}"]  # fmt: skip
    joined = ["connections:"]
    for k in range(parts):
        lines += [f"  block_with_a_rather_long_name_{k}: {{type: Mass, mass: 1 kg}}",
                  f"  spring_{k}: {{type: Spring, stiffness: 300 N/m}}",
                  f"  clamped_pad_with_a_long_name_{k}: {{type: Contact, normal_force: {2 + k} N, "
                  "curve: {curve: coulomb, stiction: 0.8, coulomb: 0.5}}"]  # fmt: skip
        joined += [f"  - [wall.flange, spring_{k}.a]",
                   f"  - [spring_{k}.b, block_with_a_rather_long_name_{k}.flange, clamped_pad_with_a_long_name_{k}.b]",
                   f"  - [table.flange, clamped_pad_with_a_long_name_{k}.a]"]  # fmt: skip
    return "\n".join([*lines, *joined, "run: {stop: 1 s}", "record: {every: 5 ms}", ""])


@pytest.mark.parametrize("width", [400, 1440])
@pytest.mark.parametrize("written", [fan(30), chained(20)])
def test_parts_that_would_be_too_small_to_read_are_tiles_and_none_is_left_out(browser, tmp_path, written, width):
    (tmp_path / "many.yaml").write_text(written, encoding="utf-8")
    model = fairlead.load(tmp_path / "many.yaml")
    shown_besides(model)
    result = model.run(out=tmp_path / "run")
    show(browser, page.write(result), width)
    tiles, zoom, inside = browser.execute_script(
        "const v = fairlead.page.view; return [v.tiles && v.tiles.list.map(b => b.name), v.zoom,"
        " !v.tiles || v.tiles.columns * v.tiles.wide <= v.width && v.tiles.high <= v.height]"
    )
    assert inside
    assert tiles or zoom > 0.5
    if tiles:
        assert {event.component.partition(".")[0] for event in result.events} <= set(tiles)
        assert "too many to draw as they are wired" in browser.find_element("id", "scale").text
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width
    assert complaints(browser) == []


@pytest.mark.parametrize("width", [400, 1440])
def test_no_wire_of_a_small_scene_goes_through_a_box_at_any_width(browser, tmp_path, width):
    show(browser, made(tmp_path, "belt", stop=1.0), width)
    rows = browser.execute_script(
        "const v = fairlead.page.view, axis = v.down ? 1 : 0, at = b => v.at(b.cx, b.cy)[axis];"
        "return v.m.wires.flatMap(w => w.ends.map(e => Math.sign(v.m.boxes[e.box].cx - w.cx)"
        " === Math.sign(at(v.m.boxes[e.box]) - at(w))))"
    )
    assert all(rows)  # what is joined stays on its side: nothing goes back over the picture to another row
    over = browser.execute_script(
        "const v = fairlead.page.view, at = v.m.boxes.map(b => v.at(b.cx, b.cy)), z = v.zoom, all = v.m.boxes;"
        "return all.some((a, i) => all.some((b, j) => j > i && Math.abs(at[i][0] - at[j][0]) < z * (a.w + b.w) / 2"
        " && Math.abs(at[i][1] - at[j][1]) < z * (a.h + b.h) / 2))"
    )
    assert not over


def test_a_state_machine_shows_its_state_and_not_a_comparator(browser, tmp_path):
    show(browser, made(tmp_path, str(SINGLE / "state_machine.yaml")), 1440)
    browser.execute_script("fairlead.clock.set(4)")
    assert "filler is filling" in browser.find_element("id", "state").text


def test_pressures_stand_on_their_axis_in_megapascals_and_time_axes_above_each_other(browser, tmp_path):
    show(browser, made(tmp_path, str(MACHINES / "lowering_winch.yaml"), stop=2.0), 1440)
    assert settled(browser) is None
    labels, left = browser.execute_script(
        "const all = [...views].filter(([e]) => e.closest('#panels')).map(([, v]) => v);"
        "return [all.map(v => v.model.left[0].axis_label), all.map(v => Math.round(v.frame.bbox.left))]"
    )
    assert "pressure [MPa]" in labels
    assert len(set(left)) == 1
    assert complaints(browser) == []


def test_the_menu_of_a_scene_without_maps_names_none(browser, tmp_path):
    show(browser, made(tmp_path, "belt", stop=1.0), 1440)
    shown = "return [...document.querySelectorAll('nav a')].filter(a => a.offsetWidth).map(a => a.hash)"
    hidden = "return [...document.querySelectorAll('main > section')].filter(s => !s.offsetHeight).map(s => '#' + s.id)"
    assert not {*browser.execute_script(shown)} & {*browser.execute_script(hidden)}


def test_a_picture_that_cannot_be_taken_is_told_and_the_others_are_taken(tmp_path, monkeypatch, capsys):
    bad = pictures.Picture("bad.png", "belt", {"run.max_steps": 5}, 0.1, False, 500)
    good = pictures.Picture("good.png", "belt", {"run.stop": "1 s"}, 0.5, True, 500)
    monkeypatch.setattr(pictures, "PICTURES", (bad, good))
    monkeypatch.setattr(pictures, "FIGURES", tmp_path)
    assert pictures.main([]) == 1
    told = capsys.readouterr()
    assert "bad.png was not taken, the old one stays: belt: budget" in told.err
    assert told.out.splitlines()[:2] == ["bad.png: running belt ...", "good.png: running belt ..."]
    assert [file.name for file in tmp_path.iterdir()] == ["good.png"]
    assert pictures.main(["good.png"]) == 0
