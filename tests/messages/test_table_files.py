"""What is wrong in a CSV file is told with its row and column, and nothing in it is passed over or misread."""

import pytest

from fairlead.component.given import Table
from fairlead.component.tables import MOST_BYTES, TableError, read_table

FORCE = Table("s", "N", "Force over time.")


def read(folder, data, name="force.csv"):
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    return read_table({"file": name}, FORCE, folder)


@pytest.mark.parametrize("text", [
    "0,1\n2,5\n", "t,force\n0,1\n2,5\n", "# measured\n\nt [s],F [N]\n 0 , 1 \n2,5,\n", "\ufeff0,1\r\n2,5\r\n",
    '"time","force"\n"0","1"\n"2","5"\n', "Measured in March\n0,1\n2,5\n", "t,force,remark\n0,1\n2,5\n",
])  # fmt: skip
def test_two_columns_with_or_without_a_header_are_read(tmp_path, text):
    table = read(tmp_path, text)
    assert [table(t) for t in (0.0, 1.0, 2.0)] == [1.0, 3.0, 5.0]


@pytest.mark.parametrize("text", [
    "t [ms],force [kN]\n0,0.001\n2000,0.005\n", "t (ms) , force(kN)\n0,0.001\n2000,0.005\n",
    "t [min],F [-]\n0,1\n0.0333333333333333333,5\n",
    "t [s],force (measured)\n0,1\n2,5\n",
])  # fmt: skip
def test_units_in_the_header_are_those_of_the_columns(tmp_path, text):
    table = read(tmp_path, text)
    assert [table(t) for t in (0.0, 1.0, 2.0)] == pytest.approx([1.0, 3.0, 5.0], rel=1e-14)


def test_columns_are_named_with_or_without_their_units(tmp_path):
    (tmp_path / "test.csv").write_text("force [kN],v [mm/s],t [ms]\n0.001,7,0\n0.005,8,2000\n")
    for columns in (["t", "force"], ["t [ms]", "force"]):
        table = read_table({"file": "test.csv", "columns": columns}, FORCE, tmp_path)
        assert table(1.0) == pytest.approx(3.0, rel=1e-14)
    with pytest.raises(TableError, match=r"v \[mm/s\] is a column of another kind"):
        read_table({"file": "test.csv", "columns": ["t", "v"]}, FORCE, tmp_path)


def test_a_file_is_parsed_once_and_anew_when_its_content_changes(tmp_path):
    first = read(tmp_path, "0,1\n2,5\n")
    assert read(tmp_path, "0,1\n2,5\n") is first  # cases of a sweep ask for it again and again
    changed = read(tmp_path, "0,1\n2,7\n")  # of the same size, at the same instant
    assert (first(1.0), changed(1.0)) == (3.0, 4.0)
    other = read_table({"file": "force.csv", "beyond": "line"}, FORCE, tmp_path)
    assert (changed(3.0), other(3.0)) == (7.0, 10.0)  # the same content asked for in another way
    with pytest.raises(ValueError, match="read-only"):
        changed.rows[0, 3] = 0.0


# (what the file holds, what is said)
WRONG = [
    ("abc,1\n1,2\n2,3\n", "row 1, column 1: abc is not a number"),
    ("0 s,5 N\n1 s,6 N\n", "row 1, column 1: 0 s is not a number. Numbers of a file are in SI, or in the unit"),
    ("t,y\ns,N\n0,1\n1,2\n", "row 2, column 1: s is not a number"),
    ("0,1\n1,2\n2,x\n", "row 3, column 2: x is not a number"),
    ("0,5;1,5\n1,5;2\n", "row 1: 0,5;1,5 is separated by semicolons"),
    ("0;1\n1;2\n", "row 1: 0;1 is separated by semicolons"),
    ('"0,5","1,5"\n"1,5","2"\n', "row 1, column 1: 0,5 is not a number. A decimal comma is no point."),
    ("0,5,1,5\n1,5,2,5\n", "row 1: 4 columns; a table has two"),
    ("t,y,z\n0,1,2\n1,2,3\n", "row 2: 3 columns; a table has two"),
    ("0\n1\n", "row 1: one column; a table has two"),
    ("0\t1\n1\t2\n", "row 1, column 1: 0 1 is not a number"),
    ("0,nan\n1,2\n", "row 1, column 2: nan is not a number"),
    ("0,1_000\n1,2\n", "row 1, column 2: 1_000 is not a number"),
    ("0,1e999\n1,2\n", "row 1, column 2: 1e999 is not a finite number"),
    ("t,y\n0,1\n\n2,3\n1,4\n", "row 5: x must rise from point to point; 1 follows 2"),
    (b"0,1\n1,\xff2\n", "row 2: the file is not a text in UTF-8 (byte 0xff)"),
    ("0,1\n1,2\n".encode("utf-16"), "row 1: the file is not a text in UTF-8"),
    ("\u22121,\u22121\n0,0\n1,1\n", "row 1, column 1: \u22121 is not a number"),
    ("nan,nan\n0,0\n1,1\n", "row 1, column 1: nan is not a number"),
    ("-inf,infinity\n0,0\n1,1\n", "row 1, column 1: -inf is not a number"),
    ("O,O\n1,0\n2,1\n", "row 1, column 1: O is not a number"),
    ("t [ms],F [mm]\n0,0\n1,1\n", "row 1: F [mm] is a column of another kind: a force is wanted here"),
    ("t [ms]\n0,0\n1,1\n", "row 1: the header has 1 column with units; a table has two"),
    ("t [ms],F [kN],v [m/s]\n0,0\n1,1\n", "row 1: the header has 3 columns with units; a table has two"),
    ("t [ms],F [raw]\n0,0\n1,1\n", "row 1: F [raw] is no column with a unit"),
    ("t,y\n", "a table has 2 to 100000 points, this one has 0"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "said"), WRONG)
def test_what_is_not_two_numbers_is_told_by_its_row(tmp_path, text, said):
    with pytest.raises(TableError) as caught:
        read(tmp_path, text)
    assert said in str(caught.value)


def test_a_name_that_leads_to_no_file_is_a_mistake_of_the_netlist(tmp_path):
    (tmp_path / "loop.csv").symlink_to("loop.csv")
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "large.csv").write_bytes(b"0,1\n" * (MOST_BYTES // 4 + 1))
    for name in ("loop.csv", "loop.csv/x", "folder.csv", "large.csv", "x" * 300, "\0", "../x.csv", "", None, 3, ["a"]):
        with pytest.raises(TableError) as caught:
            read_table({"file": name}, FORCE, tmp_path)
        assert caught.value.path == ("file",), name
        assert ("is a folder" in str(caught.value)) == (name in ("folder.csv", "")), name
