"""The wobble component of PINT on simulated arrival times and on those of PSR B1855+09 (NANOGrav, 9 years), with a figure: docs/pint.md."""

import argparse
import copy
import io
import pathlib
import platform
import statistics
import sys
import time
import tomllib
import warnings
from importlib.metadata import version

import numpy as np

warnings.filterwarnings("ignore")

DAY = 86400.0
SIGMAS = {"one": (1.0, 0.6826895), "two": (2.0, 0.9544997)}


def simulated(random, out, model_of, toas_of):
    """A star drawn at random, followed by the pulse clock of `twofold.Pulsar`, and its arrival times with errors: the model without the wobble, the times, and the truth at PEPOCH."""
    import twofold

    wobble, chi = random.uniform(1.0, 4.0), random.uniform(30.0, 89.0)
    period, phase = random.uniform(200.0, 800.0), random.uniform(0.0, 360.0)
    share, sigma = random.choice([0.0, 0.5, 1.0]), 10.0 ** random.uniform(-5.0, -3.7)
    text = twofold.Scene("b1828-11").toml
    for old, new in (
        ("precession_period = 500.0", f"precession_period = {period:.17g}"),
        ('wobble = "3.0 deg"', f'wobble = "{wobble:.17g} deg"'),
        ('precession_phase = "90 deg"', f'precession_phase = "{phase:.17g} deg"'),
        ('chi = "89.0 deg"', f'chi = "{chi:.17g} deg"'),
        ('torque = "vacuum"', f"torque = {share:.17g}"),
        ('rho = "6.0 deg"', f'rho = "{abs(88.0 - chi) + 10.0:.17g} deg"'),
    ):
        if old not in text:
            raise SystemExit(f"the scene b1828-11 has no `{old}`")
        text = text.replace(old, new)
    timing = twofold.Scene(toml=text).pulsar().arrivals(np.sort(random.uniform(49621.0, 53271.0, 300)))
    fractions = timing.table["arrival_fraction"] + random.normal(0.0, sigma, 300) / DAY
    lines = ["FORMAT 1\n"]
    for day, fraction, pulse in zip(timing.table["arrival_day"], fractions, timing.table["pulse"]):
        days = int(day) + int(np.floor(fraction))
        lines.append(
            f"pulsar 0 {days}{fraction % 1.0:.17f} {sigma * 1e6} @ -pn {int(pulse)}\n".replace(f"{days}0.", f"{days}.")
        )
    (out / "simulated.tim").write_text("".join(lines))
    model = model_of(timing.par)
    since = (float(model.PEPOCH.value) - 49621.0) * DAY
    kappa = 3.6568e-13 / 2.4688717147
    tau = 2.0 * since / (1.0 + np.sqrt(1.0 + 2.0 * kappa * since))
    truth = {
        "WOBBLE": wobble,
        "WOBPERIOD": period * (1.0 + kappa * tau),
        "WOBPHASE": phase + 360.0 * tau / (period * DAY),
    }
    return model, toas_of(out / "simulated.tim", model), truth, (chi, share)


def coverage(out, count):
    """How often the true values are within one and two standard deviations of the fitted ones."""
    import astropy.units as u
    import pint.logging
    from pint.fitter import Fitter
    from pint.models import get_model
    from pint.toa import get_TOAs

    import twofold.pint

    pint.logging.setup("ERROR")
    random = np.random.default_rng(20261123)
    pulls, gone = {"WOBBLE": [], "WOBPERIOD": [], "WOBPHASE": []}, 0
    start = time.perf_counter()
    for _ in range(count):
        model, toas, truth, (chi, share) = simulated(
            random,
            out,
            lambda par: get_model(io.StringIO(par + "EPHEM DE421\nCLK TT(TAI)\n")),
            lambda path, model: get_TOAs(str(path), model=model),
        )
        for name in ("F0", "F1", "F2"):
            getattr(model, name).frozen = False
        near = truth["WOBPERIOD"] * random.uniform(0.99, 1.01) * u.day
        twofold.pint.add_wobble(model, toas, period=near, chi=chi * u.deg, torque=share)
        fitter = Fitter.auto(toas, model)
        fitter.fit_toas()
        fitter.model.components["Wobble"].positive()
        for name, value in truth.items():
            fitted = getattr(fitter.model, name)
            off = fitted.value - value
            if name == "WOBPHASE":
                off = (off + 180.0) % 360.0 - 180.0
            pulls[name].append(off / fitted.uncertainty_value)
        gone += fitter.resids.reduced_chi2 > 1.5
    print(f"coverage: {count} simulated data sets of 300 arrival times, {time.perf_counter() - start:.0f} s")
    for name, of in pulls.items():
        parts = []
        for word, (width, expected) in SIGMAS.items():
            part = np.mean(np.abs(of) < width)
            off = (part - expected) / np.sqrt(expected * (1.0 - expected) / count)
            parts.append(f"within {word} {part:.1%} ({expected:.1%} expected, {off:+.1f} standard errors)")
        print(f"  {name}: {', '.join(parts)}; mean {np.mean(of):+.2f}, largest {np.max(np.abs(of)):.1f}")
    print(f"  chi^2 above 1.5 for each degree of freedom: {gone}")


