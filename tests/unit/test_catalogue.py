"""Types at a glance: by family with a sentence, innards apart; what one needs to use one, as a page and as data."""

import json
import re

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.registry import bundled
from fairlead.component.scene import is_head
from fairlead.describe import words
from fairlead.describe.catalogue import INNARDS, catalogue, innards, record, sentence, short


def command(*words):
    answer = CliRunner().invoke(app, [*words])
    assert answer.exit_code == 0, answer.output
    return answer.output


def test_types_stand_under_their_family_with_a_sentence():
    page = "\n".join(catalogue(bundled()))
    mechanics = page.partition("\nmechanics\n")[2].partition("\n\n")[0]
    assert "Spring " in mechanics
    assert "Linear spring:  tension" in mechanics or "Linear spring: tension" in mechanics
    assert "TorsionSpring" not in mechanics


def test_innards_are_apart_and_all_of_them_are_types():
    page = "\n".join(catalogue(bundled()))
    first, _, inside = page.partition("\ninnards")
    assert set(bundled()) >= INNARDS
    for name in innards(bundled()):
        assert not re.search(rf"^ +{name} ", first, re.MULTILINE)  # as a type, not as a word of a sentence
        assert name in inside
    assert {"ContinuousPi", "LateralLoad"} <= innards(bundled())
    assert not {"PiController", "Mass", "Contact", "Cable", "Route"} & innards(bundled())


@pytest.mark.parametrize("name", sorted(bundled()))
def test_every_type_has_a_sentence_and_a_short_page_with_all_that_a_netlist_gives(name):
    kind = bundled()[name]
    assert 10 < len(sentence(kind)) < 200
    page = "\n".join(short(name, kind))
    data = record(name, kind)
    for word in ("ports", "parameters", "inputs", "outputs"):
        assert all(one["name"] in page for one in data[word])
    json.dumps(data)


@pytest.mark.parametrize("name", sorted(bundled()))
def test_the_zones_that_tables_of_switches_name_stand_on_the_short_page(name):
    kind = bundled()[name]
    page = "\n".join(short(name, kind)).partition("\nzones")[2]
    for one in kind.members.values() if is_head(kind) else (kind,):
        zones = one.declaration.zones or ()
        assert len(zones) < 2 or all(zone in page for zone in zones)


def test_who_looks_for_sticking_finds_the_word_that_a_run_uses():
    switches = fairlead.load("belt").run(out=None, stop=1.0).switches()
    zones = set(switches["zone_from"]) | set(switches["zone_to"])
    told = json.loads(command("describe", "Contact", "--json"))["zones"]["hold"]
    assert "held" in zones
    assert zones <= set(told)
    assert "held" in command("describe", "Contact")


@pytest.mark.parametrize("family", ["method", "curve"])
def test_every_treatment_and_curve_is_described_by_its_word(family):
    contact = json.loads(command("describe", "Contact", "--json"))["families"][family]
    assert contact
    for word, told in contact.items():
        page = "\n".join(words.page(word, bundled()))
        assert f"{word}    {family}" in page
        assert all(one["name"] in page for one in told["parameters"])


def test_hold_is_the_treatment_and_a_bundled_model_stays_one():
    assert "held, forward, backward, off" in command("describe", "hold")
    assert "hold    method of Contact" in command("describe", "hold")
    assert "free of" in command("describe", "capstan")


def test_a_page_is_short_unless_all_is_asked_for():
    brief, whole = command("describe", "PiController"), command("describe", "PiController", "--all")
    assert "integral_time" in brief
    assert "every period, from the values before it" not in brief
    assert "every period, from the values before it" in whole


def test_a_type_is_told_as_data():
    data = json.loads(command("describe", "Contact", "--json"))
    assert {port["name"] for port in data["ports"]} == {"a", "b"}
    assert "stribeck" in data["families"]["curve"]
    assert "hold" in data["families"]["method"]
    listed = json.loads(command("describe", "types", "--json"))
    (mass,) = [row for row in listed if row["type"] == "Mass"]
    assert mass["inside"] is False
