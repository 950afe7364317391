"""Encloses the golden numbers in balls, independently of the Rust code.

    python3 verify/oracles/certified [--only JOB ...] [--jobs N] [--pieces FOLDER] [--out verify/data/certified.csv]

Writes for each golden number that is enclosed its table, label and the ends of the enclosure, rounded outwards. `cargo test --test golden`
asks that each lies within what rounds to the printed digits. Needs SymPy 1.14 and python-flint 0.9 (Arb).
"""

import argparse
import csv
import sys
import time
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from pathlib import Path

from flint import ctx

DIGITS = 17


def end(x, rounding):
    """A ball's end as a decimal, rounded outwards."""
    exact = x.lower() if rounding == ROUND_FLOOR else x.upper()
    mantissa, exponent = exact.mid().man_exp() if not exact.is_zero() else (0, 0)
    mantissa, exponent = int(mantissa), int(exponent)
    wide = Context(prec=5000)
    value = wide.multiply(Decimal(mantissa), wide.power(Decimal(2), exponent))
    # The power of two may itself be rounded in the last of 5000 digits: nothing beside the 17 that are kept.
    return Context(prec=DIGITS, rounding=rounding).plus(value)


def task(argument):
    """One job: enclosures, with the time that they took."""
    started = time.time()
    kind, value = argument
    if kind == "formulas":
        import formulas

        ctx.dps = 50
        found = list(formulas.all_formulas())
    else:
        import motions

        found = {
            "example": motions.of_example,
            "long": lambda name: motions.of_example(name, 500),
            "near": lambda _: motions.near_middle_axis(),
            "twofold": motions.twofold_regimes,
            "single": motions.single_regime,
        }[kind](value)
    rows = [(table, label, str(end(ball, ROUND_FLOOR)), str(end(ball, ROUND_CEILING))) for table, label, ball in found]
    return argument, rows, time.time() - started


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", help="jobs by their first word: formulas example twofold single long near")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--pieces", default="target/certified", help="folder of what each job found; a job that is there is not done again")
    parser.add_argument("--out", default="verify/data/certified.csv")
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
    rows = [row for path in sorted(pieces.glob("*.csv")) for row in csv.reader(open(path, newline=""))]
    with open(arguments.out, "w", newline="") as file:
        file.write("# python3 verify/oracles/certified; see docs/reliability/certified.md\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["table", "label", "lower", "upper"])
        writer.writerows(sorted(rows))


def jobs():
    """All of them: a kind, and which."""
    import motions

    names = ("tp-I", "tp-II", "sp-I", "sp-II")
    out = [("formulas", "all")] + [("example", name) for name in names]
    out += [("twofold", form) for form in ("printed", "corrected")] + [("single", case) for case in motions.SINGLE]
    return out + [("long", name) for name in names] + [("near", "Y")]


def piece(pieces, job):
    """The file of a job."""
    kind, which = job
    return pieces / f"{kind}-{which if isinstance(which, str) else '-'.join(which)}.csv"


if __name__ == "__main__":
    main()
