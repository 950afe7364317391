"""Recomputes what the command `twofold` writes for the scenes beside it.

    python verify/second_program            compare with the answers that are kept
    python verify/second_program --update   write them anew
    python verify/second_program NAME ...   only these scenes
"""

import json
import multiprocessing
import pathlib
import sys
import time

import answers
import commands
from scene import Scene

HERE = pathlib.Path(__file__).parent
SPECTRA = json.loads((HERE / "spectra.json").read_text())


def answered(name):
    """All commands of one scene with their outputs."""
    scene = Scene.read(HERE / "scenes" / f"{name}.toml")
    done = []

    def answer(arguments, compute, error=None):
        done.append({"arguments": arguments, "outputs": answers.tables(compute, scene, error)})

    if scene.epoch is None:
        answer(["run", "{scene}", "--columns", ",".join(commands.groups(scene))], commands.run)
        if scene.pulsar is not None:
            answer(["pulses", "{scene}", "--second-beam"], commands.pulse_list)
    else:
        error = answers.averaging_error(scene)
        rate = commands.strain_rate(scene)
        strain = ["--strain-rate", repr(rate), "--strain-span", repr((commands.STRAIN_SAMPLES - 0.5) / rate)]
        for with_rate in (False, True):
            arguments = ["timing", "{scene}", "--out", "{out}", "--uncertainty", "2.5", *strain, *["--f1"] * with_rate]
            answer(arguments, lambda s, n, f1=with_rate: commands.timing_files(s, n, name, f1, rate), error)
    for spectrum in SPECTRA.get(name, []):
        column, span, least = spectrum["column"], spectrum["span"], spectrum["least"]
        arguments = ["spectrum", "{scene}", f"--of={column}", f"--span={span}", f"--least={least}"]
        answer(arguments, lambda s, n, c=column, t=span, least=least: commands.spectrum(s, n, c, t, least))
    return done


def job(task):
    name, update = task
    began = time.monotonic()
    done = {"scene": name, "commands": answered(name)}
    path = HERE / "answers" / f"{name}.json"
    if update:
        answers.write(path, name, done["commands"])
        found = []
    else:
        found = answers.differences(json.loads(path.read_text()), json.loads(json.dumps(done, default=float)))
    return name, found, time.monotonic() - began


def main():
    update = "--update" in sys.argv
    names = [argument for argument in sys.argv[1:] if argument != "--update"]
    names = names or sorted(path.stem for path in (HERE / "scenes").glob("*.toml"))
    wrong = 0
    with multiprocessing.Pool() as pool:
        for name, found, seconds in pool.imap_unordered(job, [(name, update) for name in names]):
            print(f"{name}: {'written' if update else 'as kept' if not found else 'differs'} ({seconds:.1f} s)", flush=True)
            for line in found[:10]:
                print(f"  {line}")
            wrong += bool(found)
    if wrong:
        sys.exit(f"{wrong} of {len(names)} scenes differ from the answers that are kept")


if __name__ == "__main__":
    main()
