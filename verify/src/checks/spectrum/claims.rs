//! What the paper says of its spectra, each statement as a check of its own.

use std::f64::consts::TAU;

use twofold::dynamics::inertia_tensor_rate::spheroid_inertia_acceleration;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::{metric_perturbation, polarizations};
use twofold::observables::pulsar::{Stamped, pulse_train};
use twofold::observables::spectrum::{LineList, Series, SpectralLine, Window, spectral_lines};
use twofold::propagation::propagate;
use twofold::solutions::free::free_precession_rates;

use super::signals::{Example, beam, examples, line_of_sight, strongest};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::paper_examples::COEFFICIENTS;

/// Frequencies about the fundamental, the second, third and fourth harmonic, for both examples [1/t_c].
const FUNDAMENTAL: std::ops::Range<f64> = 1.0..2.0;
const THIRD: std::ops::Range<f64> = 4.0..5.0;
const FOURTH: std::ops::Range<f64> = 5.4..6.4;

/// Frequencies of the order of the coefficients for Lorentz violation [1/t_c].
const SLOW: std::ops::Range<f64> = 0.01..0.1;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "lines-identified",
            kind: Kind::Oracle,
            equations: &[47, 71],
            statement: "every line of m.n above 1e-4 and of h_+ and h_x above 1e-6 of tp-I and tp-II is one combination of alpha', gamma' and the slow frequency",
            figure: "lines unidentified or ambiguous",
            bound: Bound::AtMost(0.0),
            reason: "the motion is quasi-periodic with these three frequencies",
            measure: all_identified,
        },
        Check {
            id: "lines-of-motion",
            kind: Kind::Oracle,
            equations: &[47, 71],
            statement: "the frequencies of these lines, found in the series alone, are those combinations of the mean rates",
            figure: "largest difference, m.n above 1e-4, h above 1e-5 [1/t_c]",
            bound: Bound::AtMost(1e-9),
            reason: "the accuracy asked of line lists",
            measure: lines_against_rates,
        },
        Check {
            id: "free-precession-lines",
            kind: Kind::Oracle,
            equations: &[47, 48, 68, 71],
            statement: "in free precession m.n has exactly four lines, alpha', |gamma'| and alpha' +- gamma', and h exactly two, alpha' and 2 alpha'",
            figure: "largest amplitude in the spectrum of what these leave; infinite if one is missing or off by more than 1e-11",
            bound: Bound::AtMost(1e-11),
            reason: "the motion and the products of its components are rounded at 1e-15, its phase at 3e-12 over the span",
            measure: free_precession,
        },
        Check {
            id: "slow-line-tp-2",
            kind: Kind::Oracle,
            equations: &[47, 57],
            statement: "m.n of tp-II has a line between 0.03 and 0.04 / t_c, and it is the mean rate of the azimuth of L about Z",
            figure: "|frequency of the strongest line there - |mean rate|| [1/t_c]; infinite if it is below a tenth of the highest line",
            bound: Bound::AtMost(1e-9),
            reason: "the accuracy asked of line lists",
            measure: slow_line_of_tp_2,
        },
        Check {
            id: "slow-line-tp-1",
            kind: Kind::Oracle,
            equations: &[47, 57],
            statement: "m.n of tp-I shows no such line: the azimuth of L counts turns of alpha, and the slow frequency, 0.0280 / t_c all the same, has a two-thousandth of the highest amplitude",
            figure: "largest amplitude between 0.01 and 0.1 / that of the highest line; infinite unless L and alpha have one mean rate",
            bound: Bound::AtMost(0.01),
            reason: "a hundredth cannot be seen on the figure's linear axis",
            measure: slow_line_of_tp_1,
        },
        Check {
            id: "slow-line-waves",
            kind: Kind::Oracle,
            equations: &[57, 71],
            statement: "the waves of tp-I and tp-II show no line of the order of the coefficients",
            figure: "largest amplitude between 0.01 and 0.1 / that of the highest line, h_+ and h_x",
            bound: Bound::AtMost(0.01),
            reason: "a hundredth cannot be seen on the figure's linear axis",
            measure: slow_line_of_waves,
        },
        Check {
            id: "slow-frequency-magnitude",
            kind: Kind::Oracle,
            equations: &[35, 57],
            statement: "the slow frequency of tp-II has the order of magnitude of the coefficients for Lorentz violation",
            figure: "|slow frequency| t_c / geometric mean of |s^XX|, |s^YY|, |s^ZZ|",
            bound: Bound::Within(10f64.powf(-0.5), 3.162_277_660_168_379_5),
            reason: "half a decade on either side",
            measure: slow_magnitude,
        },
        Check {
            id: "third-harmonic-tp-1",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "h of tp-I has a third harmonic at exactly three times its fundamental, alpha'",
            figure: "|3 w_1 - w_3| of the highest lines about 1.5 and 4.5, h_+ and h_x [1/t_c]",
            bound: Bound::AtMost(1e-9),
            reason: "the accuracy asked of line lists",
            measure: || third_harmonic(0),
        },
        Check {
            id: "third-harmonic-tp-2",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "in tp-II the highest line about the third harmonic is 3 alpha' - l', not three times the fundamental alpha'; the line 3 alpha' is there and lower",
            figure: "|3 w_1 - w_3| of the highest lines about 1.4 and 4.2, h_+ and h_x [1/t_c]",
            bound: Bound::Within(0.0354, 0.0355),
            reason: "the slow frequency, 0.03546; zero is claimed",
            measure: || third_harmonic(1),
        },
        Check {
            id: "third-harmonic-weaker",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "the third harmonic of tp-I is weaker than that of tp-II",
            figure: "largest ratio of the two, each the highest line there over the highest about the fundamental, h_+ and h_x",
            bound: Bound::AtMost(0.5),
            reason: "'further suppressed' read as at most half",
            measure: third_harmonic_ratio,
        },
        Check {
            id: "fourth-harmonic-tp-1",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "'frequencies higher than the third harmonic have even much smaller amplitudes' does not hold in tp-I: the fourth has about half the amplitude of the third, or more",
            figure: "smallest ratio of the highest lines about the fourth and the third harmonic, h_+ and h_x",
            bound: Bound::AtLeast(0.4),
            reason: "'much smaller' would be a fifth or less",
            measure: || fourth_harmonic(0).map(|[low, _]| low),
        },
        Check {
            id: "fourth-harmonic-tp-2",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "in tp-II the fourth harmonic is much smaller than the third",
            figure: "largest ratio of the highest lines about the fourth and the third harmonic, h_+ and h_x",
            bound: Bound::AtMost(0.2),
            reason: "'much smaller' read as at most a fifth",
            measure: || fourth_harmonic(1).map(|[_, high]| high),
        },
        Check {
            id: "spectra-peaks",
            kind: Kind::Oracle,
            equations: &[47, 48, 71],
            statement: "the highest lines about the fundamental are at the mean rates of alpha, not at the 1.438 / t_c of free precession that the figures mark",
            figure: "least distance from 1.438 of the highest line between 1 and 2, m.n, h_+ and h_x of tp-I and tp-II [1/t_c]",
            bound: Bound::AtLeast(0.04),
            reason: "the mean rates of alpha are 1.512 and 1.395; the resolution of 200 t_c is 0.03",
            measure: peaks,
        },
        Check {
            id: "wave-lines-not-harmonics",
            kind: Kind::Oracle,
            equations: &[71],
            statement: "the waves of tp-II are not made of harmonics of the mean rate of alpha alone: a fifth of their power and more is in combinations with the slow frequency",
            figure: "least share of the sum of squared amplitudes in lines that are no multiple of alpha', h_+ and h_x",
            bound: Bound::AtLeast(0.2),
            reason: "none is claimed by 'all harmonics of the average rate of alpha'",
            measure: not_harmonics,
        },
        Check {
            id: "period-series-40",
            kind: Kind::Oracle,
            equations: &[51, 57],
            statement: "the series of pulse periods and widths of tp-I and tp-II have a period of about 40 t_c, that of gamma",
            figure: "largest |2 pi / w - 40|, w between 0.1 and 0.2 / t_c the frequency whose multiples have most power [t_c]; infinite unless w is the rate of gamma",
            bound: Bound::AtMost(5.0),
            reason: "'about 40' read as 35 to 45",
            measure: period_of_gamma,
        },
        Check {
            id: "period-series-180",
            kind: Kind::Oracle,
            equations: &[51, 57],
            statement: "those of tp-II have a period of about 180 t_c too, that of the slow precession",
            figure: "largest |2 pi / w - 180| of the highest peak between 0.025 and 0.045 / t_c [t_c]; infinite unless w is the slow frequency and the peak a fifth of the highest",
            bound: Bound::AtMost(10.0),
            reason: "'about 180' read as 170 to 190",
            measure: period_of_slow_precession,
        },
    ]
}

