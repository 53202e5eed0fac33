"""Arrays of FMI 3.0: elements as signals, sizes by structural parameters, lists as parameters; y = W u of our own C."""

import re

import numpy as np
import pytest

from fairlead.errors import ModelError, RunError

RUN = "run: {stop: 0.15 s}\n"


@pytest.fixture(scope="module")
def matrix(make):
    """The FMU, once."""
    return make("matrix", rich=True)


def outputs(result, name, count):
    return [result.at(f"fmu.{name}_{k + 1}", 0.05) for k in range(count)]


def test_elements_of_arrays_are_signals_and_parameters_are_lists(matrix, load):
    """Each type, with units; y = W u in mm."""
    result = load(f"""
        components:
          fmu:
            type: Fmu
            file: rich_matrix3.fmu
            period: 0.1 s
            parameters:
              W: [[1, 2 mm], [3 mm, 4 mm], [5 mm, 6 cm]]
              k: [3, 4]
              names: [abc, hä]
              on: [true, false]
          one: {{type: SignalSource, value: 10}}
          two: {{type: SignalSource, value: 1}}
        connections: [[one.signal, fmu.u_1], [two.signal, fmu.u_2]]
        {RUN}
    """).run(out=None)
    np.testing.assert_allclose(outputs(result, "y", 3), [10 + 0.002, 0.034, 0.05 + 0.06], rtol=1e-15)
    units = {signal.name: signal.unit for signal in result.signals}
    assert units["fmu.y_1"] == "m"
    assert result.at("fmu.sum", 0.05) == 7
    assert result.at("fmu.length", 0.05) == 10 * 3 + len("hä".encode())
    assert result.at("fmu.set", 0.05) == 2


def test_structural_parameters_set_the_sizes_of_arrays(matrix, load):
    result = load(f"""
        components:
          fmu: {{type: Fmu, file: rich_matrix3.fmu, period: 0.1 s,
                parameters: {{n: 3, m: 1, W: [[1 mm, 2 mm, 3 mm]], u: [7, 8, 9]}}}}
        {RUN}
    """).run(out=None)
    np.testing.assert_allclose(outputs(result, "y", 1), [0.001 * (7 + 16 + 27)], rtol=1e-15)
    assert not result.match("fmu.y_2")


def test_one_element_is_a_signal_or_set_and_the_others_keep_their_values(matrix, load):
    """u[1] and W[2,2] are set, u[2] is a signal; the rest has the start values of the FMU, which are 0 and 1 mm."""
    result = load(f"""
        components:
          fmu:
            type: Fmu
            file: rich_matrix3.fmu
            period: 0.1 s
            inputs: {{b: "u[2]"}}
            outputs: {{second: "y[2]", other: "W[2,1]", entry: "W[2,2]", size: n}}
            parameters: {{"u[1]": 5, "W[2,2]": 4 mm}}
          two: {{type: SignalSource, value: 3}}
        connections: [[two.signal, fmu.b]]
        {RUN}
    """).run(out=None)
    found = [result.at(f"fmu.{name}", 0.05) for name in ("second", "other", "entry", "size")]
    np.testing.assert_allclose(found, [0.005 + 0.012, 0.001, 0.004, 2], rtol=1e-15)


@pytest.mark.slow
def test_one_value_is_for_all_elements(matrix, load):
    result = load(f"""
        components: {{fmu: {{type: Fmu, file: rich_matrix3.fmu, period: 0.1 s, parameters: {{W: 2 mm, u: 3}}}}}}
        {RUN}
    """).run(out=None)
    np.testing.assert_allclose(outputs(result, "y", 3), [0.012] * 3, rtol=1e-15)


@pytest.mark.slow
def test_an_element_that_is_no_number_is_told(matrix, load):
    scene = f"""
        components:
          fmu: {{type: Fmu, file: rich_matrix3.fmu, period: 0.1 s,
                parameters: {{W: [[1, 0], [2, 0], [3, -1e305]], u: [0, 1e308]}}}}
        {RUN}
    """
    with pytest.raises(RunError, match=r"fmu.*rich_matrix3\.fmu gives y_3 \(its y\[3\]\) = -inf\. Look at its inputs"):
        load(scene).run(out=None)


