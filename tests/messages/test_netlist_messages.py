"""Every mistake in a netlist file is named at its place with what is allowed; none is a traceback."""
# ruff: noqa: E501 - the table of seeded mistakes reads best with one mistake a line

import os

import pytest

import fairlead
from fairlead.errors import ModelError
from fairlead.netlist import load

GOOD = """\
schema: 1
name: belt
parameters:
  mu: 0.35
  speed: 0.1 m/s
components:
  spring:
    type: Spring
    stiffness: 100 N/m
  pad: {type: Friction, coulomb_force: "{2*mu} N"}
  wall: {type: Ground}
connections:
  - [wall.flange, spring.a]
  - [spring.b, pad.a]
run: {stop: 20 s}
record: {signals: ["*"], every: 10 ms}
"""


def message(tmp_path, text, overrides=None, name="belt.yaml"):
    """The whole message of a netlist with this text (or these bytes), with the folder's name taken out."""
    file = tmp_path / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(ModelError) as caught:
        load(file, overrides or {})
    assert caught.value.exit_code == 1
    assert len(str(caught.value)) < 100_000
    return str(caught.value).replace(f"{tmp_path}{os.sep}", "")


def test_the_good_netlist_is_good(tmp_path):
    (tmp_path / "belt.yaml").write_text(GOOD)
    assert load(tmp_path / "belt.yaml").name == "belt"


