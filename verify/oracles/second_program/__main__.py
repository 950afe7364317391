"""Recomputes the output of the command `twofold` for the scenes in this folder.

    python verify/oracles/second_program            compare with the stored answers
    python verify/oracles/second_program --update   rewrite them
    python verify/oracles/second_program NAME ...   only these files of answers
    python verify/oracles/second_program --data     rewrite the data of the fits
"""

import functools
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
# Epochs for the options of `timing`, as modified Julian dates: other dates, and steps in days from the first to the last of the scene.
EPOCHS = {
    "keys-dates": [
        (["--from", "53790.25", "--to", "53850.5", "--epochs", "7"], [53790.25 + k * 60.25 / 6 for k in range(7)]),
        (["--every", "23.5"], [53777.445 + 23.5 * k for k in range(5)]),
    ]
}
# Scenes whose causes of residuals are computed too.
CAUSES = {"braked-index", "bulge-braked"}
SPECTRA = json.loads((HERE / "spectra.json").read_text())


def answered(file, name, changed):
    """All commands of one scene, with changed keys, and their outputs."""
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
        if "perturbation" in commands.groups(scene):
            # This needs no motion.
            answer(["run", "{scene}", "--columns", "perturbation"], lambda s, n: commands.run(s, n, ["perturbation"]))
        if scene.pulsar is not None:
            answer(["pulses", "{scene}", *second], lambda s, n: commands.pulse_list(s, n, bool(second)))
    if scene.epoch is not None:
        error = answers.timing_error(scene)
        rate = commands.strain_rate(unchanged)
        strain = ["--strain-rate", repr(rate), "--strain-span", repr((commands.STRAIN_SAMPLES - 0.5) / rate)]
        # F0 alone, or with F1 and F2 for a star that slows down.
        for options, terms in [([], 3 if "spin_down" in scene.document else 1), (["--f1"], 2)]:
            causes = file in CAUSES
            arguments = ["timing", "{scene}", "--out", "{out}", "--uncertainty", "2.5", *strain, *options, *(["--causes"] if causes else [])]
            answer(arguments, lambda s, n, t=terms, c=causes: commands.timing_files(s, n, name, t, rate, 2.5, causes=c), error)
        for options, dates in EPOCHS.get(file, []):
            arguments = ["timing", "{scene}", "--out", "{out}", *strain, *options]
            answer(arguments, lambda s, n, dates=tuple(dates): commands.timing_files(s, n, name, 1, rate, 1.0, dates), error)
    for options in SPECTRA.get(file, []):
        # The span is that of the series here; the command needs no span.
        flags = [f"--{option}={options[option]}" for option in ("least", "most")]
        arguments = ["spectrum", "{scene}", f"--of={options['column']}", *flags]
        answer(arguments, lambda s, n, o=options: commands.spectrum(s, n, **o))
    return done


def tasks():
    """The files of answers: by file name the scene, the changed keys, and the function that answers the commands."""
    found = {}
    for path in sorted((HERE / "scenes").glob("*.toml")):
        found[path.stem] = (path.stem, {})
    for scene, cases in keys.CASES.items():
        found.update({f"{scene}.{key}": (scene, {key: value}) for key, value in cases.items()})
    found = {file: (*task, functools.partial(answered, file, *task)) for file, task in found.items()}
    # Commands for many scenes and for data name their files themselves.
    return found | {file: (None, {}, answer) for file, answer in further.tasks().items()}


def job(task):
    file, update = task
    began = time.monotonic()
    scene, changed, answer = tasks()[file]
    done = {"scene": scene, "changed": changed, "commands": answer()}
    path, found = HERE / "answers" / f"{file}.json", []
    if update:
        answers.write(path, done)
    else:
        found = answers.differences(json.loads(path.read_text()), json.loads(json.dumps(done, default=float)))
    return file, found, time.monotonic() - began


def main():
    update = "--update" in sys.argv
    names = [argument for argument in sys.argv[1:] if not argument.startswith("--")] or list(tasks())
    if "--data" in sys.argv:
        return further.write_data()
    wrong = 0
    with multiprocessing.Pool() as pool:
        for file, found, seconds in pool.imap_unordered(job, [(name, update) for name in names]):
            print(f"{file}: {'written' if update else 'differs' if found else 'as kept'} ({seconds:.1f} s)", flush=True)
            for line in found[:10]:
                print(f"  {line}")
            wrong += bool(found)
    silent = {file for file, (scene, changed, _) in tasks().items() if changed and not keys.shows(HERE / "answers", file, scene)}
    if silent != {f"keys-angles.{key}" for key in keys.SILENT}:
        return f"keys whose change does not show: {silent}"
    return f"{wrong} of {len(names)} files differ from the answers that are kept" if wrong else None


if __name__ == "__main__":
    sys.exit(main())
