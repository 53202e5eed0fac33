"""Start speeds round gears of three shafts: what is given stays, and the others take those of least energy that fit.

With a row  a + sum c_k v_k = 0  and moments m_k the least of  sum m_k v_k^2  is at  v_k = -a (c_k/m_k)/sum(c_j^2/m_j).
"""

from __future__ import annotations

import pytest

from fairlead.errors import ModelError

ENGINES = ("rodas", "stepping", "ida")

THREE = """
    components:
      {j}: {{type: Inertia, moment: 1 kg*m^2{given_j}}}
      {k}: {{type: Inertia, moment: 2 kg*m^2{given_k}}}
      {l}: {{type: Inertia, moment: 3 kg*m^2{given_l}}}
      {g}: {{type: {gear}}}
    connections: [[{j}.shaft, {g}.{first}], [{g}.{second}, {k}.shaft], [{g}.{third}, {l}.shaft]]
    run: {{stop: 0.1 s, accuracy: 1e-6}}
"""
PLANETARY = {"gear": "Planetary, ratio: 3", "first": "sun", "second": "ring", "third": "carrier"}
DIFFERENTIAL = {"gear": "Differential", "first": "left", "second": "right", "third": "case"}
NAMES = {"j": "j", "k": "k", "l": "l", "g": "g"}


def least(given, others):
    """Speeds of others (c, m), by the row that `given` enters with its coefficient times speed."""
    share = given / sum(c * c / m for c, m in others)
    return [-share * c / m for c, m in others]


CASES = {
    "sun": (PLANETARY, "j", 5.0, [5.0, *least(5.0, [(3, 2), (-4, 3)])]),
    "ring": (PLANETARY, "k", 5.0, [(s := least(15.0, [(1, 1), (-4, 3)]))[0], 5.0, s[1]]),
    "carrier": (PLANETARY, "l", -2.0, [*least(8.0, [(1, 1), (3, 2)]), -2.0]),
    "left": (DIFFERENTIAL, "j", 5.0, [5.0, *least(5.0, [(1, 2), (-2, 3)])]),
    "case": (DIFFERENTIAL, "l", 10.0, [*least(-20.0, [(1, 1), (1, 2)]), 10.0]),
}


def text(gear, who, speed, names=NAMES):
    given = {f"given_{one}": f", speed: {speed} rad/s" if one == who else "" for one in "jkl"}
    return THREE.format(**gear, **given, **names)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("case", CASES)
def test_what_is_given_stays_and_the_others_take_least_energy(simulate, engine, case):
    gear, who, speed, right = CASES[case]
    result = simulate(text(gear, who, speed), **{"run.engine": engine})
    for row in (0, -1):
        assert [result[f"{one}.speed"][row] for one in "jkl"] == pytest.approx(right, rel=1e-9)


def test_names_do_not_matter(simulate):
    gear, who, speed, right = CASES["sun"]
    result = simulate(text(gear, who, speed, {"j": "z", "k": "y", "l": "a", "g": "b"}))
    assert [result[f"{one}.speed"][0] for one in "zya"] == pytest.approx(right, rel=1e-9)


def test_two_gears_in_a_row_fit_together(simulate):
    result = simulate("""
        components:
          j: {type: Inertia, moment: 1 kg*m^2, speed: 5 rad/s}
          k: {type: Inertia, moment: 2 kg*m^2}
          l: {type: Inertia, moment: 3 kg*m^2}
          m: {type: Inertia, moment: 4 kg*m^2}
          n: {type: Inertia, moment: 5 kg*m^2}
          g: {type: Planetary, ratio: 3}
          h: {type: Planetary, ratio: 2}
        connections:
          - [j.shaft, g.sun]
          - [g.ring, k.shaft]
          - [g.carrier, l.shaft, h.sun]
          - [h.ring, m.shaft]
          - [h.carrier, n.shaft]
        run: {stop: 0.1 s, accuracy: 1e-6}
    """)
    j, k, l, m, n = (result[f"{one}.speed"][0] for one in "jklmn")
    assert j == pytest.approx(5.0, rel=1e-12)
    assert j + 3 * k == pytest.approx(4 * l, rel=1e-9)
    assert l + 2 * m == pytest.approx(3 * n, rel=1e-9)
    # where energy is least its slope is a sum of both rows:  2 k = 3 p,  3 l = -4 p + q,  4 m = 2 q,  5 n = -3 q
    p, q = 2 * k / 3, 2 * m
    assert 3 * l == pytest.approx(-4 * p + q, rel=1e-9)
    assert 5 * n == pytest.approx(-3 * q, rel=1e-9)


def test_a_member_without_inertia_follows(simulate):
    result = simulate("""
        components:
          j: {type: Inertia, moment: 1 kg*m^2, speed: 5 rad/s}
          l: {type: Inertia, moment: 3 kg*m^2}
          g: {type: Planetary, ratio: 3}
          d: {type: RotationalDamper, damping: 1 N*m*s/rad}
          h: {type: Housing}
        connections: [[j.shaft, g.sun], [g.ring, d.a], [d.b, h.shaft], [g.carrier, l.shaft]]
        run: {stop: 1 us, accuracy: 1e-6}
    """)
    assert result["j.speed"][0] == pytest.approx(5.0, rel=1e-6)
    assert result["l.speed"][0] == pytest.approx(0.0, abs=1e-5)


def test_all_given_and_not_alike_is_refused_and_says_that_one_may_be_left_out(scene):
    text_ = THREE.format(
        **PLANETARY, **NAMES, given_j=", speed: 5 rad/s", given_k=", speed: 3 rad/s", given_l=", speed: 1 rad/s"
    )
    with pytest.raises(ModelError, match=r"at 3 speeds of which one follows, [\s\S]*leave out one of them"):
        scene(text_).run(out=None)