fn message(e: twofold::Error) -> String {
    e.to_string()
}

fn each_line(
    least_wave: f64,
) -> Result<impl Iterator<Item = (&'static Example, &'static str, &'static SpectralLine)>, String> {
    let of = move |example: &'static Example| {
        example.signals().into_iter().flat_map(move |(signal, list)| {
            let wanted = move |line: &&SpectralLine| signal == "m.n" || line.amplitude >= least_wave;
            list.lines.iter().filter(wanted).map(move |line| (example, signal, line))
        })
    };
    Ok(examples()?.iter().flat_map(of))
}

fn all_identified() -> Result<Measured, String> {
    let (mut failed, mut total, mut detail) = (0, 0, String::new());
    for (example, signal, line) in each_line(0.0)? {
        total += 1;
        let what = example.basis.identify(line.frequency, line.uncertainty);
        if what.combination().is_none() {
            failed += 1;
            detail += &format!("; {} {signal} {:.9} ({:.1e}): {what}", example.name, line.frequency, line.amplitude);
        }
    }
    for example in examples()? {
        for (signal, list) in example.signals() {
            let asked = if signal == "m.n" { 1e-4 } else { 1e-6 };
            if list.remainder > asked {
                return Err(format!("{} {signal}: lines up to {:.1e} are left", example.name, list.remainder));
            }
        }
    }
    Ok(Measured::new(f64::from(failed), format!("of {total} lines{detail}")))
}

