"""Recomputes what the command `twofold` writes for the scenes beside it.

    python verify/second_program            compare with the answers that are kept
    python verify/second_program --update   write them anew
    python verify/second_program NAME ...   only these files of answers
    python verify/second_program --data     write the data of the fits anew
"""

import json
import multiprocessing
import pathlib
import sys
import time

import answers
import commands
import further
import keys
from scene import Scene

HERE = pathlib.Path(__file__).parent
SPECTRA = json.loads((HERE / "spectra.json").read_text())


def answered(file, name, changed):
    """All commands of one scene, with keys changed, with their outputs."""
    unchanged = Scene.read(HERE / "scenes" / f"{name}.toml")
    scene = unchanged.changed(changed)
    done = []

    def answer(arguments, compute, error=None):
        done.append({"arguments": arguments, "outputs": answers.tables(compute, scene, error)})

    chosen = scene.document.get("output", {}).get("columns") if "output.columns" in changed else None
    columns = [] if chosen else ["--columns", ",".join(commands.groups(scene))]
    second = [] if name in keys.CASES else ["--second-beam"]
    if scene.epoch is None or name in keys.CASES:
        answer(["run", "{scene}", *columns], lambda s, n: commands.run(s, n, chosen))
        if scene.pulsar is not None:
            answer(["pulses", "{scene}", *second], lambda s, n: commands.pulse_list(s, n, bool(second)))
    if scene.epoch is not None:
        error = answers.averaging_error(scene)
        rate = commands.strain_rate(unchanged)
        strain = ["--strain-rate", repr(rate), "--strain-span", repr((commands.STRAIN_SAMPLES - 0.5) / rate)]
        for with_rate in (False, True):
            arguments = ["timing", "{scene}", "--out", "{out}", "--uncertainty", "2.5", *strain, *["--f1"] * with_rate]
            answer(arguments, lambda s, n, f1=with_rate: commands.timing_files(s, n, name, f1, rate), error)
    for options in SPECTRA.get(file, []):
        flags = [f"--{option}={value}" for option, value in options.items() if option != "column"]
        arguments = ["spectrum", "{scene}", f"--of={options['column']}", *flags]
        answer(arguments, lambda s, n, o=options: commands.spectrum(s, n, **o))
    return done


def tasks():
    """(name of the file of answers, scene, keys changed) of all."""
    scenes = [(path.stem, path.stem, {}) for path in sorted((HERE / "scenes").glob("*.toml"))]
    changed = [(f"{scene}.{key}", scene, {key: value}) for scene, cases in keys.CASES.items() for key, value in cases.items()]
    return scenes + changed


def job(task):
    (file, name, changed), update = task
    began = time.monotonic()
    done = {"scene": name, "changed": changed, "commands": answered(file, name, changed)}
    path = HERE / "answers" / f"{file}.json"
    if update:
        answers.write(path, done)
        found = []
    else:
        found = answers.differences(json.loads(path.read_text()), json.loads(json.dumps(done, default=float)))
    return file, found, time.monotonic() - began


def call(pair):
    function, argument = pair
    return function(argument)


def main():
    if "--data" in sys.argv:
        return further.write_data()
    update = "--update" in sys.argv
    names = [argument for argument in sys.argv[1:] if argument != "--update"]
    wanted = [(further.job, (name, update)) for name in further.tasks() if not names or name in names]
    wanted += [(job, (task, update)) for task in tasks() if not names or task[0] in names]
    wrong = 0
    with multiprocessing.Pool() as pool:
        for file, found, seconds in pool.imap_unordered(call, wanted):
            print(f"{file}: {'written' if update else 'as kept' if not found else 'differs'} ({seconds:.1f} s)", flush=True)
            for line in found[:10]:
                print(f"  {line}")
            wrong += bool(found)
    if not names:
        silent = [file for file, scene, changed in tasks() if changed and not keys.shows(HERE / "answers", file, scene)]
        if sorted(silent) != sorted(f"keys-angles.{key}" for key in keys.SILENT):
            sys.exit(f"keys whose change does not show: {silent}")
    if wrong:
        sys.exit(f"{wrong} of {len(wanted)} files differ from the answers that are kept")


if __name__ == "__main__":
    main()
