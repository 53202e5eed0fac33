"""What a reader who has never seen the page does with it: compares two runs of a bend, asks, plays, prints.

All are skipped where there is no browser (`make browser`).
"""

from pathlib import Path

import pytest

import fairlead
from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.statics.to_show import shown_besides
from fairlead.report import page
from tests.browser.browser import complaints, missing, opened, settled, show, until

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(missing()), reason=missing()),
    pytest.mark.xdist_group("browser"),
]


@pytest.fixture(scope="module")
def browser():
    with opened() as driver:
        yield driver


@pytest.fixture(scope="module")
def both(tmp_path_factory) -> Path:
    """The bend that rucks, also outboard of the bend from 13.5 s, beside the one that does not."""
    runs = []
    for mu in ("0.6", "0.35"):
        model = fairlead.load("single_bend", set={"mu": mu})
        shown_besides(model)
        result = model.run(out=tmp_path_factory.mktemp("both") / mu, stop=15.0)
        result.run |= {"ruck": verdicts(result), "against_statics": against_statics(model.flat, result)}
        runs.append(result)
    return page.write(runs)


def texts(browser, which: str) -> list[str]:
    return browser.execute_script(f"return [...document.querySelectorAll('{which}')].map(one => one.textContent)")


def test_a_map_shows_all_places_that_ruck_says_what_it_cuts_off_and_shows_the_whole_line_on_demand(browser, both):
    show(browser, both)
    assert settled(browser) is None
    top = "return Math.max(...[...views].filter(([e]) => e.closest('#map-list')).map(([, v]) => v.frame.y_range.end))"
    assert browser.execute_script(top) > 12
    assert all(" of the route; during the run the line lies from " in one for one in texts(browser, "#map-list .small"))
    for which, notes in (("map-whole", "#map-list .small"), ("zone-whole", "#zone-chart .small")):
        browser.execute_script("document.getElementById(arguments[0]).click()", which)
        until(browser, lambda notes=notes: (found := texts(browser, notes))
              and not any("during the run the line lies" in one for one in found))  # fmt: skip
    assert complaints(browser) == []


@pytest.mark.parametrize("width", [1440, 1920])
def test_every_word_of_the_glossary_stands_beside_its_own_meaning(browser, both, width):
    show(browser, both, width)
    browser.execute_script("document.getElementById('words').open = true")
    off = browser.execute_script(
        "return [...document.querySelectorAll('#words dt')].filter(dt => { const a = dt.getBoundingClientRect(),"
        "b = dt.nextElementSibling.getBoundingClientRect(); return Math.abs(a.top - b.top) > 2 || a.right > b.left; })"
        ".map(dt => dt.textContent)"
    )
    assert off == []


def turned(dash: str) -> tuple[tuple[int, ...], ...]:
    """A dash from all its begins: what a reader cannot tell apart is alike here."""
    lengths = tuple(map(int, dash.split())) if dash != "solid" else ()
    return tuple(sorted(lengths[k:] + lengths[:k] for k in range(0, len(lengths), 2)))


def test_curves_of_one_colour_have_dashes_that_differ_and_the_legend_shows_them(browser, both):
    show(browser, both)
    assert settled(browser) is None
    curves = browser.execute_script(
        "return fairlead.page.panels.map(p => p.curves.map(c => [c.name + c.run.label, c.colour, c.dash]))"
    )
    swatches = browser.execute_script(
        "return fairlead.page.panels.map(p => [...p.box.querySelectorAll('.swatch[width=\"52\"] path')]"
        ".map(s => [s.getAttribute('stroke'), s.getAttribute('stroke-dasharray')]))"
    )
    for drawn, shown in zip(curves, swatches, strict=True):
        looks = [(name, colour, turned(dash)) for name, colour, dash in drawn]
        assert len(set(looks)) == len(looks)
        for _, colour, dash in drawn:
            assert [colour, "none" if dash == "solid" else dash] in shown


def test_the_line_of_time_is_in_the_legend_and_has_another_colour_than_the_first_ruck(browser, both):
    show(browser, both)
    assert settled(browser) is None
    for legend in texts(browser, "#panels .legend"):
        assert "time of the picture" in legend
    line, ruck = browser.execute_script(
        "const probe = document.createElement('i'); probe.style.color = css('ruck'); document.body.append(probe);"
        "return [getComputedStyle(document.querySelector('.cursor')).borderLeftColor, getComputedStyle(probe).color]"
    )
    assert line != ruck


