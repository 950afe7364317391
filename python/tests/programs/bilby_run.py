"""A wobble in arrival times of 10 years, found by dynesty through bilby; means and widths compared with `twofold.fit_timing`. Needs bilby and
dynesty, no network."""

import logging
import sys
import tempfile
import time

import bilby
import numpy as np
import twofold
from twofold.likelihood import TimingLikelihood

bilby.core.utils.logger.setLevel(logging.ERROR)

# B1828-11 with a magnetic axis 80 degrees from the symmetry axis, and 300 arrival times of 0.1 ms.
true = {"f1": -3.6568e-13, "wobble": 0.0523, "chi": 1.4, "precession_phase": 1.0, "precession_rate": 1.4544410383e-7}
f0 = 2.4688717147
model = twofold.TimingModel(f0, **true)
random = np.random.default_rng(20)
numbers = np.sort(random.integers(0, round(3.15e8 * f0), 300)).astype(float)
times, rest = model.arrival(numbers)
sigma = 1e-4
data = twofold.TimingData(times, np.full(300, sigma), rest=rest + sigma * random.standard_normal(300))

unknowns = ["phase", "f0", "f1", "wobble", "precession_phase", "precession_rate"]
# The start is a fit from parameters that are wrong by some standard deviations, as after a search.
start = model.moved(f0=2e-12, wobble=1e-3, precession_phase=0.03)
fit = twofold.fit_timing(start, data, unknowns)
sigmas = dict(zip(unknowns, fit.sigmas, strict=True))
offset = sum(a - b for a, b in zip(model.frequency, start.frequency, strict=True))
injected = {"phase": model["phase"], "f0_offset": offset, **{name: model[name] for name in unknowns[2:]}}


def sampled(marginalised: tuple[str, ...]) -> tuple[str, float]:
    likelihood = TimingLikelihood(start, data, marginalised=marginalised)
    priors = {}
    for name in unknowns:
        if name not in marginalised:
            key = "f0_offset" if name == "f0" else name
            centre = 0.0 if name == "f0" else start[name]
            priors[key] = bilby.core.prior.Uniform(centre - 30 * sigmas[name], centre + 30 * sigmas[name], key)
    began = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        result = bilby.run_sampler(
            likelihood, priors, "dynesty", nlive=400, dlogz=0.1, sample="rwalk", seed=7, outdir=folder, save=False, clean=True, verbose=False, plot=False, check_point=False, resume=False
        )
    seconds = time.perf_counter() - began
    worst_mean, worst_width = 0.0, 0.0
    for key in priors:
        posterior, name = result.posterior[key], key.removesuffix("_offset")
        pull = abs(posterior.mean() - injected[key]) / posterior.std()
        width = posterior.std() / sigmas[name] - 1
        if not pull < 3:
            sys.exit(f"{key}: the mean is {pull:.1f} standard deviations from what was injected, must be at most 3")
        if not abs(width) < 0.25:
            sys.exit(f"{key}: the width is {width + 1:.2f} of that of the fit, must be from 0.75 to 1.25")
        worst_mean, worst_width = max(worst_mean, pull), max(worst_width, abs(width))
    return (
        f"{len(priors)} parameters, {len(result.posterior)} samples in {seconds:.0f} s, means within {worst_mean:.1f} sigma of the injected, widths within {100 * worst_width:.0f} % of the fit's",
        result.log_evidence,
    )


of_all, _ = sampled(())
of_three, _ = sampled(("phase", "f0", "f1"))
print(f"bilby: {of_all}; with phase, F0 and F1 marginalised: {of_three}")