def times(repeats, *runs):
    """Medians (s) of runs that take turns."""
    found = [[] for _ in runs]
    for _ in range(repeats):
        for run, kept in zip(runs, found):
            start = time.perf_counter()
            run()
            kept.append(time.perf_counter() - start)
    return [statistics.median(kept) for kept in found]


def real_times(model, toas, repeats):
    """What the component costs in PINT's fit of real arrival times, by generalised least squares."""
    import astropy.units as u
    from pint.fitter import GLSFitter

    import twofold.pint

    star, start = copy.deepcopy(model), time.perf_counter()
    component = twofold.pint.add_wobble(star, toas, period=180 * u.day, chi=45 * u.deg, free=("WOBBLE", "WOBPHASE"))
    print(f"start values by a search: {time.perf_counter() - start:.1f} s")
    delay = star.delay(toas)

    def evaluate():
        component._last = None
        component.wobble_phase(toas, delay)
        component.d_wobble_phase_d_delay(toas, delay)
        for name in (*component.params, "F0", "F1"):
            component.d_wobble_phase_d_param(toas, name, delay)

    kept = {}

    def fit(of, name):
        def run():
            kept[name] = GLSFitter(toas, copy.deepcopy(of))
            kept[name].fit_toas(maxiter=2)

        return run

    (one,) = times(100, evaluate)
    # Both with PINT's stored noise, and one fit to warm up.
    for of in (model, star):
        of.noise_model_designmatrix(toas), of.noise_model_basis_weight(toas)
    times(1, fit(model, "without"))
    plain, wobbling = times(repeats, fit(model, "without"), fit(star, "with"))
    print(f"the phase and all its derivatives at {len(toas)} arrival times: {one * 1e3:.2f} ms")
    print(
        f"GLS fit of two steps: {plain:.1f} s without the component, {wobbling:.1f} s with it: {wobbling / plain:.2f}"
    )
    for name, fitter in kept.items():
        rms = fitter.resids.rms_weighted().to_value("us")
        print(f"  {name}: chi^2 = {fitter.resids.chi2:.2f}, weighted residuals {rms:.3f} us")
    best = kept["with"].model
    best.components["Wobble"].positive()
    print(f"  fitted at 180 d: WOBBLE = {best.WOBBLE.value:.4g} +- {best.WOBBLE.uncertainty_value:.2g} deg", end=", ")
    print(f"WOBPHASE = {best.WOBPHASE.value:.1f} deg")


def held(out, periods):
    """The limits of `twofold limits`: means of epochs with F0 and F1 fitted, and everything else held."""
    import twofold

    scene = tomllib.loads((out / "b1855+09.toml").read_text())
    star = twofold.TimingModel(scene["star"]["spin_frequency"], f1=scene["spin_down"]["f1"], chi=np.pi / 4)
    data = twofold.TimingData.read([str(out / "b1855+09.tim")], scene["time"]["epoch"])
    unknowns = ["phase", "f0", "f1"]
    fit = twofold.fit_timing(star, data, unknowns)
    return twofold.wobble_limits(fit.model, data, unknowns, periods * DAY, confidence=0.95)


