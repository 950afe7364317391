"""Times ours and other programs in turn on the same scenes, and prints their ratios at equal true error; `scripts/peers` runs it.

    python3 tools/peers/compare.py OURS RUST_PEERS [--scenes tp-II,...] [--tasks long,...] [--rounds N] [--out FILE.csv]

Each program waits for one request at a time (README.md beside this file), so that only one works at any moment, and they take
turns run by run. Times are those of work of the thread; the least of all counts. A scene's error is the largest of a component of n,
L / |L| and, where it is carried, e_x, against the states of 30 digits.
"""

import argparse
import math
import os
import subprocess
import sys

from scenes import error, read_scenes

ERRORS = [10.0**-k for k in range(5, 13)]
HERE = os.path.dirname(os.path.abspath(__file__))

# What is asked of the ratio ours / theirs on tp-II: task, theirs (any that begins so, the best of them), errors, at most.
TARGETS = [
    ("n L", "heyoka", (5, 12), 0.5),
    ("n L e_x", "heyoka", (5, 12), 0.4),
    ("pulses", "heyoka", (5, 12), 0.35),
    ("n L", "SciPy", (5, 10), 1 / 300),
    ("n L", "Rust", (5, 10), 1 / 3),
    ("n L e_x", "Rust", (5, 10), 1 / 3),
    ("many scenes", "heyoka, batch of 8", (5, 12), 1 / 3.5),
    ("long", "heyoka", (10, 10), 1 / 300),
    ("long", "our integrators", (10, 10), 1 / 100),
]
GROUPS = {
    "Rust": ("numeris", "ode_solvers", "differential-equations"),
    "our integrators": ("Taylor", "splitting"),
}
RUST = GROUPS["Rust"]


