//! From data back to the scene: successful and refused fits.

use crate::common::{Folder, altered, cells, has_all, stderr, stdout};
use twofold::dynamics::RigidSpheroid;
use twofold::euler_angles::EulerAngles;
use twofold::inference::{Datum, Fisher, InferenceError, Noise, Observable, Place, Signal, data_of, fit, nonlinearity};
use twofold::parameters::{Parameter, Parameters};
use twofold_scene::measurements::{beside, parameters_of, with_noise};
use twofold_scene::scene_file::Scene;
use twofold_verify::simulation::Simulation;

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

const TIMES_AND_WIDTHS: [Noise; 2] = [(Observable::Arrivals, 1e-5), (Observable::Widths, 1e-5)];

fn model(name: &str) -> Parameters<f64> {
    parameters_of(&Scene::named(name).expect("scene")).expect("model")
}

/// Exact data of all pulses except those of the first turn.
fn data(model: &Parameters<f64>, end: f64, noise: &[Noise]) -> Vec<Datum> {
    let signal = Signal::new(model, end).expect("signal");
    let mut events = signal.events().expect("pulses");
    events.retain(|event| event.start > signal.turn());
    let samples: Vec<f64> = (0..50).map(|k| end * (f64::from(k) / 49.0)).collect();
    data_of(&signal, &events, &samples, noise).expect("data")
}

/// Data without errors give the true parameters, from an offset of hundreds of error bars, to the accuracy of the motion.
#[test]
fn exact_data_give_the_truth() {
    let truth = model("tp-2");
    let strain = [(Observable::StrainPlus, 1e-6), (Observable::StrainCross, 1e-6)];
    for (unknowns, noise) in [
        (&Parameter::OF_PULSES[..], &TIMES_AND_WIDTHS[..]),
        (
            &Parameter::OF_PULSES,
            &[(Observable::ClosestApproaches, 1e-5), (Observable::Periods, 1e-5), (Observable::Widths, 1e-5)],
        ),
        (&Parameter::OF_STRAIN, &strain),
    ] {
        let data = data(&truth, 100.0, noise);
        let off: Vec<f64> = (0..unknowns.len()).map(|k| if k % 2 == 0 { 1e-4 } else { -1e-4 }).collect();
        let found = fit(&truth.moved(unknowns, &off), &data, unknowns, 100.0).expect("fit");
        assert!(found.chi_squared < 1e-6, "{noise:?}: chi^2 = {}", found.chi_squared);
        for ((value, truth), sigma) in
            found.fisher.values().iter().zip(truth.values(unknowns)).zip(found.fisher.sigmas())
        {
            assert!((value - truth).abs() < 1e-4 * sigma + 1e-12, "{value} for {truth} +- {sigma}");
        }
    }
}

/// The covariance does not depend on the particular errors of the data, and is proportional to their variance.
#[test]
fn error_bars_are_in_proportion_to_the_errors() {
    let truth = model("tp-2");
    let unknowns = &Parameter::OF_PULSES;
    let exact = data(&truth, 100.0, &TIMES_AND_WIDTHS);
    let large: Vec<Datum> = exact.iter().map(|datum| Datum { sigma: 3.0 * datum.sigma, ..*datum }).collect();
    let sigmas = |data: &[Datum]| fit(&truth, data, unknowns, 100.0).expect("fit").fisher.sigmas();
    for (small, large) in sigmas(&exact).iter().zip(sigmas(&large)) {
        assert!((large / small / 3.0 - 1.0).abs() < 1e-6);
    }
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let measured = with_noise(&exact, &mut random);
    let noisy = fit(&truth, &measured, unknowns, 100.0).expect("fit");
    assert!(nonlinearity(&noisy.fisher, &measured, 100.0).expect("motions") < 0.1);
    for (with, without) in noisy.fisher.sigmas().iter().zip(sigmas(&exact)) {
        assert!((with / without - 1.0).abs() < 0.05, "{with} {without}");
    }
}

