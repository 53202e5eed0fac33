"""A contact that slips by hardly more than it may and still hold, under a load beyond its limit the other way."""

import pytest

SCENE = """
components:
  floor: {type: Ground}
  body: {type: Mass, mass: 1 kg, velocity: SPEED m/s}
  push: {type: ForceSource, force: -3 N}
  rub: {type: Contact, normal_force: 1 N, curve: 1, method: METHOD}
connections: [[floor.flange, rub.a], [body.flange, push.flange, rub.b]]
run: {stop: 1 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("method", "share"),
    [(method, share) for method in ("hold", "karnopp") for share in (0.999, 1.0000001, 1.0005, 1.0009, 1.0021, 1.01)],
)
def test_it_stops_and_breaks_away_backward(method, share, sign, engine, simulate):
    """Its slip lasts no longer than v m/(F + mu N), a microsecond: then (F - mu N)/m t."""
    sticks = {"hold": 1e-6, "karnopp": 1e-4}[method]
    text = SCENE.replace("SPEED", repr(sign * share * sticks)).replace("METHOD", method)
    result = simulate(text.replace("-3 N", f"{-3 * sign} N"), **{"run.engine": engine})
    assert result["body.v"][-1] == pytest.approx(-2.0 * sign, abs=2 * sticks)