@pytest.mark.slow
def test_elements_go_with_the_state(matrix, load):
    run = load(f"""
        components: {{fmu: {{type: Fmu, file: rich_matrix3.fmu, period: 0.1 s, parameters: {{W: 2 mm, u: 3}}}}}}
        {RUN}
    """).start()
    run.advance(0.05)
    state = run.save()
    run.advance(0.12)
    run.restore(state)
    run.advance(0.12)
    assert run.get("fmu.y_2") == pytest.approx(0.012, rel=1e-15)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("parameters: {u: [1, 2, 3]}", r"fmu\.parameters\.u: u is a list of 3, and u has 2 elements\.\n"
         r" +Write a list of 2 values; or one value for all elements\. Its size is set by n"),
        ("parameters: {k: []}", r"k is an empty list, and k has 2 elements"),
        ("parameters: {W: [1, 2, 3]}",
         r"W\[1\] is 1 and no list\.\n +Write a list of 3 lists of 2 values; or one value"),
        ("parameters: {W: [[1, 2], [3], [5, 6]]}", r"W\[2\] is a list of 1, and W has 3 x 2 elements"),
        ("parameters: {W: [[1, 2], [3, 4], [5, [6]]]}", r"W\[3\]\[2\] is a list of 1, and it is one value"),
        ("parameters: {k: [1, 2.5]}", r"k\[2\] = 2\.5 is no whole number"),
        ("parameters: {k: [1, 1e12]}", r"k\[2\] = 1e\+12 is out of range\.\n +k\[2\] is Int32 in the FMU"),
        ("parameters: {u: [1, .nan]}", r"u\[2\]: nan is not finite"),
        ("parameters: {W: [[1, 2], [3, 4 N], [5, 6]]}", r"W\[2,2\]: 4 N is a force, not a length"),
        ("parameters: {names: [a, 3]}", r"3 is no text, and names\[2\] is one"),
        ("parameters: {\"u[3]\": 1}", r"there is no element u\[3\]\.\n +u has 2 elements: u\[1\] to u\[2\]"),
        ("parameters: {\"u[0]\": 1}", r"there is no element u\[0\]"),
        ("parameters: {\"W[2]\": 1}",
         r"W\[2\] has one index, and W has 2\.\n +W has 3 x 2 elements: W\[1,1\] to W\[3,2\]"),
        ("parameters: {\"n[1]\": 1}", r"n is one number, and n\[1\] would be an element of an array\.\n +Write n"),
        ("parameters: {n: [1]}", r"a list of 1 is no single value, and n is one"),
        ("parameters: {n: 0}", r"n = 0 is no size that its arrays may have\.\n +Give a whole number from 1 to 4000"),
        ("parameters: {n: 5000, u: 0}", r"n = 5000 is no size that its arrays may have"),
        ("parameters: {m: 0}", r"m = 0 is no size that its arrays may have\.\n +Give a whole number from 1 on"),
        ("parameters: {n: 2.5}", r"n = 2\.5 is no whole number"),
        ("parameters: {n: -1}", r"n = -1 is out of range"),
        ("outputs: {y: y}",
         r"y is an array of 3 elements, and a signal is one number\.\n +Name an element: \"y\[3\]\""),
        ("outputs: {y: \"y[4]\"}", r"there is no element y\[4\]\.\n +y has 3 elements"),
        ("outputs: {y: \"z[4]\"}",
         r"the FMU has no variable z\[4\]\.\n.*Its outputs are y \(3 elements\), sum, length"),
        ("inputs: {b: \"y[1]\"}", r"y\[1\] is output and cannot be one of its inputs"),
        ("outputs: {a: \"names[1]\"}", r"names\[1\] is String, and a signal is one number"),
        ("parameters: {n: 2000}",
         r"the array u has 2000 elements\.\n +Name those that you need, such as {NAME: \"u\[2000\]\"}"),
    ],
)  # fmt: skip
def test_a_mistake_about_arrays_is_told_at_its_place(matrix, load, given, told):
    with pytest.raises(ModelError) as refused:
        load(f"""
components:
  fmu:
    type: Fmu
    file: rich_matrix3.fmu
    period: 1 s
    {given}
{RUN}
""").check()
    found = "\n".join(map(str, refused.value.faults))
    assert re.search(told, found), found
    assert [fault.where.line for fault in refused.value.faults if fault.where] == [5 if "2000" in given else 9]
