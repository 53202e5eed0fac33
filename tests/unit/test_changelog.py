"""The changelog tells a user what is new, version by version: a page for each at most."""

import pathlib
import re
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
A_PAGE = 60  # lines
SECTIONS = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]


def test_the_newest_version_is_that_of_the_package_and_takes_a_page_at_most() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    assert SECTIONS[0].startswith(version)
    for section in SECTIONS:
        if section[0].isdigit():
            assert section.count("\n") <= A_PAGE, section.splitlines()[0]


def test_each_group_of_lines_has_a_heading_that_says_what_a_reader_looks_for() -> None:
    for section in SECTIONS:
        for group in re.split(r"^### ", section, flags=re.MULTILINE)[1:]:
            title, *lines = group.rstrip().splitlines()
            assert re.match(r"What ", title), title
            assert any(line.startswith("- ") for line in lines), title
