//! Parameter estimation: derivatives of data, degenerate directions, error bars, forecasts. Eqs. (25), (44), (71).

use std::collections::BTreeSet;

use crate::coverage::Coverage;
use crate::prelude::*;
use crate::simulation::Simulation;
use twofold::inference::{Datum, Direction, Event, Forecast, Noise, Place, forecast, jacobian, scaling};
use twofold::parameters::ThirdRate;
use twofold_scene::measurements::parameters_of;

checks! {
    /// derivatives of arrival times, closest approaches, widths, periods and strains by all 21 unknowns agree with data recomputed from changed
    /// scenes: tp-I and 6 random stars
    Oracle "data-derivatives" [25, 44, 71]: derivatives;
    AtMost(2e-8) "largest difference from differences of fourth order / largest derivative by the same unknown of the same kind of data";
    because "rounding of edges, 1e-13 and some times that for pulses that are slow at their edges, over the step of 1e-5: 1e-8; the truncation, which \
     falls with the fourth power of the step, was 3e-8 at twice this step, for the width of a short pulse";
    /// derivatives of arrival times, widths and strains after 1e9 turns, of stars with s = 1e-9, one with three eigenvalues in any frame and one
    /// with the tensor of alpha_2, are those of the pulses that PulsarClock finds for moved stars: by all unknowns that do not change the initial
    /// state; by all, after 1e6 turns with s = 1e-6, and after 1e5
    /// with s = 0.01
    Oracle "data-derivatives-decades" [5, 25, 44, 71]: decades;
    AtMost(1e-5) "largest difference from differences of fourth order / largest derivative by the same unknown of the same kind of data";
    because "steps of 1e-3 of the scale of each unknown move the slow precession of some 10 rad by 0.01 rad, those by unknowns that change rates \
     move the fast phases by as much: 1e-8 by truncation. A last digit of L in a moved start is 1e-9 rad after 1e6 turns and 1e-6 of a derivative by \
     an angle, 1e3 times as much after 1e9 turns: there these unknowns are left out. Rounding of edges, 1e-14, over a step is taken for nothing";
    /// after 1e9 turns the symmetries are found and named as over short spans, for a star with the tensor of alpha_2 and one with three eigenvalues
    Oracle "degenerate-directions-named-decades" [5, 23, 44, 71]: directions_of_decades;
    AtMost(0.0) "directions that are missing, without a name, or too many, of all 21 unknowns by arrivals and widths";
    because "exact: each symmetry is named or not";
    /// of all 21 unknowns every symmetry is found and named and nothing else is degenerate: the trace of s, C against s, gamma against delta,
    /// rotations of all, the strain scale; sets without them have full rank
    Oracle "degenerate-directions-named" [23, 44, 71]: directions;
    AtMost(0.0) "directions that are missing, without a name, or too many, in 11 sets of data and unknowns";
    because "exact: each symmetry is named or not";
    /// fits recover the true parameters, and their error bars hold: 90 simulated measurements of random stars by pulses, by strain and by both,
    /// 10 to 13 unknowns, started three standard deviations off
    Oracle "fit-coverage" [25, 44, 71]: coverage;
    AtMost(4.0) "largest of |score| of five: parts within one and two standard deviations, mean pull, chi^2 of unknowns, chi^2 of residuals; a fit \
     that fails is infinite";
    because "scores are standard normal if error bars hold: one of five is above 4 with 3e-4. Bars too small by a tenth give 4.9 for chi^2 of the \
     unknowns alone";
    /// with the span fixed, the uncertainty of s goes as the inverse root of the number of pulses
    Regime "forecast-scaling-with-number" [44]: number_scaling;
    Within(-0.53, -0.47) "power of the number of epochs, tp-2 with phi_o = 1, 12800 t_c, 200 to 1600 epochs";
    because "equally spaced epochs beat with the turns of the star, which changes single forecasts by some 5 %: over a factor of eight, 0.03";
    /// where the slow precession is far from a full turn, and the frame of s and the observer are known, the uncertainty of s goes as the inverse
    /// of the span: the drift of the spin axis is measured, as in Eq. (41)
    Regime "forecast-known-frame" [41, 44]: known_frame;
    Within(-1.1, -0.9) "power of the span, tp-2 with s over 4000 and phi_o = 1, 500 to 8000 t_c, 100 epochs, 7 unknowns";
    because "s t is 2e-3 to 0.03 rad of slow precession and the next order that much of it; equally spaced epochs beat with the turns of the star, \
     some 5 %";
    /// where the slow precession is far from a full turn and the frame of s is unknown, the uncertainty of s goes as the inverse third power of the
    /// span: five unknowns (two of s, two of its frame, one of the observer) need the drift of the spin axis to third order in s t
    Regime "forecast-unknown-frame" [44]: unknown_frame;
    Within(-3.1, -2.8) "power of the span, sp-1 with s over 4000 and phi_o = 1, 1000 to 16000 t_c, 100 epochs, 13 unknowns";
    because "as for the known frame; the last span is a third of a radian of slow precession";
    /// in the same case the uncertainty scales as the inverse square of s, so that the relative one scales as (s t)^-3
    Regime "forecast-unknown-frame-size" [44]: size_scaling;
    Within(3.6, 4.4) "uncertainty with s over 8000 / uncertainty with s over 4000, sp-1, phi_o = 1, 8000 t_c";
    because "four in the limit; the next order is s t = 0.15 rad of slow precession, and epochs beat with the turns";
}