fn lines_against_rates() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (example, signal, line) in each_line(1e-5)? {
        let what = example.basis.identify(line.frequency, line.uncertainty);
        let misfit = what.combination().map_or(f64::INFINITY, |combination| combination.misfit.abs());
        worst.see(misfit, || {
            format!("{} {signal} {:.11}, {:.1e}: {what}", example.name, line.frequency, line.amplitude)
        });
    }
    worst.finish()
}

fn free_precession() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let free = free_precession_rates(&spheroid, 1.0, 0.7).map_err(message)?;
    let angles = EulerAngles { alpha: 0.4, beta: 0.7, gamma: 0.2 };
    let start =
        BodyState::from_angles(&spheroid, &angles, &EulerRates { alpha: free.alpha, beta: 0.0, gamma: free.gamma });
    let s = PrincipalCoefficients::new([0.0; 3]).tensor();
    let motion = propagate(&spheroid, &s, &start, (0.0, 2000.0), 1e-15).map_err(message)?;
    let (beam, observer) = (beam(), Observer::at(0.8, 0.0));
    let wave = |state: &BodyState<f64>| {
        let source = spheroid_inertia_acceleration(&spheroid, &s, &state.axis, &state.momentum);
        polarizations(&observer, &metric_perturbation(1.0, &source))
    };
    let list = |observable: &dyn Fn(&BodyState<f64>) -> f64| {
        Series::of_motion(&motion, 4096, observable)
            .and_then(|series| spectral_lines(&series, 1e-9, 20))
            .map_err(message)
    };
    let (a, g) = (free.alpha, free.gamma.abs());
    let mut worst = Worst::default();
    for (name, list, expected) in [
        ("m.n", list(&|state| beam.direction(state).dot(&observer.direction))?, vec![g, a - g, a, a + g]),
        ("h_+", list(&|state| wave(state).plus)?, vec![a, 2.0 * a]),
        ("h_x", list(&|state| wave(state).cross)?, vec![a, 2.0 * a]),
    ] {
        let mut found: Vec<f64> = list.lines.iter().map(|line| line.frequency).collect();
        found.sort_by(f64::total_cmp);
        let same = found.len() == expected.len() && found.iter().zip(&expected).all(|(x, y)| (x - y).abs() < 1e-11);
        let figure = if same { list.remainder } else { f64::INFINITY };
        worst.see(figure, || format!("{name}: lines {found:.9?}, remainder {:.1e}", list.remainder));
    }
    worst.finish()
}

