"""Derives the equations from the Lagrangian with SymPy, independently of the Rust code, and compares.

    python3 verify/oracles/symbolic write [--points 8] [--seed 2021] [--out verify/data/symbolic.json]
    python3 verify/oracles/symbolic compare KERNELS.json     the kernel values of `symbolic_points` at its own points
    python3 verify/oracles/symbolic judge                    the paper's printed formulas against the derivation

Needs SymPy 1.14 (which brings mpmath). Exit code 1 if anything differs.
"""

import argparse
import json
import sys
import time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    write = commands.add_parser("write")
    write.add_argument("--points", type=int, default=8)
    write.add_argument("--seed", type=int, default=2021)
    write.add_argument("--out", default="verify/data/symbolic.json")
    compare = commands.add_parser("compare")
    compare.add_argument("kernels")
    commands.add_parser("judge")
    arguments = parser.parse_args()
    started = time.time()
    if arguments.command == "judge":
        import printed

        failures = printed.judge()
    else:
        import exchange
        import quantities

        listed = quantities.all_quantities()
        print(f"derived {len(listed)} quantities in {time.time() - started:.1f} s", file=sys.stderr)
        if arguments.command == "write":
            document = exchange.document(listed, arguments.points, arguments.seed)
            with open(arguments.out, "w") as file:
                file.write(json.dumps(document, indent=0, separators=(",", ":")) + "\n")
            failures = 0
        else:
            import comparison

            failures = comparison.report(listed, arguments.kernels)
    print(f"{time.time() - started:.1f} s", file=sys.stderr)
    sys.exit(1 if failures else 0)


main()