fn tp_1() -> Result<Parameters<f64>, String> {
    parameters_of(&Scene::named("tp-1")?).map_err(String::from)
}

/// Values of the data `wanted` of a model, for the same turns, counted from the pulse nearest to the first one.
fn values(
    model: &Parameters<f64>,
    end: f64,
    events: &[Event],
    wanted: &[Datum],
    noise: &[Noise],
) -> Result<Vec<f64>, String> {
    let signal = Signal::new(model, end)?;
    let mut moved = signal.events()?;
    if let Some(first) = events.first() {
        let distance = |event: &&Event| (event.midpoint() - first.midpoint()).abs();
        let nearest = moved.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).ok_or("no pulse")?;
        let shift = first.turn - nearest.turn;
        moved.iter_mut().for_each(|event| event.turn += shift);
        let turns: BTreeSet<i64> = events.iter().map(|event| event.turn).collect();
        moved.retain(|event| turns.contains(&event.turn));
    }
    let samples: Vec<f64> = wanted
        .iter()
        .filter(|datum| datum.observable == Observable::StrainPlus)
        .map(|datum| match datum.place {
            Place::Time(t) => t,
            Place::Turn { near, .. } => near,
        })
        .collect();
    let data = data_of(&signal, &moved, &samples, noise)?;
    if data.len() != wanted.len() {
        return Err(format!("{} data of a moved scene for {}", data.len(), wanted.len()));
    }
    Ok(data.iter().map(|datum| datum.value).collect())
}

fn derivatives() -> Result<Measured, String> {
    const STEP: f64 = 1e-5;
    let end = 40.0;
    let noise: Vec<Noise> = Observable::ALL.into_iter().map(|observable| (observable, 1.0)).collect();
    let mut worst = Worst::default();
    let mut models = vec![("tp-1".to_owned(), tp_1()?)];
    for seed in 0..6 {
        models.push((format!("seed {seed}"), Simulation::new(3 * seed)?.truth));
    }
    for (name, model) in &models {
        let signal = Signal::new(model, end)?;
        let turn = signal.turn();
        let mut events = signal.events()?;
        // Only pulses that a changed scene also has, and none so short that its edges vary as a root of the step.
        events.retain(|event| event.start > turn && event.end < end - turn && event.end - event.start > 0.1 * turn);
        let samples = [0.0, 13.0, 39.0];
        let data = data_of(&signal, &events, &samples, &noise)?;
        let exact = jacobian(model, &events, &data, &Parameter::FITTED)?.matrix;
        for (column, unknown) in Parameter::FITTED.iter().enumerate() {
            let at = |steps: f64| values(&model.moved(&[*unknown], &[steps * STEP]), end, &events, &data, &noise);
            let [two, one, minus_one, minus_two] = [at(2.0)?, at(1.0)?, at(-1.0)?, at(-2.0)?];
            for observable in Observable::ALL {
                let rows = || (0..data.len()).filter(|row| data[*row].observable == observable);
                // One for an unknown without effect.
                let scale = largest(rows().map(|row| exact[(row, column)].abs())).max(1.0);
                let difference =
                    |row: usize| (8.0 * (one[row] - minus_one[row]) - (two[row] - minus_two[row])) / (12.0 * STEP);
                let error = largest(rows().map(|row| (exact[(row, column)] - difference(row)).abs())) / scale;
                worst.see(error, || format!("{name}: {} by {}", observable.key(), unknown.key()));
            }
        }
    }
    worst.finish()
}