# (what stands in the good netlist, what a hurried user writes instead, the message)
SEEDED = [
    ('{type: Friction, coulomb_force: "{2*mu} N"}', "{type: Friction, coulomb_force: 2,5 N}", "belt.yaml:10:40: pad.coulomb_force = 2,5 N: a comma ends an entry\n    Write a decimal point, not a decimal comma: 2.5 N."),
    ('{type: Friction, coulomb_force: "{2*mu} N"}', "{type: Friction, coulomb_force: -2,5e3 N}", "belt.yaml:10:40: pad.coulomb_force = -2,5e3 N: a comma ends an entry\n    Write a decimal point, not a decimal comma: -2.5e3 N."),
    ("run: {stop: 20 s}", "run: {stop: 20,5 s, accuracy: 1e-5}", "belt.yaml:15:13: run.stop = 20,5 s: a comma ends an entry"),
    ("wall: {type: Ground}", "wall {type: Ground}", "belt.yaml:11:3: wall: a colon is missing before the brace\n    Write wall: {type: Ground}."),
    ("wall: {type: Ground}", "wall{type: Ground}", "belt.yaml:11:3: wall: a colon is missing before the brace"),
    ("pad: {type", "pad {type", "belt.yaml:10:3: not YAML: pad: a colon is missing before the brace\n    Write pad: {type: ...}."),
    ("wall: {type: Ground}", "wall: {type:Ground}", "belt.yaml:11:10: wall.type:Ground: a space is missing behind the colon\n    Write type: Ground."),
    ("stiffness: 100 N/m", "stiffness:100 N/m", "belt.yaml:9:5: not YAML: stiffness: a space is missing behind the colon\n    Write stiffness: 100 N/m"),
    ("  pad: {", " pad: {", "belt.yaml:10:2: not YAML: pad is indented to column 2, the entry above it to column 5\n    Entries of one map are indented alike."),
    ("[spring.b, pad.a]", "[spring.b, pad.a", "belt.yaml:14:5: not YAML: this [ is not closed, as line 15 shows\n    Put ] where it ends."),
    ('["*"], every', '["*", every', "belt.yaml:16:19: not YAML: this [ is not closed, as column 37 shows"),
    ("run: {stop: 20 s}", "run: {stop: 20 s", "belt.yaml:15:6: not YAML: this { is not closed, as line 16 shows\n    Put } where it ends."),
    ("stop: 20 s", "stop: '20'", "belt.yaml:15:13: run.stop = '20' is a text, for it is in quotes\n    Leave out the quotes, or give its unit too: 20 s."),
    ('"{2*mu} N"', '"{2*mu/0} N"', "{2*mu/0}: division by zero\n    What it is divided by is zero; give a number other than zero there."),
    ('"{2*mu} N"', '"{2*mu*3 N}"', "pad.coulomb_force: {2*mu*3 N}: this is not arithmetic\n    A quantity in an expression stands in parentheses: (1 m)."),
    ('"{2*mu} N"', '"{2*mu*(3 Nm)}"', "pad.coulomb_force: {2*mu*(3 Nm)}: 3 Nm: Nm is not a known unit"),
    ("schema: 1\n", "", "belt.yaml:1:1: schema is missing"),
    ("schema: 1", "schema: 2", "belt.yaml:1:9: schema = 2 is not 1\n    Write schema: 1."),
    ("schema: 1", "schema: '1'", "belt.yaml:1:9: schema = '1' is not 1"),
    ("components:", "component:", "belt.yaml:6:1: a netlist has no key component\n    Did you mean components?"),
    ("name: belt", "name: 12", "belt.yaml:2:7: name = 12 is not a text\n    Put it in quotes"),
    ("name: belt", "name: [a]", "belt.yaml:2:7: name = a list of 1 is not a text"),
    ("name: belt", "name: belt\nname: strap", "belt.yaml:3:1: name is given twice\n    It stands at belt.yaml:2:1"),
    ("name: belt", 'name: "../up"', "belt.yaml:2:7: name: ../up is no name for a scene\n    Results go to a folder of that"),
    ("name: belt", 'name: "[red]x"', "belt.yaml:2:7: name: [red]x is no name for a scene"),
    ("  wall:", "  pad:", "belt.yaml:11:3: pad is given twice\n    It stands at belt.yaml:10:3 already."),
    ("100 N/m", "100 N/m\n    stiffness: 3", "belt.yaml:10:5: stiffness is given twice"),
    ("type: Spring", "tpye: Spring", "belt.yaml:7:3: spring.type is missing\n    Is tpye a misspelling of it?"),
    ("type: Spring", "type: 3", "belt.yaml:8:11: spring.type = 3 is not a text"),
    ("{type: Ground}", "Ground", "belt.yaml:11:9: wall = Ground is not a map"),
    ("wall: {type: Ground}", "Wall: {type: Ground}", "belt.yaml:11:3: Wall is not a component name; names are lower"),
    ("wall: {type: Ground}", "endWall-2: {type: Ground}", "\n    Write it as end_wall_2."),
    ("wall: {type: Ground}", "2: {type: Ground}", "2 is not a component name"),
    ("[spring.b, pad.a]", "[sprin.b, pad.a]", "belt.yaml:14:6: sprin.b: there is no component sprin\n    Did you mean sp"),
    ("[spring.b, pad.a]", "[spring, pad.a]", "belt.yaml:14:6: spring is a component, not a port\n    Write one of its ports, spring"),
    ("[spring.b, pad.a]", "[spring.b]", "belt.yaml:14:5: connections[1] is a list of 1; at least 2 needed"),
    ("[spring.b, pad.a]", "[]", "belt.yaml:14:5: connections[1] is an empty list; at least 2 needed"),
    ("[spring.b, pad.a]", "[pad.a, pad.a]", "belt.yaml:14:13: pad.a is connected to itself"),
    ("[spring.b, pad.a]", "spring.b, pad.a", "belt.yaml:14:5: connections[1] = spring.b, pad.a is not a list"),
    ("[spring.b, pad.a]", "[spring.b, 3]", "belt.yaml:14:16: connections[1][1] = 3 is not a text"),
    ("mu: 0.35", "mu:", "belt.yaml:4:6: parameters.mu = nothing is not a parameter"),
    ("mu: 0.35", "mu: [1]", "belt.yaml:4:7: parameters.mu = a list of 1 is not a parameter"),
    ("mu: 0.35", "sin: 0.35", "belt.yaml:4:3: parameters: sin is a word of the arithmetic"),
    ("mu: 0.35", "lambda: 0.35", "belt.yaml:4:3: parameters: lambda is not a name"),
    ("mu: 0.35", "friction factor: 0.35", "belt.yaml:4:3: parameters: friction factor is not a name"),
    ("0.1 m/s", "0.1 m/ss", "belt.yaml:5:10: parameters.speed = 0.1 m/ss: ss is not a known unit"),
    ("0.1 m/s", '"{nu} m/s"', "belt.yaml:5:10: parameters.speed: {nu}: there is no parameter nu\n    Did you mean mu?"),
    ("0.1 m/s", '"{speed}"', "belt.yaml:5:10: parameters need each other in a circle: speed -> speed"),
    ("mu: 0.35", 'mu: "{nu}"\n  nu: "{mu}"', "parameters need each other in a circle: "),
    ('"{2*mu} N"', '"{2*nu} N"', "belt.yaml:10:40: pad.coulomb_force: {2*nu}: there is no parameter nu\n    Did you mean mu?"),
    ('"{2*mu} N"', "{mu}", 'belt.yaml:10:40: pad.coulomb_force: {mu} without quotes is a map in YAML\n    Put an expression in quotes: "{mu}".'),
    ('"{2*mu} N"', "{2*mu} N", 'belt.yaml:10:47: not YAML'),
    ('"{2*mu} N"', "{2*mu} N", 'An expression goes in quotes: "{2*mu} N".'),
    ('"{2*mu} N"', '"2*{mu} N"', "belt.yaml:10:40: pad.coulomb_force: 2*{mu} N is not an expression"),
    ('"{2*mu} N"', '"{2*mu N"', "is not an expression"),
    ('"{2*mu} N"', '"{2^mu} N"', "Write ** for a power."),
    ('"{2*mu} N"', '"{speed} N"', "belt.yaml:10:40: pad.coulomb_force: {speed} N has two units, m/s from its parameters and N"),
    ("run: {stop: 20 s}\n", "", "belt.yaml:1:1: run is missing\n    How far and how exactly to run, such as run: {stop: 20"),
    ("{stop: 20 s}", "{}", "belt.yaml:15:1: run.stop is missing\n    Time at which the run ends, as in `stop: 10 s`."),
    ("{stop: 20 s}", "{stpo: 20 s}", "belt.yaml:15:7: run has no key stpo\n    Did you mean stop? Known keys are stop, start"),
    ("{stop: 20 s}", "20 s", "belt.yaml:15:6: run = 20 s is not a map"),
    ("20 s", "20 kg", "belt.yaml:15:13: run.stop = 20 kg is a mass, not a time\n    Write a time such as 10 ms"),
    ("20 s", "20s", "belt.yaml:15:13: run.stop = 20s is not a quantity\n    Put a space before the unit: 20 s."),
    ("20 s", ".inf", "belt.yaml:15:13: run.stop = inf is not finite"),
    ("20 s", ".nan", "belt.yaml:15:13: run.stop = nan is not finite"),
    ("20 s", "1e-30 s", "belt.yaml:15:13: run.stop = 1e-30 s is 1e-30 s after start = 0 s\n    A run lasts 1e-12 s at least"),
    ("20 s", "1e6 s, start: 999999.9999999 s", "belt.yaml:15:13: run.stop = 1000000 s is 1e-07 s after start = 999999.9999999 s\n    A run lasts 1e-06 s"),
    ("20 s", "-1 s", "belt.yaml:15:13: run.stop = -1 s is not after start = 0 s"),
    ("20 s", "yes", "belt.yaml:15:13: run.stop = yes is not a quantity"),
    ("20 s", "true", "belt.yaml:15:13: run.stop = true is not a time"),
    ("20 s", "20 s, accuracy: 2", "belt.yaml:15:29: run.accuracy = 2 is above 0.1"),
    ("20 s", "20 s, accuracy: 1e-13", "belt.yaml:15:29: run.accuracy = 1e-13 is below 1e-12"),
    ("20 s", "20 s, accuracy: high", "belt.yaml:15:29: run.accuracy = high is not a quantity\n    A quantity is a finite"),
    ("20 s", "20 s, engine: rodass", "run.engine = rodass is not known\n    Did you mean rodas? Allowed are auto, rodas, stepping, ida."),
    ("20 s", "20 s, method: stepping", "run.method = stepping is not known\n    It is a word of run.engine. Allowed are auto, rodas5p, rodas3p."),
    ("20 s", "20 s, chatter: no", "run.chatter = no is not known\n    Allowed are warn, hold, stop."),
    ("20 s", "20 s, max_steps: 1.5", "run.max_steps = 1.5 is not a whole number"),
    ("20 s", "20 s, max_steps: 0", "run.max_steps = 0 is not above 0"),
    ("20 s", "20 s, max_steps: '1.5'", "run.max_steps = '1.5' is not a whole number"),
    ("20 s", "20 s, max_events: 1e30", "run.max_events = 1e+30 is above 1e+12"),
    ("20 s", "20 s, max_wall: 0 s", "run.max_wall = 0 s is not above 0"),
    ("10 ms", "10 mm", "belt.yaml:16:33: record.every = 10 mm is a length, not a time"),
    ('["*"]', "[*]", "belt.yaml:16:"),
    ('["*"]', "[*.x]", 'goes in quotes: "*.tension"'),
    ('["*"]', "line.*", "belt.yaml:16:19: record.signals = line.* is not a list\n    Write it as [a, b]."),
    ("10 ms", "10 ms, plots: [{}]", "record.plots[0].signals is missing"),
    ("10 ms", '10 ms, plots: [{signals: ["*"], kind: maps}]', "record.plots[0].kind = maps is not known\n    Did you mean map?"),
    ("10 ms", '10 ms, plots: [{signals: ["*"], along: "*"}]', "`along` and `between` belong to a map; give kind: map"),
    ("10 ms", '10 ms, plots: [{signals: ["*"], kind: map, between: [0 m, 1 m]}]', "give the signals that tell them under `along`"),
    ("10 ms", '10 ms, plots: [{signals: ["*"], kind: map, along: "*", between: [2 m, 1 m]}]', "between: 2 m is not below 1 m"),
    ("10 ms", '10 ms, plots: [{signals: ["*"], kind: map, along: "*", between: [0 s, 1 m]}]', "0 s is a time, not a length"),
    ("10 ms", "10 ms, plots: [{signals: []}]", "record.plots[0].signals is an empty list; at least 1 needed"),
    ("record:", "friction: 3\nrecord:", "belt.yaml:16:11: friction = 3 is not a map"),
    ("record:", "frictoin: {}\nrecord:", "belt.yaml:16:1: a netlist has no key frictoin\n    Did you mean friction?"),
    ("record:", "include: other.yaml\nrecord:", "belt.yaml:16:10: include = other.yaml is not a list"),
    ("record:", "include: [other.yaml]\nrecord:", "belt.yaml:16:11: other.yaml: there is no such file"),
    ("record:", "include: [/etc/passwd]\nrecord:", "belt.yaml:16:11: /etc/passwd is not a relative path"),
    ("record:", "include: [../x.yaml]\nrecord:", "../x.yaml leads out of the folder of the netlist"),
    ("record:", "include: [C:x.yaml]\nrecord:", "C:x.yaml is not a relative path"),
    ("record:", "include: [belt.yaml]\nrecord:", "include goes round in a circle: belt.yaml -> belt.yaml"),
    ("record:", "x: &x {a: 1}\ny: {<<: *x}\nrecord:", "<<: merge keys are not part of YAML 1.2"),
    ("{type: Ground}", "!!python/name:os.system {type: Ground}", "tag tag:yaml.org,2002:python/name:os.system is not"),
    ("spring.b,", "line.core[2].b,", 'A path with brackets goes in quotes inside [ ]: "line.core[2].tension".'),
    ("  mu: 0.35", "\tmu: 0.35", "belt.yaml:4:1: not YAML"),
    ("  mu: 0.35", "\tmu: 0.35", "Indent with spaces; YAML takes no tabs."),
    ("wall: {type: Ground}", "wall: {type: Ground", "not YAML"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("right", "wrong", "expected"), SEEDED, ids=[f"{wrong} for {right}" for right, wrong, _ in SEEDED]
)
def test_a_seeded_mistake_is_named_at_its_place_with_a_way_out(tmp_path, right, wrong, expected):
    assert right in GOOD
    assert expected in message(tmp_path, GOOD.replace(right, wrong, 1))


def test_all_mistakes_are_reported_at_once_in_the_order_of_the_file(tmp_path):
    text = GOOD.replace("schema: 1", "schema: 2").replace("name", "nmae").replace("spring.b", "sprig.b")
    text = text.replace("20 s", "20 kg").replace("10 ms", "-1 ms")
    lines = [line for line in message(tmp_path, text).splitlines() if line.startswith("belt.yaml")]
    assert [line.split(":")[1] for line in lines] == ["1", "2", "14", "15", "16"]


def test_a_mistake_is_not_echoed_by_later_stages(tmp_path):
    text = GOOD.replace("20 s", '"{nu} s"').replace("0.1 m/s", "0.1 m/ss").replace("{2*mu} N", "{2*speed}")
    found = message(tmp_path, text)
    assert found.count("belt.yaml:15:13") == 1
    assert "parameter speed has a mistake, at belt.yaml:5:10" in found


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("", "belt.yaml: this file is empty\n    A netlist begins with schema: 1."),
        ("# nothing yet\n", "belt.yaml: this file is empty"),
        ("~\n", "this file is empty"),
        ("hello\n", "belt.yaml:1:1: this is not a netlist: the file holds the text hello"),
        ("- a\n- b\n", "belt.yaml:1:1: this is not a netlist: the file holds a list of 2"),
        ("{}", "belt.yaml:1:1: schema is missing"),
        (b"\x89PNG\r\n\x1a\n\x00", "belt.yaml:1:1: not a text in UTF-8: byte 0x89"),
        (b"a: 1\nb: \x00\n", "belt.yaml:2:4: not a text file: it holds the control character U+0000"),
        ("schema: 1".encode("utf-16"), "belt.yaml:1:1: not a text in UTF-8: byte 0xff\n    It is in UTF-16; save it in UTF-8."),
        ("schema: 1\n---\nschema: 1\n", "belt.yaml:2:1: a second document begins here"),
        (b"\x7fELF" + bytes(range(32)) * 10, "not a text file"),
        ("[" * 1_000_000, "belt.yaml:1:65: nested more than 64 levels deep"),
        ("- " * 1_000_000, "nested more than 64 levels deep"),
        ("a: " + "x" * 3_000_000, "a netlist has no key a"),
        ("x" * 3_000_000 + ": 1", "not YAML"),
        ("a: " + "9" * 3_000_000, "a number of so many digits cannot be held"),
        ("a: [" + ", ".join(f"&a{i} 1" for i in range(100_000)) + "]", "more than 1000 anchors"),
        ("a: &a 1\nb: [" + ", ".join("*a" for _ in range(500_000)) + "]", "more than 1000 aliases"),
        (":" * 100_000, "not YAML"),
        ("\n" * 1_000_000, "this file is empty"),
    ],
)
def test_a_hostile_file_ends_in_a_message(tmp_path, content, expected):
    assert expected in message(tmp_path, content)