/// After 1e9 turns exact data give s = 1e-9, beam, observer and phase for a known wobble, whose derivatives cancel to 1e-13, below their rounding.
#[test]
fn decades_give_the_truth() {
    let near = model("tp-2");
    let truth = Parameters { coefficients: near.coefficients * 1e-9, phi_o: 1.0, ..near };
    use Parameter::{Chi, Gamma, PhiO, Rho, SAsymmetry, SAxial, Spin, ThetaO};
    let (unknowns, end) = (&[SAxial, SAsymmetry, Spin, Gamma, Chi, Rho, ThetaO, PhiO], 6e9);
    let signal = Signal::new(&truth, end).expect("signal");
    assert!(signal.is_long() && signal.events().is_err());
    let times: Vec<f64> = (1..60).map(|k| end * f64::from(k) / 60.0).collect();
    let events = signal.events_after(&times).expect("pulses");
    let data =
        data_of(&signal, &events, &[], &[(Observable::Arrivals, 1e-3), (Observable::Widths, 1e-3)]).expect("data");
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let fisher = Fisher::of(&truth, &events, &data, unknowns).expect("Fisher matrix");
    assert!(fisher.degenerate.is_empty() && fisher.weak.is_empty(), "{:?} {:?}", fisher.degenerate, fisher.weak);
    let start = beside(&fisher, 0.3, &mut random).expect("a start");
    let found = fit(&start, &data, unknowns, end).expect("fit");
    // The last digit of L is 1e-6 rad, a thousandth of an error.
    assert!(found.chi_squared < 1e-3, "chi^2 = {}", found.chi_squared);
    for ((value, truth), sigma) in found.fisher.values().iter().zip(truth.values(unknowns)).zip(found.fisher.sigmas()) {
        assert!((value - truth).abs() < 0.05 * sigma, "{value} for {truth} +- {sigma}");
    }
}

/// The strain of a strong violation after 1e8 turns gives the true parameters by the motion on the torus. Its pulses by the averaged motion are
/// refused.
#[test]
fn strains_of_a_strong_violation_may_be_of_any_span() {
    use Parameter::{SAxial, Spin};
    let (truth, unknowns, end) = (model("tp-2"), &[SAxial, Spin], 1e9);
    let signal = Signal::new(&truth, end).expect("signal");
    assert!(signal.is_long());
    // Its pulses are found at late times, too.
    let events = signal.events_after(&[1e8, 2e8, 3e8, 4e8, 5e8]).expect("pulses");
    let turns: Vec<_> = events.iter().map(|event| (event.turn, event.epoch + event.midpoint())).collect();
    let again = signal.events_of_turns(&turns).expect("the same pulses");
    assert!(!events.is_empty() && again.len() == events.len());
    assert!(again.iter().zip(&events).all(|(a, b)| a.turn == b.turn && (a.start - b.start).abs() < 1e-9));
    let times: Vec<f64> = (1..60).map(|k| end * f64::from(k) / 60.0).collect();
    let noise = [(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 1e-3)];
    let data = data_of(&signal, &[], &times, &noise).expect("data");
    let fisher = Fisher::of(&truth, &[], &data, unknowns).expect("Fisher matrix");
    assert!(fisher.degenerate.is_empty() && fisher.weak.is_empty(), "{:?} {:?}", fisher.degenerate, fisher.weak);
    // Two phases 1e9 t_c apart determine two frequencies to about 1e-3 / 1e9.
    assert!(fisher.sigmas().iter().all(|sigma| *sigma < 1e-10), "{:?}", fisher.sigmas());
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let found = fit(&beside(&fisher, 0.3, &mut random).expect("a start"), &data, unknowns, end).expect("fit");
    for ((value, truth), sigma) in found.fisher.values().iter().zip(truth.values(unknowns)).zip(found.fisher.sigmas()) {
        assert!((value - truth).abs() < 0.05 * sigma, "{value} for {truth} +- {sigma}");
    }
}