/// A star whose `s^IJ` has a given size, in any frame: with three eigenvalues, or of the form of alpha_2.
fn slow_star(size: f64, of_alpha_2: bool) -> Parameters<f64> {
    let s = if of_alpha_2 {
        let w = nalgebra::Vector3::new(0.48, -0.6, 0.64);
        -w * w.transpose()
    } else {
        nalgebra::Matrix3::new(0.5, 0.3, -0.2, 0.3, -0.4, 0.35, -0.2, 0.35, 0.1)
    };
    let angles = EulerAngles { alpha: 0.7, beta: 0.9, gamma: 0.4 };
    let rates = EulerRates { alpha: 0.11, beta: -0.07, gamma: 0.0 };
    Parameters {
        third_rate: ThirdRate::Spin(1.3),
        chi: 0.8,
        delta: 0.3,
        rho: 0.6,
        theta_o: 1.1,
        phi_o: 0.2,
        strain_scale: 0.7,
        ..Parameters::new(
            RigidSpheroid { inertia_xx: 0.8, inertia_zz: 0.8 * 1.02, constant_c: 1.3 },
            s * size,
            angles,
            rates,
        )
    }
}

const LONG_NOISE: [Noise; 2] = [(Observable::Arrivals, 1e-3), (Observable::Widths, 1e-3)];

fn decades() -> Result<Measured, String> {
    use Parameter::*;
    let mut worst = Worst::default();
    let strain = [LONG_NOISE[0], LONG_NOISE[1], (Observable::StrainPlus, 1.0), (Observable::StrainCross, 1.0)];
    // Widths of the strong tensor change with the precession: the step is a tenth.
    for (size, end, part) in [(1e-9, 6e9, 1e-3), (1e-6, 6e6, 1e-3), (0.01, 6e5, 1e-4)] {
        for of_alpha_2 in [false, true] {
            let model = slow_star(size, of_alpha_2);
            let times: Vec<f64> = (0..12).map(|k| end * (f64::from(k) + 0.4) / 12.0).collect();
            let signal = Signal::new(&model, end)?;
            let events = signal.events_after(&times)?;
            let data = data_of(&signal, &events, &times, &strain)?;
            let exact = jacobian(&model, &events, &data, &Parameter::FITTED)?.matrix;
            let turns: Vec<(i64, f64)> =
                events.iter().map(|event| (event.turn, event.epoch + event.midpoint())).collect();
            for (column, unknown) in Parameter::FITTED.iter().enumerate() {
                let changes_rates = [Oblateness, Spin, Beta, AlphaRate, BetaRate].contains(unknown);
                if end > 1e9 && (changes_rates || [Alpha, Gamma].contains(unknown)) {
                    continue;
                }
                let scale = match unknown {
                    unknown if unknown.is_of_s() && *unknown != SScale => size.min(10.0 / end),
                    _ if changes_rates => 10.0 / end,
                    // A change that turns the slow precession by as much.
                    _ => f64::min(1.0, 10.0 / end / size),
                };
                let step = part * scale;
                let at = |steps: f64| -> Result<Vec<Datum>, String> {
                    let moved = Signal::new(&model.moved(&[*unknown], &[steps * step]), end)?;
                    let events = moved.events_of_turns(&turns)?;
                    data_of(&moved, &events, &times, &strain).map_err(String::from)
                };
                let [two, one, minus_one, minus_two] = [at(2.0)?, at(1.0)?, at(-1.0)?, at(-2.0)?];
                for kind in [Observable::Arrivals, Observable::Widths, Observable::StrainPlus, Observable::StrainCross]
                {
                    // Waves at fixed times turn many times during a step of a rate, and after 1e6 turns a moved start is rounded.
                    if !kind.is_of_pulses() && (changes_rates || [Alpha, Gamma].contains(unknown)) {
                        continue;
                    }
                    let of_kind = || (0..data.len()).filter(|row| data[*row].observable == kind);
                    // The width of a pulse that is about to disappear varies as a square root, which differences do not follow.
                    let widest = largest(of_kind().map(|row| data[row].value));
                    let is_short = |row: &usize| kind == Observable::Widths && data[*row].value < 0.5 * widest;
                    let rows = || of_kind().filter(|row| !is_short(row));
                    let largest_derivative =
                        largest(rows().map(|row| exact[(row, column)].abs() * scale)).max(1e-9 / part);
                    let change = |a: &Datum, b: &Datum| (a.epoch - b.epoch) + (a.value - b.value);
                    let places = |datum: &Datum| match datum.place {
                        Place::Turn { number, .. } => (Some(number), 0.0),
                        Place::Time(t) => (None, t),
                    };
                    let is_same = |a: &Datum, b: &Datum| a.observable == b.observable && places(a) == places(b);
                    // A changed star may have no pulse in a turn.
                    let of =
                        |list: &'_ [Datum], row: usize| list.iter().find(|datum| is_same(datum, &data[row])).copied();
                    let errors: Vec<f64> = rows()
                        .filter_map(|row| {
                            let near = change(&of(&one, row)?, &of(&minus_one, row)?);
                            let far = change(&of(&two, row)?, &of(&minus_two, row)?);
                            Some((exact[(row, column)] * scale - (8.0 * near - far) / (12.0 * part)).abs())
                        })
                        .collect();
                    if 2 * errors.len() < rows().count() {
                        return Err(format!("s = {size:e}: most turns are dark for stars moved by {}", unknown.key()));
                    }
                    let error = largest(errors);
                    worst.see(error / largest_derivative, || {
                        format!("s = {size:e}, alpha_2 {of_alpha_2}: {} by {}", kind.key(), unknown.key())
                    });
                }
            }
        }
    }
    worst.finish()
}

