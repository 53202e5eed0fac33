"""An exception from the contract is declared with its source, and is one: asked all the same, the law breaks it."""

import re
from dataclasses import replace

import pytest

from fairlead.component.registry import known_types
from fairlead.testing import ContractError, checks

EXCEPTIONS = [
    (word, member, name, reason)
    for word, member in known_types()["Contact"].members.items()
    for name, reason in member.answers.exempt.items()
]
SOURCE = re.compile(r"[A-Z][a-z]+.*\d{4}|docs/\w+\.md")


def test_the_exceptions_are_those_that_are_known():
    assert {(word, name) for word, _, name, _ in EXCEPTIONS} == {
        ("binding", "dissipates break_forward"), ("binding", "dissipates break_backward"),
        ("lugre", "dissipates"), ("elastoplastic", "dissipates"), ("maxwell_slip", "dissipates"),
        ("bristle", "odd"), ("bristle", "dissipates"),
    }  # fmt: skip


@pytest.mark.parametrize(
    ("word", "member", "name", "reason"), EXCEPTIONS, ids=[f"{word} {name}" for word, _, name, _ in EXCEPTIONS]
)
def test_an_exception_has_a_source_and_is_needed(monkeypatch, word, member, name, reason):
    assert SOURCE.search(reason), reason
    others = {n: r for n, r in member.answers.exempt.items() if n != name}
    monkeypatch.setattr(member, "answers", replace(member.answers, exempt=others))
    asked, _, of = name.partition(" ")
    options = [check for check in checks(member) if check.name == asked]
    options = [check for check in options if of in check.chosen.values()] or options  # an option, or else a zone
    assert any(breaks(check) for check in options), f"{word} keeps {name!r}"


def breaks(check):
    try:
        check()
    except ContractError:
        return True
    return False
