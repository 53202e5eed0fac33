"""Libraries for other systems: what their headers tell, and what they compute where an emulator runs them."""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import zipfile

import filelock
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import UsageError
from fairlead.fmu import compiler, export, export_library, platforms
from fairlead.fmu.machine_code import machine_for
from fairlead.fmu.platforms import PLATFORMS, platforms_of
from fairlead.fmu.universal import universal
from tests.fmu.binaries import sections, told
from tests.fmu.exported import HERE, PUSHED, fmpy, in_group, model, needs_compiler

SIGNALS = ["block.x", "block.v", "pad.friction", "pad.slip"]
H, STEPS = 0.02, 200  # s; five stick-slips of the belt
OTHERS = [name for name in PLATFORMS if name != platforms.HERE]
SYSTEM = {
    "linux": {"libc.so.6", "libm.so.6"},
    "windows": {"KERNEL32.dll", *(f"api-ms-win-crt-{name}-l1-1-0.dll" for name in
                ("heap", "math", "runtime", "string", "stdio", "time", "environment"))},
    "darwin": {"/usr/lib/libSystem.B.dylib"},
}  # fmt: skip
"""What every such system has: of Windows from version 10 on."""
OF_LINKER = {"__dso_handle", "_mh_dylib_header"}
"""What a linker for macOS adds."""
WINE = ("wine64", "wine", "/usr/lib/wine/wine64")


def needs_ziglang():
    needs_compiler()
    if not platforms.has_ziglang():
        pytest.skip("ziglang is not installed, which links for other systems: pip install 'fairlead[zig]'")


@pytest.fixture(scope="module")
def belt(tmp_path_factory):
    """The belt for all systems, in one FMU, unpacked; made once for all workers."""
    fmpy()
    needs_ziglang()
    own = tmp_path_factory.getbasetemp()
    folder = (own.parent if os.environ.get("PYTEST_XDIST_WORKER") else own) / "belt_everywhere"
    with filelock.FileLock(f"{folder}.lock", timeout=3000):
        if not folder.exists():
            file = export(fairlead.load("belt"), f"{folder}.fmu", outputs=SIGNALS, engine="rodas", platforms=PLATFORMS)
            with zipfile.ZipFile(file) as archive:
                archive.extractall(folder)
    return folder


def library(folder, name):
    return folder / "binaries" / name / f"belt.{PLATFORMS[name].ending}"


@pytest.mark.slow
@pytest.mark.parametrize("name", PLATFORMS)
def test_a_library_tells_its_processor_offers_fmi_and_asks_for_what_the_system_has(belt, name):
    found = told(library(belt, name).read_bytes())
    headers = pathlib.Path(fmpy().__file__).parent / "c-code" / "fmi3Functions.h"
    of_standard = set(re.findall(r"FMI3_Export fmi3\w+TYPE\s+(fmi3\w+);", headers.read_text()))
    assert len(of_standard) > 70
    assert found.machine == name.split("-")[0]
    assert found.offered - OF_LINKER == of_standard
    assert {"calloc", "free", "strcmp"} <= found.asked
    assert found.needed <= SYSTEM[PLATFORMS[name].system]
    if name != platforms.HERE:  # there the compiler of this machine chooses
        assert all(tuple(map(int, one.split("_")[1].split("."))) <= (2, 17) for one in found.versions)


@pytest.mark.slow
def test_no_product_is_fused_with_a_sum_on_arm(belt):
    """Its processors have such instructions: scalar ones, and those of vectors by register or by element."""
    content = library(belt, "aarch64-linux").read_bytes()
    at, length, _ = sections(content)[".text"]
    words = struct.unpack_from(f"<{length // 4}I", content, at)
    kinds = ((0xFF000000, 0x1F000000), (0xBF20FC00, 0x0E20CC00), (0xBF80B400, 0x0F801000))
    assert [hex(word) for word in words for mask, fused in kinds if word & mask == fused] == []
    assert sum(word & 0xFFE0FC00 == 0x1E600800 for word in words) > 100  # products of two numbers


def c_compiler(name):
    """For a system, told the same as for a library: ziglang keeps the C library that it has made for that."""
    return [*compiler.compiler_for(PLATFORMS[name]), *(flag for flag in compiler.FLAGS if flag != "-shared"), "-s"]