class Program:
    """A program that runs a method on request."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.methods = []
        self.ask("methods")
        while line := self.line():
            name, task, settings = line.split("\t")
            self.methods.append((name, task, settings.split(" ")))

    def ask(self, request):
        self.process.stdin.write(request + "\n")
        self.process.stdin.flush()

    def line(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit("a program has ended: " + " ".join(self.process.args))
        return line.rstrip("\n")

    def run(self, name, task, scene, setting, repeats):
        """Times, steps, evaluations, time of set-up, state."""
        self.ask("\t".join(["run", name, task, scene, setting, str(repeats)]))
        times, steps, evaluations, set_up, state = self.line().split("\t")
        numbers = [float.fromhex(x) if "x" in x else float(x) for x in state.split(" ")]
        return [float(t) for t in times.split(" ")], int(steps), int(evaluations), float(set_up), numbers


def measure(programs, scenes, tasks, rounds, repeats):
    """Rows of scene, method, task, setting, error, least, median, steps, evaluations; and the longest set-up of each method."""
    rows, set_ups = [], {}
    for scene in scenes:
        here = [task for task in tasks if task != "long" or scene.late]
        cases = [(p, *m[:2], s) for p in programs for m in p.methods if m[1] in here for s in m[2]]
        # Alternately: the settings of ours are spread among those of the others.
        order = sorted(range(len(cases)), key=lambda i: (cases[i][3], cases[i][1], cases[i][2]))
        times = [[] for _ in cases]
        last = [None] * len(cases)
        for round_ in range(rounds + 1):
            for i in order:
                program, name, task, setting = cases[i]
                slow, once = name.startswith("SciPy"), task == "long" and name != "torus"
                if slow and round_ > 2 or once and round_ != 1:
                    continue
                few = slow or once or round_ == 0
                found, *last[i] = program.run(name, task, scene.name, setting, 1 if few else repeats)
                # The first round warms up.
                times[i] += found if round_ else []
            print(f"\r{scene.name}: round {round_} of {rounds}", end="", file=sys.stderr, flush=True)
        print(file=sys.stderr)
        for (program, name, task, setting), t, (steps, evaluations, set_up, state) in zip(cases, times, last):
            t.sort()
            set_ups[name, task] = max(set_up, set_ups.get((name, task), 0.0))
            err = error(scene.late if task == "long" else scene.end, state)
            rows.append([scene.name, name, task, setting, err, t[0], t[len(t) // 2], steps, evaluations])
    return rows, set_ups


def front(rows, scene, name, task):
    """Errors and times of the runs that no other one beats in both."""
    runs = sorted((row[5], row[4]) for row in rows if row[:3] == [scene, name, task] and math.isfinite(row[4]))
    found = []
    for time, err in runs:
        if not found or err < found[-1][0]:
            found.append((err, time))
    return found


def time_at(points, err):
    """Time at an error, on straight lines in logarithms; that of the coarsest run above all errors, none below."""
    for i, (e1, t1) in enumerate(points):
        if e1 <= err:
            if i == 0:
                return t1
            e0, t0 = points[i - 1]
            return t0 * (t1 / t0) ** (math.log(e0 / err) / math.log(e0 / e1))
    return None


def best(rows, scene, task, begins, err):
    """The least time of all methods whose names begin so."""
    names = {row[1] for row in rows if row[2] == task and row[1].startswith(begins)}
    times = [time_at(front(rows, scene, name, task), err) for name in names]
    return min((t for t in times if t is not None), default=None)


def tables(rows, ours):
    for scene in dict.fromkeys(row[0] for row in rows):
        for task in dict.fromkeys(row[2] for row in rows):
            print(f"\n{scene}, {task}: time of work [ms] of a scene at equal error, and ours / theirs in brackets\n")
            print("| method | " + " | ".join(f"{e:.0e}" for e in ERRORS) + " |\n|---|" + "---:|" * len(ERRORS))
            for name in dict.fromkeys(row[1] for row in rows if row[2] == task):
                points, cells = front(rows, scene, name, task), []
                for e in ERRORS:
                    t, mine = time_at(points, e), best(rows, scene, task, ours, e)
                    ratio = f" ({mine / t:.2g})" if t and mine and not name.startswith(ours) else ""
                    cells.append("-" if t is None else f"{t * 1e3:.3f}{ratio}")
                print(f"| {name} | " + " | ".join(cells) + " |")


def verdicts(rows, ours, scene="tp-II"):
    print(f"\n{scene}: ours / theirs, the largest over the errors that theirs reaches\n")
    print("| task | theirs | errors | largest ratio | at error | asked | |\n|---|---|---|---:|---:|---:|---|")
    for task, theirs, (first, last), asked in TARGETS:
        begins = GROUPS.get(theirs, theirs)
        ratios = []
        for k in range(first, last + 1):
            a, b = best(rows, scene, task, ours, 10.0**-k), best(rows, scene, task, begins, 10.0**-k)
            if b is not None:
                ratios.append((a / b if a is not None else math.inf, k))
        if not ratios and any(row[2] == task for row in rows):
            print(f"| {task} | {theirs} | 1e-{first} to 1e-{last} | - | none reached | {asked:.3g} | |")
        if ratios:
            ratio, at = max(ratios)
            verdict = "met" if ratio <= asked else "not met"
            print(f"| {task} | {theirs} | 1e-{first} to 1e-{last} | {ratio:.3g} | 1e-{at} | {asked:.3g} | {verdict} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ours")
    parser.add_argument("rust_peers")
    parser.add_argument("--scenes", default="tp-II")
    parser.add_argument("--tasks", default="n L,n L e_x,pulses,many scenes,long")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--out")
    args = parser.parse_args()
    scenes = [scene for scene in read_scenes() if args.scenes == "all" or scene.name in args.scenes.split(",")]
    worker = [sys.executable, os.path.join(HERE, "worker.py")]
    programs = [Program(command) for command in ([args.ours], [args.rust_peers], worker)]
    ours = tuple({name for name, *_ in programs[0].methods if not name.startswith(RUST)})
    rows, set_ups = measure(programs, scenes, args.tasks.split(","), args.rounds, args.repeats)
    tables(rows, ours)
    verdicts(rows, ours)
    print("\nBefore the first run, the longest of all settings:")
    for (name, task), seconds in set_ups.items():
        if seconds > 0:
            print(f"  {name}, {task}: {seconds * 1e6:.3g} us")
    if args.out:
        with open(args.out, "w") as file:
            file.write("scene,method,carries,setting,error,least_s,median_s,steps,evaluations\n")
            for row in rows:
                row = [f'"{cell}"' if "," in str(cell) else repr(cell) if isinstance(cell, float) else str(cell) for cell in row]
                file.write(",".join(row) + "\n")


if __name__ == "__main__":
    main()