def test_whatever_is_typed_as_a_signal_gets_an_answer_beside_the_field(browser, both):
    show(browser, both)
    assert settled(browser) is None
    drawn = "return fairlead.page.panels.length"
    panels = browser.execute_script(drawn)

    def ask(text: str) -> str:
        browser.execute_script(
            "const p = document.getElementById('pick'); p.value = arguments[0]; p.dispatchEvent(new Event('input'));"
            "document.getElementById('add').click()", text,
        )  # fmt: skip
        until(browser, lambda: (said := texts(browser, "#picked")[0]) and "being drawn" not in said)
        return texts(browser, "#picked")[0]

    assert ask("foo").startswith('No recorded signal has "foo" in its name.')
    assert "has no element 99: those recorded go from 0 to 59" in ask("line.hose[99].tension")
    assert "names contain \"tension\": " in ask("tension")
    assert browser.execute_script(drawn) == panels
    assert ask("line.hose[33].tension") == "line.hose[33].tension is the first plot below."
    first = "return document.querySelector('#panels .panel')"
    labels = "return fairlead.page.panels.at(-1).curves.map(c => c.label)"
    assert browser.execute_script(labels) == ["line.hose[33].tension, mu = 0.6", "line.hose[33].tension, mu = 0.35"]
    assert "line.hose[33].tension" in browser.execute_script(f"{first}.textContent")
    assert ask("haul.f").startswith("haul.force is the first")
    offers = "const p = document.getElementById('pick'); p.value = 'line.core[1'; p.dispatchEvent(new Event('input'));"
    browser.execute_script(offers)
    assert "line.core[12].tension" in browser.execute_script("return [...$('names').options].map(o => o.value)")
    assert complaints(browser) == []


def test_clock_and_sentence_tell_one_time_while_the_picture_plays(browser, both):
    show(browser, both)
    told = browser.execute_async_script(
        "const done = arguments[0], seen = []; document.getElementById('play').click();"
        "const look = () => { seen.push([$('now').textContent, $('state').textContent]);"
        "if (seen.length < 30) requestAnimationFrame(look); else { $('play').click(); done(seen); } };"
        "requestAnimationFrame(look)"
    )
    assert len({now for now, _ in told}) > 5
    assert all(state.startswith(f"At {now}: ") for now, state in told)


def test_a_time_on_the_grid_of_the_record_shows_that_row_and_instants_of_the_verdict_are_reached(browser, both):
    show(browser, both)
    for t in (0.29, 1.1, 12.34, 14.99):  # sums of 10 ms are not these
        browser.execute_script("fairlead.clock.set(arguments[0])", t)
        assert f"recorded at {t:.3f} s" in texts(browser, "#state")[0]
    rucks = browser.execute_script("return fairlead.page.runs[0].rucks[0]")
    assert texts(browser, "#instants button") == ["first ruck", "most compressed"]
    for k, t in enumerate((rucks["t"], rucks["most"]["t"])):
        browser.find_elements("css selector", "#instants button")[k].click()
        assert browser.execute_script("return fairlead.clock.t") == t


def test_the_picture_has_a_scale_with_its_unit_and_says_that_another_run_has_another(browser, both):
    show(browser, both)
    bar = browser.find_element("id", "bar")
    assert "line.hose[*].tension [N]" in bar.text
    values = [float(one) for one in texts(browser, "#bar .strip span")]
    assert len(values) > 2
    assert min(values) < 0 < max(values)
    assert "The scale is that of mu = 0.6. That of mu = 0.35 goes from " in texts(browser, "#scale")[0]
    browser.find_element("id", "same").click()
    until(browser, lambda: "one colour means two values" not in texts(browser, "#scale")[0])
    assert complaints(browser) == []