@pytest.fixture
def master(belt, tmp_path):
    """master(platform, program that runs it) -> lines that our C master prints there."""
    headers = pathlib.Path(fmpy().__file__).parent / "c-code"
    token = re.search('instantiationToken="([^"]+)"', (belt / "modelDescription.xml").read_text())[1]

    def run(name, *emulator, **more):
        program = tmp_path / f"{name}.exe"
        subprocess.run([*c_compiler(name), f"-I{headers}", str(HERE / "master.c"), "-o", str(program),
                        *(["-ldl"] if name.endswith("linux") else [])],
                       check=True, timeout=compiler.PATIENCE)  # fmt: skip
        asked = [str(library(belt, name)), token, repr(H), str(STEPS), str(len(SIGNALS)), "1"]
        *lines, _ = in_group([*emulator, str(program), *asked], env=more).splitlines()
        return [[float.fromhex(text) for text in line.split()] for line in lines]

    return run


def alike(rows, own):
    """Only functions of the C library may differ, in their last digit."""
    assert len(rows) == len(own) == STEPS
    for row, other in zip(rows, own, strict=True):
        assert row == pytest.approx(other, rel=1e-9, abs=1e-12)


@pytest.mark.slow
def test_on_arm_it_goes_as_here(master):
    emulator = shutil.which("qemu-aarch64")
    libraries = pathlib.Path("/usr/aarch64-linux-gnu")
    if emulator is None or not (libraries / "lib" / "libc.so.6").exists():
        pytest.skip("qemu-aarch64 or its C library is missing (Debian: qemu-user, libc6-arm64-cross)")
    alike(master("aarch64-linux", emulator, "-L", str(libraries)), master(platforms.HERE))