/// A repeated simulation is equal to the bit; one with another number differs.
#[test]
fn simulations_follow_from_their_number() {
    let [a, b, c] = [4, 4, 5].map(|seed| Simulation::new(seed).expect("simulation"));
    assert_eq!((a.truth, &a.data, a.start), (b.truth, &b.data, b.start));
    assert_ne!(a.truth, c.truth);
}

#[test]
fn what_the_data_do_not_determine_is_refused_with_the_reason() {
    use Parameter::*;
    let truth = model("tp-2");
    let strain = [(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 1e-3)];
    for (unknowns, noise, reasons) in [
        (&[Gamma, Delta, Spin][..], &TIMES_AND_WIDTHS[..], &["only gamma + delta", "d(gamma) : d(delta) = "][..]),
        (&[ConstantC, SScale], &TIMES_AND_WIDTHS, &["only C s^IJ / I^xx moves the star"]),
        (&[STrace, Spin], &TIMES_AND_WIDTHS, &["a multiple of the unit tensor exerts no torque", "d(tr s) alone"]),
        (&[Alpha, PhiO, S(0, 1), Spin], &TIMES_AND_WIDTHS, &["rotation of all (star, s^IJ and observer) about Z"]),
        (&[Oblateness, Spin, Strain], &strain, &["h is in proportion to eps"]),
        (&[Spin, Chi], &strain, &["chi: pulses and their widths show it, and these data do not"]),
        // Determined in principle, but not by such imprecise data.
        (&Parameter::OF_PULSES, &[(Observable::Arrivals, 1e3), (Observable::Widths, 1e3)], &["d("]),
    ] {
        match fit(&truth, &data(&truth, 100.0, noise), unknowns, 100.0) {
            Err(error @ InferenceError::Degenerate(_)) => has_all(&error.to_string(), reasons),
            other => panic!("{unknowns:?}: {other:?}"),
        }
    }
}

/// A star of tp-1's shape, seen from off the poles.
const STAR: &str = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\n\
    alpha = 1.5707963267948966\nbeta = 0.7\ngamma = 0.3\nalpha_rate = 1.51\nbeta_rate = 0.1\n[observer]\ntheta_o = 0.8\nphi_o = 0.4\n[pulsar]\n\
    chi = 0.5\ndelta = 0.2\nrho = 0.6\n[time]\nspan = 100.0\nsamples = 51\n";

/// Pulses do not depend on eps for a star without spin, nor on C for one without a torque, nor on eps for a star at rest on an axis of s; the strain
/// of a star at rest about its axis is zero. Derivatives by these parameters are rounding. They are named, and other error bars are unchanged.
#[test]
fn an_unknown_without_effect_is_named_and_leaves_the_others_alone() {
    let folder = Folder::new();
    let pulses = "arrivals:1e-5,widths:3e-5";
    let rest =
        [("beta = 0.7", "beta = 1.5707963267948966"), ("_rate = 1.51", "_rate = 0.0"), ("_rate = 0.1", "_rate = 0.0")];
    let [no_spin, isotropic] = [("spin = 1.0", "spin = 0.0"), ("[0.02, 0.01, -0.04]", "[0.01, 0.01, 0.01]")];
    let cases = [
        (
            &[no_spin][..],
            pulses,
            "eps",
            "spin,beta,gamma,rho",
            "d(eps) alone (over its whole range no datum changes by more than rounding)",
        ),
        (&[isotropic][..], pulses, "c", "spin,eps,rho", "C: the torque changes none of these data; d(C) alone"),
        (
            &rest[..],
            pulses,
            "eps",
            "spin,rho",
            "d(eps) alone (over its whole range no datum changes by more than rounding)",
        ),
        (&rest[..], "strain:1e-3", "s_axial", "", "d(s_axial) alone"),
    ];
    for (changes, observe, idle, others, named) in cases {
        let text = changes.iter().fold(STAR.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        });
        folder.write("star.toml", text);
        let sigmas = |unknowns: &str| {
            let args = [
                "fisher",
                "star.toml",
                "--observe",
                observe,
                "--parameters",
                unknowns,
                "--out",
                "sigmas.csv",
                "--force",
            ];
            let told = stderr(&folder.run(&args));
            let table = folder.read("sigmas.csv");
            let rows = cells(&table).into_iter().skip(1);
            let rows: Vec<_> = rows.map(|row| (row[0].to_owned(), row[2].parse::<f64>().unwrap_or(f64::NAN))).collect();
            (rows, told)
        };
        if others.is_empty() {
            let (_, told) = sigmas(&format!("{idle},spin"));
            assert!(told.contains("no datum changes by more than rounding"), "{told}");
            continue;
        }
        let ((with, told), (without, _)) = (sigmas(&format!("{idle},{others}")), sigmas(others));
        assert!(told.contains(named), "{told}");
        assert!(with[0].1.is_nan() && with.len() == without.len() + 1, "{with:?}");
        for ((name, with), (_, without)) in with[1..].iter().zip(&without) {
            assert!((with / without - 1.0).abs() < 1e-9, "{name}: {with:e}, alone {without:e}");
        }
    }
}

