"""Where verbs write: a folder or a file in the way is told before any work, and no result is lost to it."""

import os

import pytest
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.errors import UsageError

BELT = ["--set", "run.stop=0.05 s"]
INTO_FILES = [
    (["graph", "belt"], "--out"), (["modes", "belt"], "--csv"), (["modes", "belt"], "--plot"),
    (["sensitivity", "belt", *BELT, "--of", "end(block.x)", "--to", "block.mass"], "--csv"),
    (["sweep", "belt", *BELT, "--grid", "block.mass=1,2"], "--csv"), (["cost", "belt"], "--write"),
    (["report", "RUN"], "--out"), (["plot", "RUN", "zones"], "--out"), (["plot", "belt", "friction"], "--out"),
]  # fmt: skip
INTO_FOLDERS = [
    ["compare", "belt", "--vary", "pad.method=hold,tanh"], ["cost", "belt"], ["effects", "belt"], ["fit", "FIT"],
    ["sweep", "belt", "--grid", "block.mass=1,2"], ["friction", "0.4"], ["plot", "--paper"],
]  # fmt: skip


@pytest.fixture
def run(tmp_path):
    place = tmp_path / "run"
    assert CliRunner().invoke(app, ["run", "belt", *BELT, "--out", str(place)]).exit_code == 0
    return place


def refused(words: list[str], option: str, place) -> str:
    answer = CliRunner().invoke(app, [*words, option, str(place)])
    assert answer.exit_code == UsageError.exit_code, answer.output
    assert str(place.parent if place.parent.is_file() else place) in answer.output.replace("\n", "")
    return answer.output


@pytest.mark.parametrize(("words", "option"), INTO_FILES)
def test_a_folder_where_a_file_is_to_be_written_is_refused(words, option, run, tmp_path) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    words = [str(run) if one == "RUN" else one for one in words]
    assert "is a folder, and a file is wanted" in refused(words, option, folder)
    assert not list(folder.iterdir())


@pytest.mark.parametrize(("words", "option", "name"), [
    (["plot", "RUN", "zones"], "--out", "x.xyz"), (["plot", "belt", "friction"], "--out", "x.xyz"),
    (["plot", "belt", "work-precision"], "--out", "x"), (["modes", "belt"], "--plot", "x.xyz"),
    (["friction", "belt"], "--out", "x.xyz"), (["graph", "belt"], "--out", "x.png"),
    (["report", "RUN"], "--out", "x.pdf"),
])  # fmt: skip
def test_a_format_that_is_not_written_is_told_before_any_work(words, option, name, run, tmp_path) -> None:
    answer = refused([str(run) if one == "RUN" else one for one in words], option, tmp_path / name)
    assert "Formats are ." in answer
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize("words", [["run", "belt"], *(words for words in INTO_FOLDERS if words[0] != "friction")])
def test_a_folder_that_is_called_like_a_picture_is_refused(words, tmp_path) -> None:
    assert "a folder is wanted" in refused(words, "--out", tmp_path / "x.png")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("words", INTO_FOLDERS)
@pytest.mark.parametrize("below", [False, True])
def test_a_file_where_a_folder_is_wanted_is_refused(words, below, tmp_path) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    refused(words, "--out", file / "x" if below else file)
    assert file.read_text() == "mine"


@pytest.mark.parametrize("words", [["graph", "belt"], ["report", "RUN"], ["plot", "RUN", "zones"]])
def test_a_file_in_the_way_to_a_file_is_refused(words, run, tmp_path) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    refused([str(run) if one == "RUN" else one for one in words], "--out", file / "x.svg")


def test_a_fit_is_told_before_it_is_written(tmp_path, monkeypatch) -> None:
    """The disk refuses when all searches are done: what they found stands on the screen."""
    import fairlead.studies.fits.page as page

    def full(*_, **__):
        raise OSError(28, "No space left on device", str(tmp_path / "out" / "fit.html"))

    monkeypatch.setattr(page, "write_page", full)
    (tmp_path / "fast.csv").write_text("t,x\n" + "".join(f"{k / 20},{k / 50}\n" for k in range(10)))
    (tmp_path / "fit.yaml").write_text(
        "model: belt\nrecords: {one: {file: fast.csv, time: t, signals: {block.x: x}}}\nstarts: 1\n"
        "parameters: {block.mass: {start: 1, low: 0.5, high: 2}}\n"
    )
    answer = CliRunner().invoke(app, ["fit", str(tmp_path / "fit.yaml"), "--out", str(tmp_path / "out")])
    assert answer.exit_code == 1
    assert "block.mass" in answer.output
    assert "No space left on device" in answer.output
    assert "mistake in fairlead" not in answer.output


@pytest.mark.parametrize("words", [["plot", "RUN", "signals"], ["report", "RUN"]])
def test_a_folder_in_the_place_of_what_a_verb_writes_by_itself_is_a_sentence(words, run) -> None:
    for name in ("signals.png", "report.html"):
        (run / name).mkdir()
        (run / name / "mine").touch()
    answer = CliRunner().invoke(app, [str(run) if one == "RUN" else one for one in words])
    assert answer.exit_code in (1, 2), answer.output
    assert str(run) in answer.output.replace("\n", "")
    assert "mistake in fairlead" not in answer.output


def test_friction_writes_the_file_that_is_named(tmp_path) -> None:
    answer = CliRunner().invoke(app, ["friction", "0.4", "--out", str(tmp_path / "curve.png")])
    assert answer.exit_code == 0
    assert (tmp_path / "curve.png").read_bytes()[1:4] == b"PNG"


@pytest.mark.parametrize(
    ("words", "says"),
    [(["--method", "tanh"], "--set friction.method=tanh"), (["--method", "foo"], "for a curve"),
     (["--normal", "3 N"], "of its own")],
)  # fmt: skip
def test_friction_of_a_netlist_refuses_what_it_does_not_follow(words, says, tmp_path) -> None:
    answer = CliRunner().invoke(app, ["friction", "belt", *words, "--out", str(tmp_path)])
    assert answer.exit_code == UsageError.exit_code
    assert says in " ".join(answer.output.replace("│", " ").split())


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
@pytest.mark.parametrize("words", [["run", "belt"], ["graph", "belt"]])
def test_a_link_to_nothing_is_no_place(words, tmp_path) -> None:
    (tmp_path / "link").symlink_to("nowhere")
    assert "link is a link to nowhere" in " ".join(refused(words, "--out", tmp_path / "link").split())
    assert [file.name for file in tmp_path.iterdir()] == ["link"]
