"""Encloses the golden numbers in balls, independently of the Rust code.

    python3 verify/oracles/certified [--only JOB ...] [--jobs N] [--pieces FOLDER] [--out verify/data/certified.csv]

Writes table, label and the ends of the enclosure, rounded outwards, for each golden number that is enclosed. `cargo test golden`
requires that each enclosure lies within the interval that rounds to the printed digits. Needs SymPy 1.14 and python-flint 0.9 (Arb).
"""

import argparse
import csv
import importlib
import sys
import time
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from pathlib import Path

from flint import ctx

DIGITS = 17
OUT = "verify/data/certified.csv"


def end(x, rounding):
    """An end of a ball as a decimal, rounded outwards."""
    exact = x.lower() if rounding == ROUND_FLOOR else x.upper()
    mantissa, exponent = exact.mid().man_exp() if not exact.is_zero() else (0, 0)
    mantissa, exponent = int(mantissa), int(exponent)
    wide = Context(prec=5000)
    value = wide.multiply(Decimal(mantissa), wide.power(Decimal(2), exponent))
    # The power of two may itself be rounded in the last of 5000 digits, which is far below the 17 digits kept.
    return Context(prec=DIGITS, rounding=rounding).plus(value)


def task(argument):
    """One job: enclosures, with the time spent. Modules are imported locally, because SymPy takes seconds to derive their formulas."""
    started = time.time()
    kind, value = argument
    ctx.dps = 50
    module, function, arguments = KINDS[kind]
    found = getattr(importlib.import_module(module), function)(*arguments(value))
    rows = [(table, label, str(end(ball, ROUND_FLOOR)), str(end(ball, ROUND_CEILING))) for table, label, ball in found]
    return argument, rows, time.time() - started


# Module, function, and its arguments, by the kind of job.
KINDS = {
    "formulas": ("formulas", "all_formulas", lambda _: ()),
    "corrected": ("corrected", "corrected", lambda _: ()),
    "eta": ("eta", "eta", lambda _: ()),
    "factor": ("eta", "figure", lambda _: ()),
    "axes": ("unknown_axes", "unknown_axes", lambda ratio: (ratio,)),
    "limits": ("limits", "limits", lambda _: ()),
    "lines": ("spectral_lines", "spectral_lines", lambda name: (name,)),
    "example": ("motions", "of_example", lambda name: (name,)),
    "long": ("motions", "of_example", lambda name: (name, 500)),
    "near": ("motions", "near_middle_axis", lambda _: ()),
    "twofold": ("motions", "twofold_regimes", lambda form: (form,)),
    "single": ("motions", "single_regime", lambda case: (case,)),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", help="jobs by their first word, merged with the rows of verify/data/certified.csv")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--pieces", default="target/certified", help="folder of what each job found; a job that is there is not done again")
    parser.add_argument("--out", default=OUT)
    arguments = parser.parse_args()
    pieces = Path(arguments.pieces)
    pieces.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(arguments.jobs) as pool:
        wanted = [job for job in jobs() if not arguments.only or job[0] in arguments.only]
        missing = [job for job in wanted if not piece(pieces, job).exists()]
        failed = 0
        for done in as_completed([pool.submit(task, job) for job in missing]):
            if done.exception():
                failed += 1
                traceback.print_exception(done.exception())
                continue
            job, found, seconds = done.result()
            print(f"{job}: {len(found)} numbers, {seconds:.0f} s", file=sys.stderr, flush=True)
            with open(piece(pieces, job), "w", newline="") as file:
                csv.writer(file, lineterminator="\n").writerows(found)
    if failed:
        sys.exit(f"{failed} jobs failed")
    rows = before(OUT) if arguments.only else {}
    for job in wanted:
        rows |= {(table, label): ends for table, label, *ends in csv.reader(open(piece(pieces, job), newline=""))}
    with open(arguments.out, "w", newline="") as file:
        file.write("# python3 verify/oracles/certified; see docs/reliability/certified.md\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["table", "label", "lower", "upper"])
        writer.writerows(sorted([*name, *ends] for name, ends in rows.items()))


def before(path):
    """The rows of a file, by table and label."""
    with open(path, newline="") as file:
        lines = csv.reader(line for line in file if not line.startswith("#"))
        next(lines)
        return {(table, label): ends for table, label, *ends in lines}


def jobs():
    """All jobs, each as a kind and its argument."""
    import motions

    names = ("tp-I", "tp-II", "sp-I", "sp-II")
    out = [(kind, "all") for kind in ("formulas", "corrected", "eta", "factor", "limits")]
    out += [("axes", ratio) for ratio in ("0", "-1-11", "-1-3")] + [("lines", name) for name in names[:2]]
    out += [("example", name) for name in names]
    out += [("twofold", form) for form in ("printed", "corrected")] + [("single", case) for case in motions.SINGLE]
    return out + [("long", name) for name in names] + [("near", "Y")]


def piece(pieces, job):
    """The file of a job."""
    kind, which = job
    return pieces / f"{kind}-{which if isinstance(which, str) else '-'.join(which)}.csv"


if __name__ == "__main__":
    main()