def test_a_file_of_a_hundred_megabytes_is_refused_unread(tmp_path):
    with (tmp_path / "big.yaml").open("wb") as stream:
        stream.truncate(100_000_000)
    with pytest.raises(ModelError, match=r"this file has 100\.0 MB; a netlist has at most 4 MB"):
        load(tmp_path / "big.yaml")


def test_a_million_anchors_are_refused(tmp_path):
    text = "a:\n" + "".join(f"- &a{i} 1\n" for i in range(1_000_000))
    assert "MB" in message(tmp_path, text)


def test_a_thousand_mistakes_are_counted_and_a_hundred_printed(tmp_path):
    found = message(tmp_path, GOOD + "".join(f"name: {i}\n" for i in range(1000)))
    assert found.endswith("... and 900 more mistakes.")


def test_a_folder_a_device_and_a_missing_file_are_named(tmp_path):
    (tmp_path / "belt.yaml").write_text(GOOD)
    with pytest.raises(ModelError, match="this is a folder, not a netlist"):
        load(tmp_path)
    with pytest.raises(ModelError, match=r"no such file or bundled model\n    Did you mean .*belt.yaml\?"):
        load(tmp_path / "blet.yaml")
    with pytest.raises(ModelError, match="no such file"):
        load(tmp_path / ("x" * 5000))
    with pytest.raises(ModelError, match="not the name of a file"):
        load("a\0b")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes exist on POSIX only")
