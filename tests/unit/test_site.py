"""The site: every page has its place, links lead somewhere, what pages show works, and a build has no remark.

The build itself takes half a minute and is slow. It runs the notebook, so a cell that fails stops it.
"""

import ast
import html.parser
import importlib
import importlib.util
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import urllib.parse
from typing import Any

import filelock
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.registry import known_types
from fairlead.describe.catalogue import innards
from tests.browser.browser import complaints, missing, opened, requests, until

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
EXAMPLES = sorted((ROOT / "models" / "single_parts").glob("*.yaml"))
NOTEBOOK = DOCS / "tutorial" / "notebook.ipynb"
BUILT = ("generated", "_site", "jupyter_execute")
PATIENCE = 1500  # s
FENCE = re.compile(r"^(?:<!-- file: (\S+) -->\n)?```(\w*)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)


def pages() -> list[pathlib.Path]:
    """Pages that people wrote, and those about treatments."""
    return [page for page in sorted(DOCS.rglob("*.md")) if page.relative_to(DOCS).parts[0] not in BUILT]


def anchors(page: pathlib.Path) -> set[str]:
    """Names of the headings of a page, as the site and the usual hosts make them."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    titles = re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)
    named = re.findall(r"^\((\S+)\)=$", text, flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-") for title in titles} | set(named)


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(DOCS)))
def test_links_of_a_page_lead_somewhere(page: pathlib.Path) -> None:
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", text)):
        if target.startswith(("http:", "https:")):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if "generated" in file.relative_to(ROOT).parts:
            continue  # the build looks at these
        assert file.exists(), target
        if anchor and file.suffix == ".md":
            assert anchor in anchors(file), target


def test_every_page_has_its_place_on_the_home_page() -> None:
    home = (DOCS / "index.md").read_text(encoding="utf-8")
    trees = re.findall(r":::\{toctree\}(.*?):::", home, flags=re.DOTALL)
    named = {line.strip() for tree in trees for line in tree.splitlines()}
    apart = {"index", *(f"treatments/{word}" for word in known_types()["Contact"].members)}  # below Components
    for page in [*pages(), NOTEBOOK]:
        name = str(page.relative_to(DOCS).with_suffix(""))
        assert name in named | apart, name


def test_every_component_occurs_in_a_small_netlist_that_runs() -> None:
    hidden = innards(known_types()) | {"Fmu"}  # a netlist of it needs a binary of the machine: tests/fmu_import
    text = "\n".join(file.read_text(encoding="utf-8") for file in EXAMPLES)
    shown = [n for n, kind in known_types().items() if n not in hidden and kind.__module__.startswith("fairlead.")]
    assert [name for name in shown if not re.search(rf"\btype: {name}\b", text)] == []


def test_a_zone_diagram_has_every_zone_and_every_way() -> None:
    import xml.etree.ElementTree as ElementTree

    draw = module("zone_diagram").zone_diagram
    svg = draw(("slack", "taut"), {("slack", "taut"): "tightens <b>", ("taut", "slack"): "slackens"}, "Zones of X")
    drawing = ElementTree.fromstring(svg)
    words = [one.text for one in drawing.iter("{http://www.w3.org/2000/svg}text")]
    assert sorted(words) == ["slack", "slackens", "taut", "tightens <b>"]
    assert sum("marker-end" in one.attrib for one in drawing.iter("{http://www.w3.org/2000/svg}path")) == 2


def module(name: str):
    """A module of docs/generate."""
    spec = importlib.util.spec_from_file_location(f"docs_{name}", DOCS / "generate" / f"{name}.py")
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def cells() -> list[str]:
    """The code of the notebook."""
    made = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    return ["".join(cell["source"]) for cell in made["cells"] if cell["cell_type"] == "code"]


@pytest.mark.slow
def test_the_notebook_runs_and_every_value_shown_has_a_picture_or_a_table_of_its_own() -> None:
    names: dict[str, object] = {}
    shown = []
    for cell in cells():
        tree = ast.parse(cell)
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
            shown.append(type(value).__name__)
            assert any(hasattr(value, f"_repr_{form}_") for form in ("html", "png")), type(value)
    assert {"Model", "Page", "Result", "Statics", "Animation"} <= set(shown)


@pytest.mark.slow
@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_an_example_runs_and_its_energy_closes(file: pathlib.Path) -> None:
    result = fairlead.load(file).run(out=None)
    assert result.ok
    assert not result.remarks


@pytest.mark.slow
@pytest.mark.parametrize("page", ["tutorial/first", "tutorial/parts", "howto/friction", "howto/accuracy", "howto/slow",
                                  "howto/start", "howto/drive"])  # fmt: skip
def test_what_a_tutorial_or_a_how_to_shows_works(
    page: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    shown = FENCE.findall((DOCS / f"{page}.md").read_text(encoding="utf-8"))
    for name, _, text in shown:
        if name:
            (tmp_path / name).write_text(text, encoding="utf-8")
    for name, language, text in shown:
        for line in text.splitlines() if language == "sh" else ():
            answer = CliRunner().invoke(app, shlex.split(line)[1:])
            assert answer.exit_code == 0, f"{line}\n{answer.output}"
        if language == "python" and not name:
            exec(text, {})


class Links(html.parser.HTMLParser):
    """Addresses and names of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.names: set[str] = set()
        self.loaded: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        self.names |= {told[word] for word in ("id", "name") if told.get(word)}
        if tag == "a" and told.get("href"):
            self.targets.append(told["href"])
        self.loaded += [told[word] for word in ("src", "href") if tag in ("img", "script", "link") and told.get(word)]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """The site, built with every remark an error; once for all workers, since a build writes pages into docs."""
    for needed in ("sphinx", "myst_nb", "furo"):
        pytest.importorskip(needed, reason="the site wants the extra `docs`")
    own = tmp_path_factory.getbasetemp()
    shared = own.parent if os.environ.get("PYTEST_XDIST_WORKER") else own
    target, done = shared / "site", shared / "site.done"
    with filelock.FileLock(shared / "site.lock", timeout=2 * PATIENCE):
        if not done.exists():
            build(target)
            done.touch()
    return target


def build(target: pathlib.Path) -> None:
    """Have Sphinx write the site."""
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", str(DOCS), str(target)]
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    building = subprocess.Popen(
        command, cwd=ROOT, env=environment, start_new_session=True, text=True,
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    try:
        said, _ = building.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(building.pid, signal.SIGKILL)
        pytest.fail(f"the site was not built in {PATIENCE} s")
    assert building.returncode == 0, said


@pytest.mark.slow
def test_links_of_the_site_lead_somewhere_and_nothing_is_loaded_from_outside(site: pathlib.Path) -> None:
    found = {}
    for file in site.rglob("*.html"):
        found[file.resolve()] = Links()
        found[file.resolve()].feed(file.read_text(encoding="utf-8"))
    assert len(found) > 100
    for file, page in found.items():
        assert not [one for one in page.loaded if one.startswith(("http:", "https:", "//"))], file
        for target in page.targets:
            address = urllib.parse.urlsplit(target)
            if address.scheme:
                continue
            other = (file.parent / urllib.parse.unquote(address.path)).resolve() if address.path else file
            assert other.exists(), f"{file.name}: {target}"
            if address.fragment and other in found:
                assert urllib.parse.unquote(address.fragment) in found[other].names, f"{file.name}: {target}"


@pytest.mark.slow
def test_every_component_and_every_command_has_its_page_and_search_finds_it(site: pathlib.Path) -> None:
    hidden = innards(known_types())
    index = (site / "searchindex.js").read_text(encoding="utf-8")
    for name, kind in known_types().items():
        if name not in hidden and kind.__module__.startswith("fairlead."):
            page = (site / "generated" / "components" / f"{name}.html").read_text(encoding="utf-8")
            for title in ("Example", "Zones and equations"):
                assert f"<h2>{title}" in page, (name, title)
            assert re.search("<h2>(Ports|Inputs|Outputs)", page), name
            assert f"generated/components/{name}" in index
    commands = (site / "generated" / "commands.html").read_text(encoding="utf-8")
    for verb in app.registered_commands:
        assert f"fairlead {verb.callback.__name__}" in commands


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ServoValve", "ServoMotorDrive", "Cylinder", "HydraulicLine", "Gearbox"])
def test_a_part_made_of_others_names_them_and_shows_the_laws_of_those_without_a_page(site: pathlib.Path, name) -> None:
    page = (site / "generated" / "components" / f"{name}.html").read_text(encoding="utf-8")
    assert f"{name}</span></code> has no zones and equations of its own. In the example below" in page
    linked = re.findall(r'<td><p><a class="reference internal" href="(?:\w+|[./]+treatments/\w+)\.html', page)
    told = re.findall(r'<span class="pre">(\w+)</span></code>, below', page)
    assert linked or told
    for part in told:
        assert re.search(rf"<h3><code.*?>{part}<", page), part


def generated() -> Any:
    """Where the pages are written from plain text."""
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module("generate.text")
    finally:
        sys.path.remove(str(DOCS))


def test_docstrings_flow_and_their_equations_keep_their_lines() -> None:
    text = "A part: `a*b` and a*b, [N] < 3 _x.\nSee docs/routes.md.\n\n    F = k x\n    x = 1\n\n- 3 is less"
    assert generated().flowing(text) == [
        "A part: `a*b` and a\\*b, \\[N\\] \\< 3 \\_x.\nSee [docs/routes.md](../../routes.md).", "",
        "```text", "    F = k x", "    x = 1", "```", "", "\\- 3 is less", "",
    ]  # fmt: skip


@pytest.mark.slow
def test_the_site_keeps_what_the_cells_of_the_notebook_show(site: pathlib.Path) -> None:
    page = (site / "tutorial" / "notebook.html").read_text(encoding="utf-8")
    assert "<iframe" in page
    assert "data-only" in page
    assert "<table>" in page


@pytest.mark.slow
@pytest.mark.skipif(bool(missing()), reason=missing())
def test_read_from_disk_the_site_searches_fits_narrow_windows_and_complains_of_nothing(site: pathlib.Path) -> None:
    with opened() as browser:
        for width in (400, 1440, 1920):
            size = {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": width < 600}
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
            for name in ("index", "generated/components/Contact", "generated/gallery", "tutorial/notebook", "api"):
                browser.get_log("performance")
                browser.get((site / f"{name}.html").as_uri())
                assert browser.execute_script("return document.documentElement.scrollWidth") <= width, (name, width)
                assert requests(browser) == [], name
        browser.get((site / "search.html").as_uri() + "?q=ruck")
        links = "return [...document.querySelectorAll('ul.search a')].map(one => one.textContent)"
        until(browser, lambda: "RuckTrip" in browser.execute_script(links))
        assert complaints(browser) == []


def test_every_bundled_model_has_a_question_in_the_gallery(monkeypatch) -> None:
    monkeypatch.syspath_prepend(str(DOCS))
    questions = module("gallery").QUESTIONS
    assert set(questions) == {path.stem for path in (ROOT / "models").glob("*.yaml")}
    assert all(question.endswith("?") for question in questions.values())