def figure(path, found, other, dense):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update(
        {"font.size": 9, "font.family": "serif", "mathtext.fontset": "dejavuserif", "axes.linewidth": 0.7}
    )
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(5.2, 5.2), sharex=True, height_ratios=(2, 1), constrained_layout=True
    )
    days = found["period"].to_value("d")
    for axes in (top, bottom):
        for day in (365.25, 182.625):
            axes.axvline(day, color="0.85", lw=5, zorder=0)
        axes.tick_params(which="both", direction="in", top=True, right=True)
    top.loglog(
        days, other["limit"], "s--", color="#b35806", ms=3, lw=1, label="epoch means; only $F_0$ and $F_1$ fitted"
    )
    top.loglog(dense["period"].to_value("d"), dense["limit"].to_value("rad"), color="#92c5de", lw=0.7, zorder=1)
    top.loglog(
        days,
        found["limit"].to_value("rad"),
        "o",
        color="#2166ac",
        ms=3.5,
        label="PINT's model: all parameters and noise\n(line: between the 40 periods)",
    )
    top.set_ylim(6e-5, 8e-1)
    top.set_ylabel(r"upper limit on the wobble $\theta$ (95 %) [rad]")
    top.legend(frameon=False, loc="upper left")
    for day, word in ((365.25, "1 yr"), (182.625, "1/2 yr")):
        top.text(
            day, 0.02, word, transform=top.get_xaxis_transform(), ha="center", va="bottom", color="0.35", fontsize=8
        )
    bottom.semilogx(days, other["gain"], "s--", color="#b35806", ms=3, lw=1)
    bottom.semilogx(dense["period"].to_value("d"), dense["gain"].value, color="#92c5de", lw=0.7, zorder=1)
    bottom.semilogx(days, found["gain"].value, "o", color="#2166ac", ms=3.5)
    bottom.axhline(6.0, color="0.4", lw=0.8, ls=":")
    bottom.text(560, 6.4, "1 in 20 by chance", fontsize=8, color="0.35", va="bottom")
    bottom.set_yscale("symlog", linthresh=10)
    bottom.set_ylim(0, 200)
    bottom.set_yticks([0, 5, 10, 100], ["0", "5", "10", "100"])
    bottom.set_ylabel(r"gain of $\chi^2$")
    bottom.set_xlabel("precession period [d]")
    bottom.set_xlim(28, 3200)
    ticks = [30, 100, 300, 1000, 3000]
    bottom.set_xticks(ticks, [str(tick) for tick in ticks])
    figure.savefig(path, dpi=200)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("out", type=pathlib.Path)
    arguments.add_argument("--sets", type=int, default=200)
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--figure", type=pathlib.Path, default=pathlib.Path("docs/images/b1855_wobble_limit.png"))
    options = arguments.parse_args()
    sys.argv = [sys.argv[0], str(options.out)]
    options.out.mkdir(parents=True, exist_ok=True)
    import astropy.units as u
    import real_arrival_times as real

    import twofold.pint

    print(f"{platform.machine()}, Python {platform.python_version()}, PINT {version('pint-pulsar')}")
    real.without_network()
    coverage(options.out, options.sets)
    real.main()
    model, toas = real.fitted()
    real_times(model, toas, options.repeats)
    periods = np.geomspace(30.0, 3000.0, 40)
    start = time.perf_counter()
    found = twofold.pint.wobble_limits(model, toas, periods * u.day)
    print(f"limits at {len(periods)} periods: {time.perf_counter() - start:.1f} s")
    without_dispersion = copy.deepcopy(model)
    for name in without_dispersion.free_params:
        if name.startswith("DMX_"):
            getattr(without_dispersion, name).frozen = True
    for word, of in (("", model), (", the dispersion of each epoch held", without_dispersion)):
        one = twofold.pint.wobble_limits(of, toas, [180.0] * u.day)
        print(f"limit at 180 d{word}: {one['limit'][0]:.2e}, gain {one['gain'][0]:.2f}")
    other = held(options.out, periods)
    columns = [periods, found["limit"].to_value("rad"), found["best"].to_value("rad"), found["gain"].value]
    columns += [other["limit"], other["gain"]]
    names = "period [d], limit [rad], best [rad], gain, limit of epoch means [rad], gain of epoch means"
    np.savetxt(
        options.out / "pint_limits.csv", np.array(columns).T, fmt="%.6e", delimiter=",", header=names, comments=""
    )
    for row in np.array(columns).T:
        print(
            "  {:7.1f} d: {:.2e} rad (gain {:.1f}); epoch means {:.2e} rad (gain {:.1f})".format(*row[[0, 1, 3, 4, 5]])
        )
    # Four for each frequency that the span of the data tells apart; more at the periods of the position and of the parallax.
    span = float(np.ptp(toas.get_mjds().value))
    even = 1.0 / np.linspace(1.0 / 3000.0, 1.0 / 30.0, int(4.0 * span / 30.0))
    many = np.sort(
        np.concatenate(
            [even, np.geomspace(300.0, 3000.0, 100), 365.25 + np.arange(-4.0, 5.0), 182.625 + np.arange(-2.0, 3.0)]
        )
    )
    dense = twofold.pint.wobble_limits(model, toas, many * u.day)
    figure(options.figure, found, other, dense)
    gains = twofold.pint.wobble_limits(model, toas, even * u.day)["gain"].value
    print(
        f"{len(even)} even frequencies, {span / 30.0:.0f} of them independent: mean gain {gains.mean():.1f} (2 expected)",
        end=", ",
    )
    print(
        f"above 6 {np.mean(gains > 6.0):.0%} (5 % expected), largest {gains.max():.1f} at {even[gains.argmax()]:.1f} d"
    )
    for day in (157.0, 164.0, 175.0, 182.625, 190.0, 200.0):
        near = np.argmin(np.abs(many - day))
        print(f"  {many[near]:.2f} d: {dense['limit'][near]:.2e}")


if __name__ == "__main__":
    main()