fn slow_line_of_tp_2() -> Result<Measured, String> {
    let example = &examples()?[1];
    let line = strongest(&example.pulsar, 0.03..0.04)?;
    let rate = example.frequencies.momentum.ok_or("L has no mean azimuth")?.value;
    let highest = example.pulsar.lines[0].amplitude;
    let figure = if line.amplitude > 0.1 * highest { (line.frequency - rate.abs()).abs() } else { f64::INFINITY };
    let others: Vec<_> = example.pulsar.lines.iter().filter(|other| other.frequency < 0.05).collect();
    let named = |l: &&SpectralLine| {
        format!("{:.6} ({:.1e}) {}", l.frequency, l.amplitude, example.basis.identify(l.frequency, l.uncertainty))
    };
    let list = others.iter().map(|l| named(l)).collect::<Vec<_>>().join(", ");
    Ok(Measured::new(
        figure,
        format!("amplitude {:.3} of the highest; lines below 0.05: {list}", line.amplitude / highest),
    ))
}

fn slow_line_of_tp_1() -> Result<Measured, String> {
    let example = &examples()?[0];
    let (alpha, momentum) = (example.frequencies.alpha, example.frequencies.momentum);
    let locked = alpha.zip(momentum).is_some_and(|(a, l)| (a.value - l.value).abs() < 1e-11);
    let line = strongest(&example.pulsar, SLOW)?;
    let ratio = line.amplitude / example.pulsar.lines[0].amplitude;
    let what = example.basis.identify(line.frequency, line.uncertainty);
    Ok(Measured::new(if locked { ratio } else { f64::INFINITY }, format!("{:.7}: {what}", line.frequency)))
}

fn slow_line_of_waves() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for example in examples()? {
        for (signal, list) in example.waves() {
            // A list without a line there has none above the amplitude asked for.
            let line = strongest(list, SLOW).ok();
            let amplitude = line.map_or(1e-6, |line| line.amplitude);
            let ratio = amplitude / list.lines[0].amplitude;
            worst.see(ratio, || format!("{} {signal} at {:.6?}", example.name, line.map(|line| line.frequency)));
        }
    }
    worst.finish()
}

fn slow_magnitude() -> Result<Measured, String> {
    let slow = examples()?[1].frequencies.slow.ok_or("no slow precession")?.value;
    let s = COEFFICIENTS;
    let mean = (s.xx * s.yy * s.zz).abs().cbrt();
    Ok(Measured::new(slow.abs() / mean, format!("slow frequency {slow:.8}, coefficients {} to {}", s.yy, s.zz.abs())))
}

/// The highest lines about the fundamental and a harmonic.
fn pair(list: &LineList, harmonic: std::ops::Range<f64>) -> Result<[&SpectralLine; 2], String> {
    Ok([strongest(list, FUNDAMENTAL)?, strongest(list, harmonic)?])
}

