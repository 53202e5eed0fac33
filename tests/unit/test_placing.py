"""Files that get into a folder: an error of the disk names the file that was asked for, and nothing is left."""

import errno

import pytest

from fairlead.errors import UsageError
from fairlead.fmu.archive import write
from fairlead.results.placing import place, placing


def fill(part):
    """As a disk that is full says it, which names no file."""
    part.write_bytes(b"half")
    raise OSError(errno.ENOSPC, "No space left on device")


def test_a_full_disk_names_the_file(tmp_path):
    place(tmp_path / "picture.png", "old")
    with pytest.raises(OSError, match="No space left") as told, placing(tmp_path / "picture.png") as part:
        fill(part)
    assert told.value.filename == str(tmp_path / "picture.png")
    assert [(one.name, one.read_text()) for one in tmp_path.iterdir()] == [("picture.png", "old")]


def test_a_folder_that_is_not_there_names_the_file(tmp_path):
    with pytest.raises(FileNotFoundError) as told:
        place(tmp_path / "lost" / "page.html", "text")
    assert told.value.filename == str(tmp_path / "lost" / "page.html")


def test_errors_of_others_name_what_they_name(tmp_path):
    with pytest.raises(FileNotFoundError) as told, placing(tmp_path / "table.xlsx"):
        (tmp_path / "template").read_text()
    assert told.value.filename == str(tmp_path / "template")


def test_an_fmu_is_a_file(tmp_path):
    with pytest.raises(UsageError, match="is a folder"):
        write(tmp_path, b"")