@pytest.mark.slow
def test_on_windows_it_goes_as_here(master, tmp_path):
    emulator = next(filter(None, map(shutil.which, WINE)), None)
    if emulator is None:
        pytest.skip("wine is missing, which runs programs of Windows (Debian: wine64)")
    more = {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all", "PATH": os.environ["PATH"]}
    alike(master("x86_64-windows", emulator, **more), master(platforms.HERE))


@pytest.mark.slow
def test_two_exports_for_all_systems_have_the_same_bytes_whatever_their_order(tmp_path):
    needs_ziglang()
    asked = ("aarch64-darwin", "x86_64-windows", "aarch64-linux", "x86_64-darwin")
    files = [
        export(model(tmp_path, "pushed", PUSHED), tmp_path / f"{k}.fmu", platforms=order)
        for k, order in enumerate((asked, (*reversed(asked), asked[0])))
    ]
    assert files[0].read_bytes() == files[1].read_bytes()
    with zipfile.ZipFile(files[0]) as archive:
        found = {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}
    assert found == set(asked)


@pytest.mark.slow
def test_version_2_has_folders_of_its_own_and_one_file_for_both_processors_of_macos(tmp_path):
    needs_ziglang()
    asked = ["x86_64-windows", "x86_64-darwin", "aarch64-darwin", platforms.HERE]
    file = export(model(tmp_path, "pushed", PUSHED), tmp_path / "pushed.fmu", version=2, platforms=asked)
    with zipfile.ZipFile(file) as archive:
        found = {name: archive.read(name) for name in archive.namelist() if name.startswith("binaries/")}
    assert set(found) == {f"binaries/{name}" for name in
                          ("linux64/pushed.so", "win64/pushed.dll", "darwin64/pushed.dylib")}  # fmt: skip
    both = parts(found["binaries/darwin64/pushed.dylib"])
    assert [told(one).machine for one in both] == ["x86_64", "aarch64"]
    assert all("fmi2DoStep" in told(one).offered for one in both)


@pytest.mark.slow
def test_a_c_library_for_another_system_lies_in_a_folder_of_its_name_and_runs_there(tmp_path):
    needs_ziglang()
    folder = export_library(model(tmp_path, "pushed", PUSHED), tmp_path / "pushed",
                            platforms=["x86_64-windows", "aarch64-linux"])  # fmt: skip
    found = sorted(str(path.relative_to(folder)) for path in folder.rglob("*.*"))
    assert found == ["aarch64-linux/libpushed.so", "example.c", "pushed.h", "x86_64-windows/pushed.dll",
                     "x86_64-windows/pushed.lib"]  # fmt: skip
    assert "-L aarch64-linux -lpushed -Wl,-rpath,aarch64-linux " in (folder / "example.c").read_text()
    assert "pushed_advance" in told((folder / "x86_64-windows/pushed.dll").read_bytes()).offered
    arm = folder / "aarch64-linux"
    program = [*c_compiler("aarch64-linux"), str(HERE / "user.c"), "-I.", f"-L{arm}", "-lpushed", "-lm",
               f"-Wl,-rpath,{arm}", "-o", "program"]  # fmt: skip
    subprocess.run(program, cwd=folder, check=True, timeout=compiler.PATIENCE)
    emulator, libraries = shutil.which("qemu-aarch64"), pathlib.Path("/usr/aarch64-linux-gnu")
    if emulator is None or not (libraries / "lib" / "libc.so.6").exists():
        pytest.skip("qemu-aarch64 or its C library is missing (Debian: qemu-user, libc6-arm64-cross)")
    _, _, first, *_ = in_group([emulator, "-L", str(libraries), str(folder / "program")], env={}).splitlines()
    assert [float.fromhex(text) for text in first.split()] == pytest.approx([0.1, 0.2], abs=1e-9)


def parts(content):
    """The libraries in one file for several processors."""
    magic, count = struct.unpack_from(">II", content)
    assert magic == 0xCAFEBABE
    rows = [struct.unpack_from(">IIIII", content, 8 + 20 * k) for k in range(count)]
    assert all(at % (1 << align) == 0 for _, _, at, _, align in rows)
    return [content[at : at + length] for _, _, at, length, _ in rows]


def test_one_file_holds_libraries_for_several_processors():
    kinds = ((0x1000007, 3, 50), (0x100000C, 0, 9))
    one, other = (struct.pack("<III", 0xFEEDFACF, *kind) + bytes(more) for *kind, more in kinds)
    assert universal([one]) == one
    assert parts(universal([one, other])) == [one, other]


def test_systems_come_in_one_order_and_once_each():
    asked = ["x86_64-windows", "aarch64-linux", "x86_64-windows"]
    assert [one.name for one in platforms_of(asked)] == ["aarch64-linux", "x86_64-windows"]
    assert [one.name for one in platforms_of([])] == ["x86_64-linux"]


def refused(*given, **more):
    with pytest.raises(UsageError) as caught:
        export(fairlead.load("belt"), *given, outputs=["block.x"], **more)
    return str(caught.value)


def test_a_system_that_is_not_known_is_refused_with_those_that_are(tmp_path):
    said = refused(tmp_path / "no.fmu", platforms=["x86_64-window", "aarch64-linux"])
    assert "--platform x86_64-window:" in said
    assert "Did you mean x86_64-windows?" in said
    assert all(name in said for name in PLATFORMS)
    answer = CliRunner().invoke(app, ["fmu", "library", "belt", "--out", "block.x", "--platform", "sparc-solaris"])
    assert "--platform sparc-solaris" in f"{answer.exception}{answer.output}"


def test_a_system_for_which_version_2_has_no_name_is_refused(tmp_path):
    said = refused(tmp_path / "no.fmu", version=2, platforms=["aarch64-linux", "x86_64-windows"])
    assert "--platform aarch64-linux: version 2" in said
    assert "x86_64-windows" in said.split("Take version 3")[1]


@pytest.mark.parametrize("name", OTHERS)
def test_without_ziglang_it_is_told_what_to_install_whatever_else_links(tmp_path, monkeypatch, name):
    monkeypatch.setattr(compiler, "has_ziglang", lambda: False)
    monkeypatch.setenv("CC", sys.executable)
    said = refused(tmp_path / "no.fmu", platforms=[name])
    assert f"--platform {name}:" in said
    assert "fairlead[zig]" in said


def test_an_llvmlite_without_code_for_a_processor_is_named():
    strange = PLATFORMS["aarch64-linux"]._replace(triple="abacus-unknown-linux-gnu")
    with pytest.raises(UsageError, match=r"--platform aarch64-linux: the llvmlite [^\n]*\n.*pip install -U llvmlite"):
        machine_for(strange)