fn directions_of_decades() -> Result<Measured, String> {
    let (mut wrong, mut detail) = (0, Vec::new());
    for of_alpha_2 in [false, true] {
        let (model, end) = (slow_star(1e-9, of_alpha_2), 6e9);
        let signal = Signal::new(&model, end)?;
        let times: Vec<f64> = (0..200).map(|k| end * f64::from(k) / 200.0).collect();
        let events = signal.events_after(&times)?;
        let data = data_of(&signal, &events, &[], &LONG_NOISE)?;
        let found = Fisher::of(&model, &events, &data, &Parameter::FITTED)?;
        let amiss = amiss(&found.degenerate, &SYMMETRIES);
        detail.push(format!("{} directions, rounding {:.1e}", found.degenerate.len(), found.rounding));
        if amiss > 0 {
            detail.extend(found.degenerate.iter().map(ToString::to_string));
            detail.push(format!("{:?}", found.singular_values));
        }
        wrong += amiss;
    }
    Ok(Measured::new(wrong as f64, detail.join(" | ")))
}

/// Data and the Fisher matrix of a built-in scene.
fn fisher(scene: &str, noise: &[Noise], unknowns: &[Parameter]) -> Result<Fisher, String> {
    let scene = Scene::named(scene)?;
    // At this azimuth no horizontal axis is X or Y.
    let model = Parameters { phi_o: 0.7, ..parameters_of(&scene)? };
    let end = 100.0;
    let signal = Signal::new(&model, end)?;
    let events = signal.events()?;
    let samples: Vec<f64> = (0..60).map(|k| end * (f64::from(k) / 59.0)).collect();
    let data = data_of(&signal, &events, &samples, noise)?;
    Fisher::of(&model, &events, &data, unknowns).map_err(String::from)
}

/// Words of the degenerate directions of all unknowns for data of pulses.
const SYMMETRIES: [&str; 8] = [
    "the trace of s^IJ",
    "the strain scale",
    "C against the size",
    "C against s^IJ",
    "gamma against delta",
    "Z: no direction",
    "normal of Z and the line of sight: no direction",
    "line of sight on X-Y: no direction",
];

/// The larger of the number of expected words that no direction has, and the difference of the numbers of directions.
fn amiss(found: &[Direction], expected: &[&str]) -> usize {
    let is_named = |words: &&&str| found.iter().any(|direction| direction.words.is_some_and(|w| w.contains(**words)));
    let missing = expected.len() - expected.iter().filter(is_named).count();
    missing.max(found.len().abs_diff(expected.len()))
}

/// A built-in scene, the measured quantities, the unknowns, and parts of the words for every degenerate direction.
type Case<'a> = (&'a str, &'a [Noise], &'a [Parameter], &'a [&'a str]);

