"""Scenes by the hundred: drawn by hypothesis from a fixed seed, and shrunk to a small one when they break something."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.errors import Flaky
from hypothesis.strategies import SearchStrategy

from tests.hard.play import Broken, Play

SEED = 20260


def many(play: Play, strategy: SearchStrategy[Any], check: Callable[[Play, Any], None], examples: int) -> None:
    """Check so many scenes. Raises Broken about the smallest found that breaks."""
    last: list[Any] = []

    @seed(SEED)
    @settings(
        max_examples=examples, database=None, deadline=None, report_multiple_bugs=False, print_blob=False,
        suppress_health_check=list(HealthCheck), phases=(Phase.generate, Phase.shrink),
    )  # fmt: skip
    @given(strategy)
    def one(drawn: Any) -> None:
        if time.perf_counter() - play.begun > play.budget:
            return  # what is left of the search for a smaller one; a scene that is stuck has said so before
        last[:] = [drawn]
        check(play, drawn)

    try:
        one()
    except Broken as broken:
        raise Broken(broken.verdict, f"{broken.reason}; smallest scene found: {last[0]}") from None
    except Flaky:
        raise Broken(
            "wrong", f"time ran out while looking for a smaller scene; the last one tried: {last[0]}"
        ) from None
    if time.perf_counter() - play.begun > play.budget:
        raise Broken("stuck", f"not all of {examples} scenes were played in {play.budget:.0f} s")