def test_a_named_pipe_is_refused_and_does_not_hang(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    with pytest.raises(ModelError, match="not a regular file"):
        load(tmp_path / "pipe.yaml")
    text = GOOD + "include: [pipe.yaml]\n"
    assert "pipe.yaml is not a regular file" in message(tmp_path, text)


@pytest.mark.skipif(os.name == "nt", reason="links need rights on Windows")
def test_a_link_does_not_lead_out_of_the_folder(tmp_path):
    scene = tmp_path / "scene"
    scene.mkdir()
    (tmp_path / "secret.yaml").write_text("schema: 1\n")
    (scene / "link.yaml").symlink_to(tmp_path / "secret.yaml")
    (scene / "loop.yaml").symlink_to(scene / "loop.yaml")
    (scene / "up").symlink_to(tmp_path)
    found = message(
        scene, GOOD + "include: [link.yaml, up/secret.yaml, loop.yaml, 'a\\0b', sub/../../secret.yaml]\n"
    )
    assert found.count("leads out of the folder of the netlist") == 3
    assert "loop.yaml" in found


def test_a_circle_of_includes_is_named_link_by_link(tmp_path):
    (tmp_path / "b.yaml").write_text("schema: 1\ninclude: [c.yaml]\n")
    (tmp_path / "c.yaml").write_text("schema: 1\ninclude: [belt.yaml]\n")
    found = message(tmp_path, GOOD + "include: [b.yaml]\n")
    assert "c.yaml:2:11: include goes round in a circle: belt.yaml -> b.yaml -> c.yaml -> belt.yaml" in found


def test_a_component_in_two_files_is_named_with_both_places(tmp_path):
    (tmp_path / "part.yaml").write_text("schema: 1\ncomponents:\n  pad: {type: Mass}\n")
    found = message(tmp_path, GOOD + "include: [part.yaml]\n")
    assert "belt.yaml:10:3: pad is given twice\n    It stands at part.yaml:3:3 already" in found


def test_mistakes_of_an_included_file_stand_at_its_own_lines(tmp_path):
    part = (
        "schema: 1\nrun: {stop: 1}\ncomponents:\n  mass: {tipe: Mass}\n  m2: {type: Mass, mass: '{nu} kg'}\n"
    )
    (tmp_path / "part.yaml").write_text(part)
    found = message(tmp_path, GOOD + "include: [part.yaml]\n")
    assert "part.yaml:2:1: an included file has no key run" in found
    assert found.count("part.yaml:4:3: mass.type is missing") == 1
    assert "part.yaml:5:26: m2.mass: {nu}: there is no parameter nu" in found


def test_a_tree_of_includes_has_a_bound(tmp_path):
    for i in range(100):
        (tmp_path / f"p{i}.yaml").write_text(f"schema: 1\ninclude: [p{i + 1}.yaml]\n")
    (tmp_path / "p100.yaml").write_text("schema: 1\n")
    assert "one file too many" in message(tmp_path, GOOD + "include: [p0.yaml]\n")


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("nu", "0.6", "--set: nu: there is no parameter nu\n    Did you mean mu?"),
        (
            "pda.coulomb_force",
            "1",
            "--set: pda.coulomb_force: there is no component or block pda\n    Did you mean pad?",
        ),
        (
            "pad",
            "1",
            "--set: pad is not a parameter of the netlist\n    It is a component; name one of its parameters",
        ),
        ("run.stpo", "1", "--set: run has no key stpo\n    Did you mean stop?"),
        ("run.stop", "0", "--set: run.stop = 0 s is not after start = 0 s"),
        ("run.start", "30 s", "--set: run.stop = 20 s is not after start = 30 s"),
        ("run.stop", "1e-30", "--set: run.stop = 1e-30 s is 1e-30 s after start = 0 s"),
        ("run.stop", "3 kg", "--set: run.stop = 3 kg is a mass, not a time"),
        ("run.stop.x", "1", "--set: run.stop.x: 20 s at belt.yaml:15:13 has no part x"),
        ("mu", "1e999", "--set: mu = 1e999: beyond the largest number"),
        ("mu", "0.6 m/ss", "--set: parameters.mu = 0.6 m/ss: ss is not a known unit"),
        ("mu", "", "--set: parameters.mu = nothing is not a parameter"),
        ("pad..x", "1", "--set: pad..x is not a path"),
        ("", "1", "is not a path"),
        ("mu", "9" * 5000, "at most 1000 characters"),
        ("parameters.nu", "1", "there is no"),
        ("connections.0", "1", "there is no component or block connections"),
        ("pad.curve", "{curve: coulomb, mu: 1}", "is a map; one value is set at a time\n    Set its entries one by one, each by"
         " its path: pad.curve.curve."),
        ("pad.curve", '{ "curve":coulomb', "is a map; one value is set at a time"),
        ("record.signals", "[a, b]", "is a list; one value is set at a time\n    Write it in the netlist"),
        ("spring.stiffness", "{nu}", "--set: spring.stiffness: {nu}: there is no parameter nu"),
    ],
)
def test_an_override_that_fits_nowhere_is_named(tmp_path, name, text, expected):
    assert expected in message(tmp_path, GOOD, {name: text})


@pytest.mark.parametrize("entry", ["wall: {}", "wall: Ground", "wall:"])
def test_a_component_without_a_type_is_one_mistake(tmp_path, entry):
    """Not also one of each connection and signal that names it."""
    file = tmp_path / "belt.yaml"
    text = GOOD.replace("  pad: {type: Friction, coulomb_force: \"{2*mu} N\"}\n", "").replace("wall: {type: Ground}", entry)
    text = text.replace("  - [spring.b, pad.a]\n", "").replace('["*"]', "[wall.force]")
    file.write_text(text.replace("run: {stop", "limits: {wall.force: {below: 1 N}}\nrun: {stop"))
    with pytest.raises(ModelError) as caught:
        fairlead.load(file).check()
    assert [one.what.split(" is ")[0].split(" = ")[0].split(".")[0] for one in caught.value.faults] == ["wall"]