fn directions() -> Result<Measured, String> {
    use Parameter::*;
    let pulses = [(Observable::Arrivals, 1e-3), (Observable::Widths, 1e-3)];
    let strain = [(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 1e-3)];
    let both = [pulses, strain].concat();
    let frame = [SAxial, SAsymmetry, S(0, 1), S(0, 2), S(1, 2), Alpha, Beta, Gamma, AlphaRate, BetaRate, ThetaO, PhiO];
    let cases: [Case<'_>; 11] = [
        ("tp-1", &pulses, &Parameter::OF_PULSES, &[]),
        ("tp-2", &pulses, &Parameter::OF_PULSES, &[]),
        ("sp-1", &pulses, &Parameter::OF_PULSES, &[]),
        ("tp-1", &strain, &Parameter::OF_STRAIN, &[]),
        ("tp-1", &both, &[Oblateness, Spin, SAxial, SAsymmetry, Alpha, Beta, AlphaRate, Strain], &[]),
        (
            "tp-1",
            &pulses,
            &[ConstantC, SScale, Oblateness, Spin, STrace],
            &["the trace of s^IJ", "C against the size of s"],
        ),
        (
            "tp-2",
            &pulses,
            &[ConstantC, SAxial, SAsymmetry, S(0, 1), S(0, 2), S(1, 2), Gamma, Delta],
            &["C against s^IJ", "gamma against delta"],
        ),
        (
            "tp-2",
            &pulses,
            &frame,
            &[
                "Z: no direction",
                "normal of Z and the line of sight: no direction",
                "line of sight on X-Y: no direction",
            ],
        ),
        (
            "tp-2",
            &strain,
            &frame,
            &["gamma: a spheroid", "Z: no direction", "normal of Z and the line of sight: no direction"],
        ),
        ("sp-1", &strain, &[Oblateness, Spin, Strain, SAxial], &["eps against Omega^z"]),
        ("tp-1", &pulses, &Parameter::FITTED, &SYMMETRIES),
    ];
    let (mut wrong, mut detail) = (0, Vec::new());
    for (scene, noise, unknowns, expected) in cases {
        let found = fisher(scene, noise, unknowns)?.degenerate;
        let amiss = amiss(&found, expected);
        if amiss > 0 {
            let found: Vec<_> = found.iter().map(ToString::to_string).collect();
            detail.push(format!("{scene}, {} unknowns: {}", unknowns.len(), found.join("; ")));
        }
        wrong += amiss;
    }
    Ok(Measured::new(wrong as f64, if detail.is_empty() { "all as expected".to_owned() } else { detail.join(" | ") }))
}

fn coverage() -> Result<Measured, String> {
    Coverage::of(0..90, crate::coverage::Case::of_motion).worst_score()
}

const TIMES_AND_WIDTHS: [Noise; 2] = [(Observable::Arrivals, 1e-4), (Observable::Widths, 1e-4)];

/// A built-in scene with s scaled, at an azimuth from which the first drift of the spin axis is visible.
fn scaled(name: &str, scale: f64) -> Result<Parameters<f64>, String> {
    let model = parameters_of(&Scene::named(name)?)?;
    Ok(Parameters { coefficients: model.coefficients * scale, phi_o: 1.0, ..model })
}

fn number_scaling() -> Result<Measured, String> {
    let unknowns = Parameter::OF_PULSES;
    let epochs = [200, 400, 800, 1600];
    power(forecast(&scaled("tp-2", 1.0)?, &TIMES_AND_WIDTHS, &unknowns, Parameter::SAxial, &[12800.0], &epochs), 1)
}

fn known_frame() -> Result<Measured, String> {
    use Parameter::*;
    let unknowns = [SScale, Oblateness, Spin, Gamma, AlphaRate, Chi, Rho];
    let (model, spans) = (scaled("tp-2", 1.0 / 4000.0)?, [500.0, 1000.0, 2000.0, 4000.0, 8000.0]);
    power(forecast(&model, &TIMES_AND_WIDTHS, &unknowns, SScale, &spans, &[100]), 0)
}

fn unknown_frame() -> Result<Measured, String> {
    let (model, spans) = (scaled("sp-1", 1.0 / 4000.0)?, [1000.0, 2000.0, 4000.0, 8000.0, 16000.0]);
    power(forecast(&model, &TIMES_AND_WIDTHS, &Parameter::OF_PULSES, Parameter::SAxial, &spans, &[100]), 0)
}

fn size_scaling() -> Result<Measured, String> {
    let sigma = |scale: f64| {
        let unknowns = Parameter::OF_PULSES;
        forecast(&scaled("sp-1", scale)?, &TIMES_AND_WIDTHS, &unknowns, Parameter::SAxial, &[8000.0], &[1000])
            .map_err(String::from)
    };
    let (small, large) = (sigma(1.0 / 8000.0)?[0].sigma, sigma(1.0 / 4000.0)?[0].sigma);
    Ok(Measured::new(small / large, format!("{small:.2e} over {large:.2e}")))
}

fn power(found: Result<Vec<Forecast>, InferenceError>, which: usize) -> Result<Measured, String> {
    let found = found?;
    let slope = scaling(&found)[which].ok_or("no slope")?;
    let listed: Vec<_> =
        found.iter().map(|f| format!("{} t_c, {} epochs: {:.2e}", f.span, f.epochs, f.sigma)).collect();
    Ok(Measured::new(slope.value, format!("+- {:.3}; {}", slope.error, listed.join(", "))))
}
