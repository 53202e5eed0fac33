"""Throughput of a sweep beside a bare loop that runs on all cores at once, and whether memory stays flat.

    python -m benchmarks.sweeps [--belt 10000] [--bend 300] [--processes 2] [--slices 10]

The bare loop is `Cases.row` over the same cases in as many processes of its own, without pipes and table. Both go by
turns, a slice of the cases each, so that what else the machine does meets both alike; whoever waits for its turn
sleeps. A slice of the sweep ends when all its processes are at rest. CPU is that of all processes of either, the first
one of the sweep included. Memory is what the processes of the sweep hold (RSS) after a fifth of the cases and at the
end. The first cases, on which every process makes its code ready, count for neither.
"""

import argparse
import multiprocessing
import os
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

import fairlead
from fairlead.cases import Cases
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.farm import Farm
from fairlead.studies.sweeps.ranges import read_range
from fairlead.studies.sweeps.sweep import sweep

PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096
TICK = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100
AT_REST, LOOK = 0.05, 0.002  # s: so long nobody runs; time between two looks
COLUMNS = ("scene", "cases", "cases a second: bare loop", "sweep", "ratio (slices)", "CPU of a case [ms]: bare loop",
           "sweep", "ratio", "memory [MB] after a fifth", "at the end", "ratio")  # fmt: skip


@dataclass
class Slices:
    """Cases, seconds and seconds of processor of every slice."""

    cases: list[int] = field(default_factory=list)
    wall: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)

    def add(self, cases: int, wall: float, used: float) -> None:
        """Take one more."""
        self.cases.append(cases)
        self.wall.append(wall)
        self.cpu.append(used)

    @property
    def rate(self) -> float:
        """Cases in a second."""
        return sum(self.cases) / sum(self.wall)

    @property
    def cost(self) -> float:
        """Seconds of processor of a case."""
        return sum(self.cpu) / sum(self.cases)


def stat(pid: int) -> list[str]:
    """What the system tells of a process from its state on."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def cpu(pids: list[int]) -> float:
    """Seconds of processor of some processes."""
    return sum(int(each[11]) + int(each[12]) for each in map(stat, pids)) / TICK


def resident(pids: list[int]) -> float:
    """MB that some processes hold."""
    return sum(int(Path(f"/proc/{pid}/statm").read_text().split()[1]) for pid in pids) * PAGE / 1e6


def rest(pids: list[int]) -> float:
    """Wait until none of some processes runs; returns since when."""
    since = time.perf_counter()
    while time.perf_counter() - since < AT_REST:
        if any(stat(pid)[0] != "S" for pid in pids):
            since = time.perf_counter() + LOOK
        time.sleep(LOOK)
    return since


def bare(cases: Cases, pipe) -> None:
    """One process of the bare loop: a list of values in, wall and CPU seconds out."""
    while True:
        every = pipe.recv()
        used = time.process_time()
        for values in every:
            cases.row(values)
        pipe.send((time.perf_counter(), time.process_time() - used))


class BareLoop:
    """The processes of the bare loop."""

    def __init__(self, cases: Cases, processes: int) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipes, self.crew = [], []
        for _ in range(processes):
            here, there = context.Pipe()
            self.pipes.append(here)
            self.crew.append(context.Process(target=bare, args=(cases, there), daemon=True))
            self.crew[-1].start()

    def run(self, every: list) -> tuple[float, float]:
        """Wall and CPU seconds of some cases."""
        begun = time.perf_counter()
        for k, pipe in enumerate(self.pipes):
            pipe.send(every[k :: len(self.pipes)])
        told = [pipe.recv() for pipe in self.pipes]
        return max(one[0] for one in told) - begun, sum(one[1] for one in told)

    def end(self) -> None:
        """End the processes."""
        for one in self.crew:
            one.terminate()
            one.join()


class Turns:
    """Watches a sweep; holds it at the end of every slice, where the bare loop has its turn."""

    def __init__(self, loop: BareLoop, every: list, first: int, slices: int) -> None:
        self.loop, self.every, self.farm = loop, every, None
        self.sweep, self.bare, self.memory = Slices(), Slices(), {}
        self.marks = [first + round(k * (len(every) - first) / slices) for k in range(slices + 1)]
        self.computed = 0
        self.others = {one.pid for one in loop.crew}
        self.begun, self.used = 0.0, 0.0

    def __call__(self, now) -> None:
        """Let the bare loop do the cases that the sweep has just done."""
        if not self.marks or now.done < self.marks[0]:
            return
        self.marks.pop(0)
        mine = [one.pid for one in multiprocessing.active_children() if one.pid not in self.others]
        over, begin = rest(mine), self.computed
        used = cpu([os.getpid(), *mine])
        self.computed = now.done + self.farm.given  # what its processes had got, they did before they were at rest
        just_done = self.every[begin : self.computed]
        if begin and just_done:
            self.sweep.add(len(just_done), over - self.begun, used - self.used)
            self.bare.add(len(just_done), *self.loop.run(just_done))
        elif just_done:
            self.loop.run(just_done)
        for share in (0.2, 1.0):
            if now.done >= share * now.total and share not in self.memory:
                self.memory[share] = resident([os.getpid(), *mine])
        self.used, self.begun = cpu([os.getpid(), *mine]), time.perf_counter()

    def crew(self, job, processes: int) -> Farm:
        """The processes of the sweep that is watched."""
        self.farm = Farm(job, processes)
        return self.farm


def row(name: str, cases: Cases, design: Design, processes: int, slices: int) -> str:
    every, loop = list(design.cases()), BareLoop(cases, processes)
    turns = Turns(loop, every, 4 * processes, slices)
    with tempfile.TemporaryDirectory() as folder:
        sweep(cases, design, Path(folder), computers=lambda job: turns.crew(job, processes), watch=turns)
    loop.end()
    ours, theirs = turns.sweep, turns.bare
    each = sorted(
        (n / w) / (m / v) for n, w, m, v in zip(ours.cases, ours.wall, theirs.cases, theirs.wall, strict=True)
    )
    fifth, last = turns.memory[0.2], turns.memory[1.0]
    ratios = f"{ours.rate / theirs.rate:.3f} ({each[0]:.2f} to {each[-1]:.2f}, median {median(each):.3f})"
    return (
        f"| `{name}` | {design.count} | {theirs.rate:.3g} | {ours.rate:.3g} | {ratios} | {1e3 * theirs.cost:.3g} | "
        f"{1e3 * ours.cost:.3g} | {ours.cost / theirs.cost:.3f} | {fifth:.0f} | {last:.0f} | {last / fifth:.3f} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser()
    for name, count in (("belt", 10_000), ("bend", 300), ("processes", 2), ("slices", 10)):
        parser.add_argument(f"--{name}", type=int, default=count)
    asked = parser.parse_args()
    belt = Cases(fairlead.load("belt"), {"end": "end(block.x)", "switches of the pad": "switches(pad)"})
    bend = Cases(fairlead.load("single_bend"), {"peak": "peak(haul.force)"})
    rows = (
        ("belt", belt, "pad.normal_force", "8 N, 12 N", asked.belt),
        ("single_bend", bend, "mu", "0.2, 0.7", asked.bend),
    )
    print(f"| {' | '.join(COLUMNS)} |\n{'|---' * len(COLUMNS)}|")
    for name, cases, parameter, ends, count in rows:
        if count >= 10 * asked.processes:
            design = Design(grid={parameter: read_range(f"lin({ends}, {count})")})
            print(row(name, cases, design, asked.processes, asked.slices), flush=True)


if __name__ == "__main__":
    main()
