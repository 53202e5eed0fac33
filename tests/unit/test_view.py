"""`fairlead view`: who is answered, what is told of a text, what is offered, and what becomes of the file."""

import http.client
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import fairlead
from fairlead.component.registry import known_types
from fairlead.errors import UsageError
from fairlead.view import View
from fairlead.view.completion import Completion
from fairlead.view.draft import Draft
from fairlead.view.place import place_in
from fairlead.view.workers import Helper

BELT = (Path(fairlead.__file__).parents[2] / "models" / "belt.yaml").read_text(encoding="utf-8")
WRONG = BELT.replace("stiffness: 100 N/m", "stifness: 100 N/m")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("view")
    (made / "belt.yaml").write_text(BELT, encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def view(folder: Path):
    made = View(str(folder / "belt.yaml"))
    threading.Thread(target=made._server.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True).start()
    yield made
    made._server.shutdown()
    made.close()


def asked(view: View, method: str, what: str, body: Any = None, **headers: str) -> tuple[int, str, Any]:
    connection = http.client.HTTPConnection("127.0.0.1", view._server.server_address[1], timeout=120)
    told = {"Host": view.hosts[0], "Content-Type": "application/json", **headers}
    connection.request(method, what, None if body is None else json.dumps(body), told)
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text, answer.headers


def does(view: View, what: str, **body: Any) -> Any:
    status, text, _ = asked(view, "POST", f"/{view.token}/{what}", body)
    assert status == 200, text
    return json.loads(text)


def test_the_page_holds_the_text_escaped_and_lets_in_no_other_script(view: View) -> None:
    before, view.draft.text = view.draft.text, "</textarea><script>alert(1)</script>"
    status, text, headers = asked(view, "GET", f"/{view.token}/")
    view.draft.text = before
    assert status == 200
    assert "<script>alert" not in text
    assert "&lt;/textarea&gt;&lt;script&gt;" in text
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert text.count("<script nonce=") == 1


@pytest.mark.parametrize(
    ("method", "what", "headers"),
    [
        ("GET", "/", {}),
        ("GET", "/wrong/", {}),
        ("GET", "/wrong/state", {}),
        ("POST", "/wrong/run", {}),
        ("GET", "/{token}/", {"Host": "evil.example"}),
        ("POST", "/{token}/run", {"Host": "evil.example:80"}),
        ("GET", "/{token}/state", {"Origin": "http://evil.example"}),
        ("POST", "/{token}/save", {"Origin": "null"}),
    ],
)
def test_whoever_has_not_the_address_is_refused(view: View, method: str, what: str, headers: dict[str, str]) -> None:
    body = {"text": "x"} if method == "POST" else None
    before = view.runner.number
    status, text, _ = asked(view, method, what.format(token=view.token), body, **headers)
    assert status == 403
    assert view.token not in text
    assert view.runner.number == before


@pytest.mark.parametrize("body", [[], {"text": 3}, "x"])
def test_what_the_page_would_not_ask_is_no_request(view: View, body: Any) -> None:
    assert asked(view, "POST", f"/{view.token}/check", body)[0] == 400
    assert asked(view, "POST", f"/{view.token}/nothing", {})[0] == 400
    assert asked(view, "POST", f"/{view.token}/run", {}, **{"Content-Type": "text/plain"})[0] == 400
    assert asked(view, "GET", f"/{view.token}/../state")[0] == 404


def test_only_this_machine_can_ask(view: View) -> None:
    assert view._server.server_address[0] == "127.0.0.1"
    assert len(view.token) >= 32


@pytest.mark.parametrize("text", [WRONG, BELT.replace("spring.b, block", "sprig.b, block"), "schema: 1\nname: {", ""])
def test_a_text_that_is_not_saved_is_told_what_check_tells_of_a_file(view: View, folder: Path, text: str) -> None:
    told = does(view, "check", text=text)["faults"]
    before = view.draft.file.read_text(encoding="utf-8")
    view.draft.file.write_text(text, encoding="utf-8")
    try:
        with pytest.raises(fairlead.ModelError) as caught:
            fairlead.load(view.draft.file).check()
    finally:
        view.draft.file.write_text(before, encoding="utf-8")
    assert [one["said"] for one in told] == [str(fault) for fault in caught.value.faults]
    places = [(fault.where.line, fault.where.column) for fault in caught.value.faults if fault.where]
    assert [(one["line"], one["column"]) for one in told] == places
    assert all(one["here"] for one in told)


def test_a_text_without_mistakes_has_none(view: View) -> None:
    assert does(view, "check", text=BELT) == {"faults": [], "warnings": []}


def test_a_check_that_takes_too_long_is_given_up_and_the_next_one_is_made() -> None:
    checker = Helper("check", patience=0.0)
    try:
        told = checker.ask({"file": "x.yaml", "text": BELT, "set": {}, "libraries": [], "allow_fmu": False})
        assert "longer than" in told["faults"][0]["said"]
        assert checker._worker is None
    finally:
        checker.end()


@pytest.fixture(scope="module")
def completion() -> Completion:
    """Of a few types: the schema of all takes seconds."""
    known = known_types()
    return Completion({name: known[name] for name in ("Ground", "Spring", "Mass", "Contact")})


def offered(completion: Completion, text: str) -> list[str]:
    """What is offered at the bar."""
    cursor = text.index("|")
    return [one["text"] for one in completion.at(text.replace("|", ""), cursor)["items"]]


HEAD = "schema: 1\ncomponents:\n  wall: {type: Ground}\n  s: {type: Spring, stiffness: 2 N/m}\n  m:\n    type: Mass\n"


@pytest.mark.parametrize(
    ("text", "wanted", "unwanted"),
    [
        ("com|", "components: ", "run: "),
        ("components:\n  s: {type: Spr|", "Spring", "Mass"),
        ("components:\n  s:\n    type: Spr|", "Spring", "Mass"),
        ("components:\n  s: {type: Spring, st|}", "stiffness: ", "mass: "),
        ("components:\n  s:\n    type: Spring\n    |\n  m: {type: Mass}", "free_length: ", "mass: "),
        ("components:\n  s: {|, type: Mass}", "velocity: ", "stiffness: "),
        ("components:\n  s: {type: Spring, stiffness: 3 k|", "3 kN/m", "3 kg"),
        ("components:\n  s: {type: Spring, stiffness: 3 |}", "3 N/m", "3 m"),
        ("components:\n  p: {type: Contact, curve: {curve: str|", "stribeck", "coulomb"),
        ("components:\n  p: {type: Contact, curve: {curve: stribeck, vel|", "velocity: ", "type: "),
        ("run: {sto|", "stop: ", "start: "),
        ("run:\n  stop: 3 |", "3 min", "3 m"),
        ("run: {stop: 2 s, max_step: 5 m|", "5 ms", "5 mm"),
        ("record: {every: 10 |", "10 ms", "10 N"),
        ("run:\n  engine: |", "stepping", "stop: "),
        (HEAD + "connections:\n  - [s|", "s.a", "wall.flange"),
        (HEAD + "connections: [[wall.flange, s.a], [m|", "m.flange", "s.b"),
        (HEAD + "connections:\n  - - wall.flange\n    - |", "m.flange", "type: "),
        ('# a "comment: {\ncomponents:\n  s: {type: Spr|', "Spring", "Mass"),
    ],
)
def test_what_may_stand_at_the_cursor_is_offered(completion: Completion, text: str, wanted: str, unwanted: str) -> None:
    found = offered(completion, text)
    assert wanted in found
    assert unwanted not in found


HANGS = "while True:\n    pass\n"
PRINTS = "print('hello'); import sys; sys.stdout.write('{')\n"
LEAVES = "import os; os._exit(3)\n"


@pytest.fixture
def helper():
    made = Helper("complete", patience=60.0)
    yield made
    made.end()


def completed(helper: Helper, text: str, *libraries: Path) -> Any:
    given = {"file": "x.yaml", "set": {}, "libraries": [str(one) for one in libraries], "allow_fmu": False}
    return helper.ask({**given, "text": text.replace("|", ""), "cursor": text.index("|")})


@pytest.mark.slow
def test_a_library_is_executed_in_a_process_that_may_hang_print_or_die(helper: Helper, tmp_path: Path) -> None:
    tutorial = (Path(fairlead.__file__).parents[2] / "docs" / "tutorial" / "parts.md").read_text(encoding="utf-8")
    own = tutorial.partition("<!-- file: parts.py -->\n```python\n")[2].partition("```")[0]
    libraries = {}
    for name, text in {"hangs": HANGS, "prints": own + PRINTS, "leaves": LEAVES}.items():
        libraries[name] = tmp_path / f"{name}.py"
        libraries[name].write_text(text, encoding="utf-8")
    text = "components:\n  s: {type: Fus|"
    assert own
    assert completed(helper, text)["items"] == []
    assert [one["text"] for one in completed(helper, text, libraries["prints"])["items"]] == ["Fuse"]
    assert "code 3" in completed(helper, text, libraries["leaves"])["faults"][0]["said"]
    helper._patience = 5.0
    assert "longer than 5 s" in completed(helper, text, libraries["hangs"])["faults"][0]["said"]
    helper._patience = 60.0
    assert [one["text"] for one in completed(helper, "run: {sto|")["items"]] == ["stop: "]


@pytest.mark.slow
def test_the_page_is_offered_every_type_and_its_server_has_loaded_none() -> None:
    script = (
        "import sys; from fairlead.view import View; view = View('belt')\n"
        "from fairlead.view.server import _complete\n"
        "text = 'components:\\n  s: {type: RuckT'\n"
        "print([one['text'] for one in _complete(view, {}, text)['items']])\n"
        "print([name for name in sys.modules if name.startswith('fairlead.components')]); view.close()\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    offers, loaded = done.stdout.splitlines()
    assert offers == "['RuckTrip']"
    assert loaded == "[]"


def test_what_is_offered_is_told_about(completion: Completion) -> None:
    items = completion.at("components:\n  s: {type: Sprin", 30)["items"]
    assert ("Spring", "Linear spring:  tension = stiffness * (b.x - a.x - free_length).") in [
        (one["text"], one["about"]) for one in items
    ]
    assert completion.at("components:\n  s: {type: Sprin", 30)["begin"] == 25


def test_no_text_and_no_cursor_bring_completion_down(completion: Completion) -> None:
    for cursor in range(0, len(BELT), 7):
        completion.at(BELT, cursor)
        place_in(BELT[::-1], cursor)
    for odd in ("}}]]", "a: ]", "- - -", "'", "{: :", "\t\n\r"):
        completion.at(odd, len(odd))


def test_the_file_changes_when_it_is_saved_and_only_as_it_was_read(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_bytes(b"\xef\xbb\xbf" + BELT.replace("\n", "\r\n").encode())
    file.chmod(0o640)
    draft = Draft(str(file))
    draft.save(WRONG)
    assert file.read_bytes() == b"\xef\xbb\xbf" + WRONG.replace("\n", "\r\n").encode()
    assert file.stat().st_mode & 0o777 == 0o640
    draft.save(BELT)
    file.write_text("another hand", encoding="utf-8")
    with pytest.raises(UsageError, match="changed by another program"):
        draft.save(WRONG)
    assert file.read_text(encoding="utf-8") == "another hand"
    assert [one.name for one in tmp_path.iterdir()] == ["a.yaml"]


@pytest.mark.parametrize("name", ["belt", "single_parts/worm"])
def test_a_bundled_model_is_not_saved(name: str) -> None:
    draft = Draft(name)
    with pytest.raises(UsageError, match="bundled model"):
        draft.save(draft.text)


@pytest.mark.slow
def test_a_run_leaves_its_page_and_the_file_alone(view: View, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert does(view, "run", text=BELT.replace("stop: 40 s", "stop: 1 s"))["begun"]
    state = ended(view)
    assert (state["state"], state["status"]) == ("done", "finished")
    status, page, headers = asked(view, "GET", f"/{view.token}/report/{state['number']}")
    assert status == 200
    assert 'id="verdict"' in page
    assert headers["Content-Security-Policy"] == "frame-ancestors 'self'"
    assert view.draft.file.read_text(encoding="utf-8") == BELT
    monkeypatch.chdir(folder)
    assert not (folder / "results").exists()
    assert "results/belt" in does(view, "keep")["saved"]
    assert (folder / "results" / "belt" / "run.json").exists()


@pytest.mark.slow
def test_a_run_that_cannot_begin_says_why(view: View) -> None:
    does(view, "run", text=WRONG)
    state = ended(view)
    assert not state["page"]
    assert "stifness" in state["faults"][0]["said"]


@pytest.mark.slow
def test_a_run_that_is_stopped_keeps_what_it_has(view: View) -> None:
    does(view, "run", text=BELT.replace("stop: 40 s", "stop: 4e6 s").replace("every: 20 ms", "every: 1000 s"))
    begun = time.monotonic()
    while view.runner.state["t"] == 0.0:
        assert view.runner.state["state"] == "running", view.runner.state
        assert time.monotonic() - begun < 120
        time.sleep(0.1)
    assert not does(view, "run", text=BELT)["begun"]
    does(view, "stop")
    state = ended(view)
    assert state["status"] == "interrupted"
    assert state["page"]


def ended(view: View) -> dict[str, Any]:
    begun = time.monotonic()
    while view.runner.state["state"] == "running":
        assert time.monotonic() - begun < 200
        time.sleep(0.05)
    return view.runner.state


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
def test_ctrl_c_ends_it_and_leaves_nothing_behind(folder: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "fairlead", "view", str(folder / "belt.yaml")]
    own = {**os.environ, "TMPDIR": str(tmp_path)}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=own,
                               start_new_session=True)  # fmt: skip
    try:
        line = process.stdout.readline()
        assert "http://127.0.0.1:" in line
        assert [one.name for one in tmp_path.iterdir() if one.name.startswith("fairlead-view-")]
        os.kill(process.pid, signal.SIGINT)
        _, complaints = process.communicate(timeout=100)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert (process.returncode, complaints) == (0, "")
    assert not [one.name for one in tmp_path.iterdir() if one.name.startswith("fairlead-view-")]