#[test]
fn data_that_are_too_few_or_of_no_pulse_are_refused() {
    let truth = model("tp-2");
    let all = data(&truth, 100.0, &TIMES_AND_WIDTHS);
    let too_few = fit(&truth, &all[..13], &Parameter::OF_PULSES, 100.0).expect_err("as many data as unknowns");
    assert_eq!(too_few, InferenceError::TooFew { data: 13, least: 14 });
    let mut strange = all.clone();
    let place = Place::Turn { number: 4000, near: 50.0 };
    strange.push(Datum { observable: Observable::Arrivals, place, epoch: 0.0, value: 50.0, sigma: 1e-5 });
    let error = fit(&truth, &strange, &Parameter::OF_PULSES, 100.0).expect_err("no such turn");
    assert!(matches!(error, InferenceError::NoPulse { turn: 4000, .. }), "{error}");
    assert!(error.to_string().contains("turn 4000"), "{error}");
}

/// The strain exceeds that of the most oblate star: the fit stops at the limit and says so.
#[test]
fn a_fit_that_ends_on_a_limit_is_refused() {
    let truth = model("tp-2");
    let noise = [(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 1e-3)];
    let oblate = |eps: f64| Parameters { spheroid: RigidSpheroid::in_units_of_tc(1.0 + eps), ..truth };
    let most = data(&oblate(0.99), 0.2, &noise);
    let more: Vec<Datum> = most.iter().map(|datum| Datum { value: 2.0 * datum.value, ..*datum }).collect();
    let error = fit(&oblate(0.9), &more, &[Parameter::Oblateness], 0.2).expect_err("limit");
    assert!(matches!(error, InferenceError::OnLimit { unknown: "eps", .. }), "{error}");
}

#[test]
fn series_written_by_the_command_are_fitted() {
    let scene = |spin| {
        let spin = ("spin = 1.0", spin);
        altered("tp-2", &[spin, ("span = 400", "span = 100"), ("samples = 4001", "samples = 201")])
    };
    let folder = Folder::with(&[("truth.toml", &scene("spin = 1.0")), ("near.toml", &scene("spin = 1.0003"))]);
    folder.succeeds(&["pulses", "truth.toml", "--out", "pulses.csv"]);
    folder.succeeds(&["run", "truth.toml", "--columns", "h", "--out", "strain.csv"]);
    let fit = |args: &[&str]| folder.succeeds(&[&["fit", "near.toml", "pulses.csv", "--observe"], args].concat());
    let output = fit(&["arrivals:1e-5,widths:1e-5,strain:1e-5", "strain.csv", "--out", "table.csv"]);
    let written = folder.read("table.csv");
    let table = cells(&written);
    let spin = table.iter().find(|row| row[0] == "spin").expect("spin");
    let (value, sigma): (f64, f64) = (spin[1].parse().expect("number"), spin[2].parse().expect("number"));
    assert!((value - 1.0).abs() < 1e-9 && sigma > 0.0 && sigma < 1e-4, "{spin:?}");
    assert!(stdout(&output).contains("Omega^z") && stderr(&output).contains("chi^2"), "{}", stdout(&output));
    let noisy = fit(&["arrivals:1e-5,widths:1e-5", "--simulate", "3"]);
    assert_ne!(stdout(&noisy), stdout(&output));
    let simulated = || {
        let args = ["fit", "tp-2", "--observe", "arrivals:1e-6,widths:1e-6", "--simulate", "1"];
        stdout(&folder.succeeds(&args))
    };
    assert_eq!(simulated(), simulated());
}