fn third_harmonic(index: usize) -> Result<Measured, String> {
    let example = &examples()?[index];
    let (mut differences, mut details) = (Vec::new(), Vec::new());
    for (signal, list) in example.waves() {
        let [first, third] = pair(list, THIRD)?;
        differences.push((3.0 * first.frequency - third.frequency).abs());
        let named = [first, third].map(|l| example.basis.identify(l.frequency, l.uncertainty).to_string());
        let exact = strongest(list, 3.0 * first.frequency - 1e-6..3.0 * first.frequency + 1e-6)?;
        details.push(format!(
            "{signal}: {} ({:.2e}), {} ({:.2e}), three times the first ({:.2e})",
            named[0], first.amplitude, named[1], third.amplitude, exact.amplitude
        ));
    }
    Ok(Measured::new(largest(differences), details.join("; ")))
}

fn third_harmonic_ratio() -> Result<Measured, String> {
    let [weak, strong] = examples()?;
    let mut worst = Worst::default();
    for ((signal, weak), (_, strong)) in weak.waves().into_iter().zip(strong.waves()) {
        let ratio = |list| pair(list, THIRD).map(|[first, third]| third.amplitude / first.amplitude);
        let (weak, strong) = (ratio(weak)?, ratio(strong)?);
        worst.see(weak / strong, || format!("{signal}: {weak:.2e} in tp-I, {strong:.2e} in tp-II"));
    }
    worst.finish()
}

/// Lower and higher ratio of the two polarizations.
fn fourth_harmonic(index: usize) -> Result<[Measured; 2], String> {
    let example = &examples()?[index];
    let mut ratios = Vec::new();
    for (_, list) in example.waves() {
        ratios.push(strongest(list, FOURTH)?.amplitude / strongest(list, THIRD)?.amplitude);
    }
    let detail = format!("h_+ {:.3}, h_x {:.3}", ratios[0], ratios[1]);
    let (low, high) = if ratios[0] < ratios[1] { (ratios[0], ratios[1]) } else { (ratios[1], ratios[0]) };
    Ok([low, high].map(|ratio| Measured::new(ratio, detail.clone())))
}

fn peaks() -> Result<Measured, String> {
    let (mut inverse, mut details) = (Vec::new(), Vec::new());
    for example in examples()? {
        for (signal, list) in example.signals() {
            let line = strongest(list, FUNDAMENTAL)?;
            inverse.push(1.0 / (line.frequency - 1.438).abs());
            details.push(format!("{} {signal} {:.4}", example.name, line.frequency));
        }
    }
    Ok(Measured::new(1.0 / largest(inverse), details.join(", ")))
}

fn not_harmonics() -> Result<Measured, String> {
    let example = &examples()?[1];
    let mut shares = Vec::new();
    for (_, list) in example.waves() {
        let power = |line: &SpectralLine| line.amplitude * line.amplitude;
        let harmonic = |line: &&SpectralLine| {
            let what = example.basis.identify(line.frequency, line.uncertainty);
            what.combination().is_some_and(|c| c.integers()[1..].iter().all(|&k| k == 0))
        };
        let total: f64 = list.lines.iter().map(power).sum();
        let in_harmonics: f64 = list.lines.iter().filter(harmonic).map(power).sum();
        shares.push(1.0 - in_harmonics / total);
    }
    let least = if shares[0] < shares[1] { shares[0] } else { shares[1] };
    Ok(Measured::new(least, format!("h_+ {:.3}, h_x {:.3}", shares[0], shares[1])))
}

