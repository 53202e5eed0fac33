"""Throughput of a sweep beside a bare loop that runs on all cores at once, and whether memory stays flat.

    python -m benchmarks.sweeps [--belt 10000] [--bend 300] [--processes 2]

The bare loop is `Cases.row` over the same cases, in as many processes, without pipes and table. Time counts from the
first row of each process on. CPU is that of all processes in the same stretch, for machines that others share. Memory
is what the processes hold (RSS) after a fifth of the cases and at the end.
"""

import argparse
import multiprocessing
import os
import tempfile
import time
from pathlib import Path

import fairlead
from fairlead.cases import Cases
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.ranges import read_range
from fairlead.studies.sweeps.sweep import sweep

PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096
TICK = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100


def resident() -> float:
    """MB that this process and its children hold."""
    return sum(int(Path(f"/proc/{pid}/statm").read_text().split()[1]) for pid in _family()) * PAGE / 1e6


def cpu() -> float:
    """Seconds of processor of this process and its children."""
    fields = (Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split() for pid in _family())
    return sum(int(each[11]) + int(each[12]) for each in fields) / TICK


def _family() -> list[int]:
    return [os.getpid(), *(one.pid for one in multiprocessing.active_children())]


def bare(cases, mine, begin, results) -> None:
    cases.row(mine[0])
    begin.wait()
    wall, used = time.perf_counter(), time.process_time()
    for values in mine[1:]:
        cases.row(values)
    results.put((len(mine) - 1, time.perf_counter() - wall, time.process_time() - used))


def bare_loop(cases, design, processes) -> tuple[float, float]:
    """(cases per second, CPU seconds per case)."""
    context = multiprocessing.get_context("spawn")
    begin, results, every = context.Barrier(processes), context.Queue(), list(design.cases())
    crew = [context.Process(target=bare, args=(cases, every[k::processes], begin, results)) for k in range(processes)]
    for one in crew:
        one.start()
    told = [results.get(timeout=3600) for _ in crew]
    for one in crew:
        one.join()
    count = sum(one[0] for one in told)
    return count / max(one[1] for one in told), sum(one[2] for one in told) / count


def swept(cases, design, processes) -> tuple[float, float, float, float]:
    """(cases per second, CPU seconds per case, MB after a fifth, MB at the end)."""
    marks = {}

    def watch(now) -> None:
        for name, count in (("first", processes), ("fifth", design.count // 5), ("last", design.count - processes)):
            if now.done == count:
                marks[name] = (now.done, time.perf_counter(), cpu(), resident())

    with tempfile.TemporaryDirectory() as folder:
        sweep(cases, design, Path(folder), processes=processes, watch=watch)
    first, fifth, last = marks["first"], marks["fifth"], marks["last"]
    count = last[0] - first[0]
    return count / (last[1] - first[1]), (last[2] - first[2]) / count, fifth[3], last[3]


def main() -> None:
    parser = argparse.ArgumentParser()
    for name, count in (("belt", 10_000), ("bend", 300), ("processes", 2)):
        parser.add_argument(f"--{name}", type=int, default=count)
    asked = parser.parse_args()
    belt = Cases(fairlead.load("belt"), {"end": "end(block.x)", "switches of the pad": "switches(pad)"})
    bend = Cases(fairlead.load("single_bend"), {"peak": "peak(haul.force)"})
    rows = (
        ("belt", belt, {"pad.normal_force": read_range(f"lin(8 N, 12 N, {asked.belt})")}, asked.belt),
        ("single_bend", bend, {"mu": read_range(f"lin(0.2, 0.7, {asked.bend})")}, asked.bend),
    )
    for name, cases, grid, count in rows:
        if count < 10:
            continue
        loop = bare_loop(cases, Design(grid=grid), asked.processes)
        found = swept(cases, Design(grid=grid), asked.processes)
        print(f"{name}, {count} cases, {asked.processes} processes")
        print(f"    cases a second: bare loop {loop[0]:.3g}, sweep {found[0]:.3g}: {found[0] / loop[0]:.2f} times")
        print(f"    CPU of a case [ms]: {1e3 * loop[1]:.3g}, {1e3 * found[1]:.3g}: {found[1] / loop[1]:.2f} times")
        memory = f"{found[2]:.0f} after a fifth, {found[3]:.0f} at the end: {found[3] / found[2]:.3f} times"
        print(f"    memory [MB]: {memory}")


if __name__ == "__main__":
    main()