/// One datum of a linear model is late by `d` standard deviations: its residual is `q d`, with the sign of `d`, and `chi^2 = q d^2`.
#[test]
fn a_late_pulse_has_a_positive_residual() {
    let truth = model("tp-2");
    let unknowns = &Parameter::OF_PULSES;
    for late in [3.0, -2.0] {
        let mut data = data(&truth, 100.0, &TIMES_AND_WIDTHS);
        let place = data.iter().position(|datum| datum.observable == Observable::Arrivals).expect("arrivals") + 8;
        assert_eq!(data[place].observable, Observable::Arrivals);
        data[place].value += late * data[place].sigma;
        let found = fit(&truth, &data, unknowns, 100.0).expect("fit");
        let residual = found.residuals[place];
        // Errors of 1e-5 change the unknowns so little that the model is linear to about that precision.
        assert!(residual / late > 0.1, "{residual} of {late}");
        assert!((found.chi_squared / (residual * late) - 1.0).abs() < 1e-2, "{} and {residual}", found.chi_squared);
        // The unbiased estimate of the variance divides by data minus unknowns.
        let sum: f64 = found.residuals.iter().map(|residual| residual * residual).sum();
        let mean = sum / (data.len() - unknowns.len()) as f64;
        assert!((found.root_mean_square().powi(2) / mean - 1.0).abs() < 1e-9, "{}", found.root_mean_square());
    }
}

/// `-n` and `-m` have the `m.n` of `n` and `m`, and half a turn about X, which leaves a diagonal `s^IJ` unchanged, has no visible effect. The data of
/// a star are therefore also those of stars with angles in the lower half.
#[test]
fn angles_beyond_a_right_angle_are_fitted() {
    let truth = model("tp-2");
    let half_turn = std::f64::consts::PI;
    let of_truth = data(&truth, 100.0, &TIMES_AND_WIDTHS);
    let opposite = Parameters {
        chi: half_turn - truth.chi,
        delta: truth.delta + half_turn,
        theta_o: half_turn - truth.theta_o,
        phi_o: truth.phi_o + half_turn,
        ..truth
    };
    let EulerAngles { alpha, beta, gamma } = truth.angles;
    let turned = Parameters {
        angles: EulerAngles { alpha: half_turn - alpha, beta: half_turn - beta, gamma: gamma + half_turn },
        alpha_rate: -truth.alpha_rate,
        beta_rate: -truth.beta_rate,
        theta_o: half_turn - truth.theta_o,
        phi_o: -truth.phi_o,
        ..truth
    };
    for (star, unknown) in [(opposite, Parameter::Chi), (opposite, Parameter::ThetaO), (turned, Parameter::Beta)] {
        let unknowns = [unknown, Parameter::Spin];
        let found = fit(&star.moved(&unknowns, &[1e-4, -1e-4]), &of_truth, &unknowns, 100.0).expect("fit");
        for (value, expected) in found.fisher.values().iter().zip(star.values(&unknowns)) {
            assert!((value - expected).abs() < 1e-8, "{unknown:?}: {value} for {expected}");
        }
        assert!(
            found.fisher.values()[0] > half_turn / 2.0 && found.chi_squared < 1e-6,
            "{unknown:?}: {}",
            found.chi_squared
        );
    }
}