def test_the_wheel_scrolls_the_page_also_after_a_click_in_a_plot_and_zooms_with_ctrl(browser, both):
    from selenium.webdriver.common.action_chains import ActionChains

    show(browser, both)
    assert settled(browser) is None
    plot = browser.find_element("css selector", "#panels .panel > div:nth-child(2)")
    browser.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", plot)
    ActionChains(browser).move_to_element(plot).click().perform()
    middle = "const r = arguments[0].getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]"
    x, y = browser.execute_script(middle, plot)
    seen = "return [scrollY, fairlead.span.end - fairlead.span.start]"
    scrolled, whole = browser.execute_script(seen)

    def wheel(modifiers: int) -> None:
        turn = {"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": -60, "modifiers": modifiers}
        browser.execute_cdp_cmd("Input.dispatchMouseEvent", turn)

    ctrl = 2
    wheel(ctrl)
    until(browser, lambda: browser.execute_script(seen)[1] < whole)
    assert browser.execute_script(seen)[0] == scrolled
    left = browser.execute_script(seen)[1]
    wheel(0)
    until(browser, lambda: browser.execute_script(seen)[0] < scrolled)
    assert browser.execute_script(seen)[1] == left


def test_the_menu_has_the_words_of_the_headings_and_a_netlist_of_two_runs_stands_once(browser, both):
    show(browser, both)
    menu = browser.execute_script("return [...document.querySelectorAll('nav a')].map(a => [a.textContent, a.hash])")
    for word, link in menu:
        assert texts(browser, f"{link} > h2") == [word]
    assert len(browser.find_elements("css selector", "pre.netlist")) == 1
    assert "The netlist is that of single_bend (mu = 0.6), above." in texts(browser, "#scene")[0]
    settings = texts(browser, "#settings tr")
    for name in ("fairlead", "python", "numpy", "scipy"):
        assert sum(one.startswith(f"version of {name}") for one in settings) == 2


def test_ends_of_a_span_have_the_digits_of_its_length_and_bars_no_exponents(browser, both):
    show(browser, both)
    said = browser.execute_script("return spell(18.12345678, 18.22027678)")
    assert said == "18.1235 s to 18.2203 s, 0.09682 s long"
    bar = browser.execute_script("return scaled(ticks(-5e-4, 5e-4), 'm')")
    assert bar["unit"] == "\u00b5m"
    assert [text for _, text in bar["texts"]] == ["-400", "-200", "0", "200", "400"]
    plain = browser.execute_script("return scaled(ticks(-205, 490), 'N')")
    assert plain["unit"] == "N"
    assert [text for _, text in plain["texts"]] == ["-200", "-100", "0", "100", "200", "300", "400"]


def test_on_paper_picture_zones_and_maps_name_their_run_and_settings_are_there(browser, both):
    show(browser, both)
    until(browser, lambda: browser.execute_script("return document.body.dataset.drawn === 'yes'"))
    for which in ("which", "zone-run", "map-run"):
        browser.execute_script(
            "const list = $(arguments[0]); list.value = 1; list.dispatchEvent(new Event('change'))", which
        )
    named = [f"#{one}" for one in ("picture-of", "zone-run-name", "map-run-name")]
    until(browser, lambda: [texts(browser, one) for one in named] == 3 * [["Run: single_bend (mu = 0.35)"]])
    assert settled(browser) is None
    browser.execute_script("dispatchEvent(new Event('beforeprint'))")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        for one in named:
            assert browser.find_element("css selector", one).is_displayed()
        assert "version of fairlead" in browser.find_element("id", "settings").text
        rule = "return [...new Set([...document.querySelectorAll('tr')].map(e => getComputedStyle(e).breakInside))]"
        assert browser.execute_script(rule) == ["avoid"]
        rule = rule.replace("'tr'", "'h2, h3'").replace("breakInside", "breakAfter")
        assert browser.execute_script(rule) == ["avoid"]
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        browser.execute_script("dispatchEvent(new Event('afterprint'))")


def test_no_title_of_a_plot_is_broken_within_a_word_on_a_narrow_page(browser, both):
    show(browser, both, 400)
    assert settled(browser) is None
    heights = browser.execute_script(
        "return [...document.querySelectorAll('#panels .head b')].map(b => b.getBoundingClientRect().height)"
    )
    assert len(heights) > 3
    assert max(heights) < 30  # one line
    assert browser.execute_script("return document.documentElement.scrollWidth") <= 400