/// Period of gamma in the series of both examples: that whose first four multiples together have most power.
fn period_of_gamma() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for example in examples()? {
        for (name, values) in pulse_series(example)? {
            let spectrum = StampedSpectrum::of(&values)?;
            let power = |w: f64| (1..=4).map(|k| spectrum.amplitude(w * f64::from(k)).powi(2)).sum::<f64>();
            let w = highest(0.1..0.2, power)?;
            let rate = example.frequencies.gamma.ok_or("gamma has no mean rate")?.value;
            let figure = if (w - rate.abs()).abs() < GRID { (TAU / w - 40.0).abs() } else { f64::INFINITY };
            worst.see(figure, || {
                let multiples = [1.0, 2.0, 3.0, 4.0].map(|k| format!("{:.3}", spectrum.amplitude(k * w))).join(", ");
                format!("{} {name}: {:.1} t_c, amplitudes of the multiples {multiples} t_c", example.name, TAU / w)
            });
        }
    }
    worst.finish()
}

/// Period of the slow precession in the series of tp-II.
fn period_of_slow_precession() -> Result<Measured, String> {
    let example = &examples()?[1];
    let slow = example.frequencies.slow.ok_or("no slow precession")?.value;
    let (mut differences, mut details) = (Vec::new(), Vec::new());
    for (name, values) in pulse_series(example)? {
        let spectrum = StampedSpectrum::of(&values)?;
        let w = highest(0.025..0.045, |w| spectrum.amplitude(w))?;
        let strongest = spectrum.amplitude(highest(0.01..0.7, |w| spectrum.amplitude(w))?);
        let share = spectrum.amplitude(w) / strongest;
        let seen = (w - slow.abs()).abs() < GRID && share > 0.2;
        differences.push(if seen { (TAU / w - 180.0).abs() } else { f64::INFINITY });
        details.push(format!("{name}: {:.1} t_c, {share:.2} of the highest peak", TAU / w));
    }
    Ok(Measured::new(largest(differences), details.join("; ")))
}

/// The frequency of a grid at which a function is largest.
fn highest(range: std::ops::Range<f64>, function: impl Fn(f64) -> f64) -> Result<f64, String> {
    let count = ((range.end - range.start) / GRID) as usize;
    let points = (0..=count).map(|i| range.start + GRID * i as f64).map(|w| (w, function(w)));
    points.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(w, _)| w).ok_or_else(|| "no frequency".into())
}

fn pulse_series(example: &Example) -> Result<[(&'static str, Vec<Stamped>); 2], String> {
    let train = pulse_train(&example.motion, &beam(), &line_of_sight(), (0.0, SERIES)).map_err(message)?;
    Ok([("periods", train.periods().collect()), ("widths", train.durations().collect())])
}

/// Distance of two frequencies of a scan [1/t_c]: a quarter of the resolution of the series.
const GRID: f64 = 0.0005;

/// Length of the series [t_c].
const SERIES: f64 = 3000.0;

/// Amplitudes of a stamped series, tapered: in tp-II some turns have no pulse and some pulses merge, so that its series is not in equal
/// steps of anything and has no fast transform.
struct StampedSpectrum {
    /// Time and weighted value.
    points: Vec<(f64, f64)>,
}

impl StampedSpectrum {
    fn of(values: &[Stamped]) -> Result<Self, String> {
        let count = 4096;
        let taper = Window::Kaiser { shape: 8.0 }.weights(count).map_err(message)?;
        let weight = |point: &Stamped| taper[((point.time / SERIES * count as f64) as usize).min(count - 1)];
        let total: f64 = values.iter().map(weight).sum();
        let mean = values.iter().map(|point| weight(point) * point.value).sum::<f64>() / total;
        let points = values.iter().map(|point| (point.time, weight(point) * (point.value - mean) * 2.0 / total));
        Ok(Self { points: points.collect() })
    }

    fn amplitude(&self, w: f64) -> f64 {
        let (sin, cos) = self.points.iter().fold((0.0, 0.0), |(sin, cos), (time, value)| {
            let (s, c) = (w * time).sin_cos();
            (sin + value * s, cos + value * c)
        });
        sin.hypot(cos)
    }
}
