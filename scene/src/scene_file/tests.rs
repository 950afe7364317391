//! Numbers in scene files: the ends of their allowed ranges, and the values read.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use approx::assert_relative_eq;
use nalgebra::Vector3;

use super::*;

/// A star in the paper's units.
const PAPER: &str = "star.inertia_ratio = 1.1
    star.spin = 1.0
    lorentz_violation.eigenvalues = [0.02, 0.01, -0.04]
    initial.alpha = 0.0
    initial.beta = 0.7
    initial.alpha_rate = 1.0
    initial.beta_rate = 0.0";

/// A neutron star with a wobble that rotates once per second.
const PHYSICAL: &str = "star.mass = 1.4
    star.radius = 12.0
    star.oblateness = 1e-6
    star.spin_frequency = 1.0
    lorentz_violation.alpha_2 = 1e-9
    lorentz_violation.w = [1e-3, 0.0, 1e-3]
    initial.wobble = 0.1";

/// The times, and the observed quantities.
const SEEN: &str = "time.end = 10.0
    time.samples = 3
    output.columns = ['e_z']
    observer.theta_o = 0.8
    observer.phi_o = 0.5
    pulsar.chi = 0.5
    pulsar.rho = 0.1";

/// Removes the angles, which a start from a wobble or from constants does not have.
const NO_ANGLES: [&str; 4] = ["initial.alpha =", "initial.beta =", "initial.alpha_rate =", "initial.beta_rate ="];

/// The scene with other lines; lines without a value remove a key.
fn with(base: &str, lines: &[impl AsRef<str>]) -> Result<Scene, String> {
    let mut values = BTreeMap::new();
    for line in base.lines().chain(SEEN.lines()).chain(lines.iter().map(AsRef::as_ref)) {
        let (key, value) = line.split_once('=').expect("a line is a key and its value");
        values.insert(key.trim(), value.trim());
    }
    values.retain(|_, value| !value.is_empty());
    let text: String = values.iter().map(|(key, value)| format!("{key} = {value}\n")).collect();
    Scene::from_toml("scene.toml", &text).map_err(String::from)
}

fn assert_taken(base: &str, lines: &[impl AsRef<str> + std::fmt::Debug]) -> Scene {
    with(base, lines).unwrap_or_else(|why| panic!("{lines:?} is refused: {why}"))
}

fn assert_refused(base: &str, lines: &[&str], why: &str) {
    match with(base, lines) {
        Ok(_) => panic!("{lines:?} is taken"),
        Err(message) => assert!(message.contains(why), "{lines:?}: {message}"),
    }
}

/// Both ends of a range are accepted; the next numbers, which are beyond them, are refused.
fn assert_range(base: &str, others: &[&str], key: &str, ends: [&str; 2], beyond: [&str; 2]) {
    let line = |value| format!("{key} = {value}");
    for end in ends.map(line) {
        assert_taken(base, &[others, &[&end]].concat());
    }
    for beyond in beyond.map(line) {
        let name = key.rsplit('.').next().expect("a word");
        assert_refused(base, &[others, &[&beyond]].concat(), &format!("{name}` = "));
    }
}

#[test]
fn numbers_of_a_star_are_taken_up_to_the_ends_of_their_ranges() {
    assert_range(PAPER, &[], "star.inertia_ratio", ["1e-3", "2.0"], ["9.9e-4", "2.001"]);
    let wide = ["star.radius = 1e4", "star.spin_frequency = 1e-9"];
    assert_range(PHYSICAL, &wide, "star.mass", ["1e-3", "1e3"], ["9.9e-4", "1000.9"]);
    assert_range(PHYSICAL, &["star.mass = 1e-3"], "star.radius", ["1.0", "1e7"], ["0.99", "1.01e7"]);
    let dense = ["star.mass = 1e-3", "star.radius ="];
    assert_range(PHYSICAL, &dense, "star.density", ["1e-6", "1e17"], ["9.9e-7", "1.01e17"]);
    assert_range(PHYSICAL, &[], "star.bulge", ["0", "10.0"], ["-0.01", "10.01"]);
    assert_range(PHYSICAL, &[], "star.oblateness", ["1e-15", "0.99"], ["9.9e-16", "0.991"]);
    assert_range(PHYSICAL, &[], "star.spin_frequency", ["-1e5", "1e5"], ["-1.001e5", "1.001e5"]);
    assert_range(PHYSICAL, &["star.spin_frequency ="], "star.frequency", ["-1e5", "1e5"], ["-1.001e5", "1.001e5"]);
    // In days; the oblateness is the ratio of the precession frequency to the spin frequency.
    let by_period = |days: &str, frequency: f64| {
        let lines = [format!("star.precession_period = {days}"), format!("star.spin_frequency = {frequency:e}")];
        with(PHYSICAL, &["star.oblateness =", &lines[0], &lines[1]])
    };
    assert!(by_period("1e-9", 1e5).is_ok() && by_period("1e9", 1e-2).is_ok());
    for (days, frequency) in [("9.9e-10", 1e5), ("1.001e9", 1e-2)] {
        assert!(by_period(days, frequency).is_err_and(|why| why.contains("from 1e-9 to 1e9 [d]")), "{days}");
    }
    for (oblateness, taken) in [(1.01e-12, true), (0.99e-12, false), (0.989, true), (0.991, false)] {
        let read = by_period("2e3", -1.0 / (2e3 * 86_400.0 * oblateness));
        assert_eq!(read.is_ok(), taken, "{oblateness} {:?}", read.err());
    }
}

/// A free body circles `L` at `|L| / I^xx` and rotates backwards relative to it at `epsilon Omega^z`. The magnetic axis takes part in both if it
/// is farther from the symmetry axis than the symmetry axis is from `L`, and stays with the symmetry axis if it is nearer.
#[test]
fn pulses_come_as_the_magnetic_axis_goes_round() {
    for (oblateness, frequency) in [(0.3, 2.0), (0.3, -2.0), (1e-3, 0.1)] {
        for (wobble, chi, turns_back) in [(0.4, 0.5, 1.0), (0.4, 0.3, 0.0), (0.4, PI - 0.5, 1.0), (0.4, PI - 0.3, 0.0)]
        {
            let given = [
                "star.spin_frequency =".to_owned(),
                format!("star.oblateness = {oblateness}"),
                format!("star.frequency = {frequency:?}"),
                format!("initial.wobble = {wobble}"),
                format!("pulsar.chi = {chi:?}"),
            ];
            let scene = assert_taken(PHYSICAL, &given);
            let (state, body) = (scene.problem.initial(), scene.problem.spheroid());
            assert_relative_eq!(body.oblateness(), oblateness, max_relative = 1e-15);
            let spin = state.axis.dot(&state.momentum) / body.inertia_zz;
            let per_second = (state.momentum.norm() / body.inertia_xx).copysign(spin) - turns_back * oblateness * spin;
            assert_relative_eq!(per_second / scene.units.time / TAU, frequency, max_relative = 1e-13);
        }
    }
}

/// 2 G M / c^2 is 2.953 km for each solar mass.
#[test]
fn a_star_is_larger_than_its_horizon() {
    assert_taken(PHYSICAL, &["star.radius = 4.136"]);
    assert_refused(PHYSICAL, &["star.radius = 4.134"], "mean radius of 4.134 km: must be above 2 G M / c^2 = 4.135 km");
}

#[test]
fn a_spin_beyond_break_up_is_told_in_either_sense() {
    let cautions =
        |frequency: &str| assert_taken(PHYSICAL, &[&format!("star.spin_frequency = {frequency}")]).cautions.len();
    assert_eq!(["1000.0", "-1000.0", "2000.0", "-2000.0"].map(cautions), [0, 0, 1, 1]);
    // Of a star of 1e7 km it is (G M / R^3)^(1/2) / 2 pi = 2.17e-6 Hz, to the oblateness.
    let slow = assert_taken(PHYSICAL, &["star.radius = 1e7"]).cautions;
    assert!(slow[0].contains("above 2.16") && slow[0].contains("e-6 Hz (break-up)"), "{slow:?}");
}

#[test]
fn coefficients_are_at_most_one() {
    for (lines, taken) in [
        (["[1.0, -1.0, 0]", ""], true),
        (["[1.01, 0, 0]", ""], false),
        (["[0, 0, -1.01]", ""], false),
        (["", "[[1.0, 0, 0], [0, -1.0, 0], [0, 0, 0]]"], true),
        (["", "[[0, 1.01, 0], [1.01, 0, 0], [0, 0, 0]]"], false),
    ] {
        let [eigenvalues, tensor] = lines;
        let lines =
            [format!("lorentz_violation.eigenvalues = {eigenvalues}"), format!("lorentz_violation.tensor = {tensor}")];
        let read = with(PAPER, &lines);
        assert_eq!(read.is_ok(), taken, "{lines:?}: {:?}", read.err());
    }
    assert_refused(PHYSICAL, &["lorentz_violation.w ="], "missing `lorentz_violation.w`");
    assert_refused(PHYSICAL, &["lorentz_violation.alpha_2 ="], "missing `lorentz_violation.alpha_2`");
    let half = "lorentz_violation.w = [0.3, 0.4, 0.5]"; // |w|^2 = 1/2
    for (alpha_2, taken) in [("1.999", true), ("-1.999", true), ("2.001", false), ("-2.001", false)] {
        let read = with(PHYSICAL, &[half, &format!("lorentz_violation.alpha_2 = {alpha_2}")]);
        assert_eq!(read.is_ok(), taken, "{alpha_2}: {:?}", read.err());
    }
    for (w, taken) in [("[0, 0, 0]", false), ("[0, 0.999, 0]", true), ("[0, 1.0, 0]", false)] {
        let read = with(PHYSICAL, &[&format!("lorentz_violation.w = {w}")]);
        assert_eq!(read.is_ok(), taken, "{w}: {:?}", read.err());
    }
}

/// `L` is along the given direction, whatever its length, and the axis is on the other side if the spin is negative.
#[test]
fn a_wobble_is_about_the_given_direction() {
    let started = |lines: &[&str]| {
        assert_taken(PAPER, &[&NO_ANGLES, ["initial.wobble = 0.2"].as_slice(), lines].concat())
            .problem
            .initial()
            .to_owned()
    };
    for spin in [0.5, -0.5, 2.0_f64] {
        let state = started(&[&format!("star.spin = {spin}"), "initial.momentum = [3e200, 0, 4e200]"]);
        let momentum = Vector3::new(0.6, 0.0, 0.8) * (1.1 * spin.abs() / 0.2_f64.cos());
        assert_relative_eq!(state.momentum, momentum, max_relative = 1e-15);
        assert_relative_eq!(state.axis.dot(&state.momentum), 1.1 * spin, max_relative = 1e-15);
    }
    // The projections of e_x and of L onto the plane normal to n are parallel at phase zero; at a quarter of a turn e_x is a
    // right angle before L.
    let state = started(&[]);
    let of_momentum = (Vector3::z() - state.axis * state.axis.z).normalize();
    assert_relative_eq!(state.equatorial_axis, of_momentum, max_relative = 1e-15);
    let state = started(&["initial.precession_phase = '90 deg'"]);
    assert_relative_eq!(state.equatorial_axis, of_momentum.cross(&state.axis), epsilon = 1e-15);
    // With a pulsar this holds for the magnetic axis.
    let state = started(&["pulsar.delta = 0.3"]);
    let magnetic = state.equatorial_axis * 0.3_f64.cos() + state.axis.cross(&state.equatorial_axis) * 0.3_f64.sin();
    assert_relative_eq!(magnetic, of_momentum, epsilon = 1e-15);
    // Without one it holds for e_x.
    let state = started(&["pulsar.chi =", "pulsar.rho ="]);
    assert_relative_eq!(state.equatorial_axis, of_momentum, max_relative = 1e-15);
}

/// The axis starts at a pole: the angles are zero, except for the inclination, which alone is defined.
#[test]
fn a_start_on_a_pole_has_an_inclination() {
    for (momentum, beta) in [("[0, 0, 1]", 0.0), ("[0, 0, -1]", PI)] {
        let momentum = format!("initial.momentum = {momentum}");
        let scene = assert_taken(PHYSICAL, &["initial.wobble = 0.0", &momentum]);
        let EulerAngles { alpha, beta: found, gamma } = scene.initial_angles;
        assert_eq!([alpha, found, gamma], [0.0, beta, 0.0]);
    }
}

#[test]
fn constants_are_those_of_a_solution() {
    let of = |kind: &str, beta_0: f64| {
        let (kind, beta_0) = (format!("initial.kind = '{kind}'"), format!("initial.beta_0 = {beta_0:?}"));
        let constants = ["initial.alpha_0 = 0.3", "initial.amplitude = 0.0", "initial.phase = 0.0", &kind, &beta_0];
        with(PAPER, &[NO_ANGLES.as_slice(), &constants].concat())
    };
    // The rate of twofold precession is omega / cos beta_0.
    assert!(of("twofold", FRAC_PI_2 - 2e-12).is_ok_and(|scene| scene.perturbation.is_ok()));
    for off in [5e-13, -5e-13] {
        assert!(of("twofold", FRAC_PI_2 + off).is_err_and(|why| why.contains("other than pi/2")), "{off}");
    }
    assert!(of("single", 1.4).is_ok_and(|scene| scene.perturbation.is_ok()));
    for beta_0 in [0.0, PI, -0.7, 4.0] {
        assert!(of("single", beta_0).is_err_and(|why| why.contains("above 0 and below pi")), "{beta_0}");
    }
}

#[test]
fn what_is_observed_is_taken_up_to_the_ends_of_its_ranges() {
    let pi = "3.141592653589793";
    assert_range(PAPER, &[], "observer.theta_o", ["0.0", pi], ["-0.001", "3.1416"]);
    assert_range(
        PAPER,
        &["observer.theta_o =", "observer.phi_o ="],
        "observer.inclination",
        ["0.0", pi],
        ["-0.001", "3.1416"],
    );
    assert_range(PHYSICAL, &[], "observer.distance", ["1e-6", "1e8"], ["9.9e-7", "1.01e8"]);
    assert_range(PAPER, &[], "pulsar.chi", ["0.0", pi], ["-0.001", "3.1416"]);
    assert_range(PAPER, &[], "pulsar.rho", ["1e-9", "3.1415"], ["0.0", pi]);
    assert_range(PAPER, &[], "output.tolerance", ["1e-14", "1e-2"], ["9.9e-15", "1.01e-2"]);
    assert_range(PAPER, &[], "time.samples", ["2", "10000000"], ["1", "10000001"]);
    let years = ["time.end ="];
    assert_range(PHYSICAL, &years, "time.years", ["-1e6", "1e6"], ["-1.001e6", "1.001e6"]);
    assert_refused(PHYSICAL, &["time.end =", "time.years = 0.0"], "nonzero");
}

/// Samples are more than four roundings of their times apart: of 2^-52 for times from one on.
#[test]
fn samples_differ_in_double_precision() {
    for (start, roundings, taken) in [
        (1.0, 10.0, true),
        (1.0, 8.0, false),
        (-1.0, -10.0, true),
        (-1.0, -8.0, false),
        (1024.0, 10240.0, true),
        (1024.0, 8192.0, false),
    ] {
        let lines = [format!("time.start = {start:?}"), format!("time.end = {:?}", start + roundings * f64::EPSILON)];
        let read = with(PAPER, &lines);
        assert_eq!(read.is_ok(), taken, "{lines:?} {:?}", read.err());
    }
    assert_refused(PAPER, &["time.start = -1e308", "time.end = 1.7e308"], "differ from one another");
}

#[test]
fn dates_of_our_time_are_told_from_modified_ones() {
    let told = |day| like_julian_date(&Epoch::new(day, 0.75).unwrap());
    let [before, first, last, after] = [2_399_999, 2_400_000, 2_499_999, 2_500_000].map(told);
    assert!(before.is_none() && after.is_none());
    assert!(first.is_some_and(|why| why.contains("in the year 8430. If 0.25 is meant")), "{:?}", told(2_400_000));
    assert!(last.is_some_and(|why| why.contains("If 99999.25 is meant")), "{:?}", told(2_499_999));
}

#[test]
fn years_are_counted_from_the_start() {
    let year = 365.25 * 86_400.0;
    for (lines, start) in [(["time.end =", "time.start ="], 0.0), (["time.end =", "time.start = 100.0"], 100.0)] {
        let times = assert_taken(PHYSICAL, &[&lines, ["time.years = 2.0"].as_slice()].concat()).times;
        assert_eq!([times.start(), times.last()], [start, start + 2.0 * year]);
    }
}

/// A billion days before and after the epoch, counted from the start.
#[test]
fn an_epoch_is_within_a_billion_days_of_the_end() {
    for (span, taken) in [(8.64e13, true), (-8.64e13, true), (8.640001e13, false), (-8.640001e13, false)] {
        for start in [0.0, 8e12, -8e12] {
            let lines = [
                format!("time.start = {start:e}"),
                "time.end =".into(),
                format!("time.span = {span:e}"),
                "time.epoch = 5e4".into(),
            ];
            let read = with(PHYSICAL, &lines);
            assert_eq!(read.is_ok(), taken, "{lines:?} {:?}", read.err());
        }
    }
    assert_refused(PHYSICAL, &["time.epoch = 5e4", "time.end = 8.64e14"], "ends 1.000e10 days from its epoch");
}

/// The observer is in the opposite direction: at the longitude of 19 h 39 m minus 12 h and the colatitude of 90 deg plus the
/// declination.
#[test]
fn positions_are_those_of_the_sky() {
    let at = |ascension: &str, declination: &str| {
        let lines = ["observer.theta_o =", "observer.phi_o =", "observer.frame = 'equatorial'"].map(String::from);
        let position =
            [format!("pulsar.right_ascension = '{ascension}'"), format!("pulsar.declination = '{declination}'")];
        with(PHYSICAL, &[lines.as_slice(), &position].concat())
    };
    let seen = at("19:39:36", "+21:34:30").unwrap().observer.expect("an observer");
    assert_relative_eq!(seen.phi_o, (294.9_f64 - 180.0).to_radians(), max_relative = 1e-14);
    assert_relative_eq!(seen.theta_o, (90.0 + 21.575_f64).to_radians(), max_relative = 1e-14);
    let seen = at("01:30:00", "-00:30:00").unwrap().observer.expect("an observer");
    assert_relative_eq!(seen.phi_o, 202.5_f64.to_radians(), max_relative = 1e-14);
    assert_relative_eq!(seen.theta_o, 89.5_f64.to_radians(), max_relative = 1e-14);
    for (ascension, declination, taken) in [
        ("24:00:00", "+90:00:00", true),
        ("24:00:01", "0:00:00", false),
        ("25:00:00", "0:00:00", false),
        ("0:00:00", "-90:00:01", false),
        ("0:59:59.99", "0:00:00", true),
        ("0:60:00", "0:00:00", false),
        ("0:00:60.5", "0:00:00", false),
        ("0:00:1e1", "0:00:00", false),
        ("0:+5:00", "0:00:00", false),
        ("0:5:00", "0:00:00", false),
        ("0:00:inf", "0:00:00", false),
        ("-1:00:00", "0:00:00", false),
        ("+1:00:00", "0:00:00", false),
        ("1:00", "0:00:00", false),
        ("0:00:00", "-+1:00:00", false),
    ] {
        let read = at(ascension, declination);
        assert_eq!(read.is_ok(), taken, "{ascension} {declination} {:?}", read.err());
    }
}

#[test]
fn a_pulsar_with_a_name_or_a_position_is_in_the_catalogues() {
    let catalogued =
        |lines: &[&str]| assert_taken(PHYSICAL, lines).catalogued.map(|found| (found.name, found.position.is_some()));
    let position = ["pulsar.right_ascension = '1:00:00'", "pulsar.declination = '1:00:00'"];
    assert_eq!(catalogued(&[]), None);
    assert_eq!(catalogued(&["pulsar.name = 'B1937+21'"]), Some(("B1937+21".into(), false)));
    assert_eq!(catalogued(&position), Some((NAMELESS.into(), true)));
    for name in ["", "B1937 21", "B1937\u{2212}21"] {
        assert_refused(PHYSICAL, &[&format!("pulsar.name = '{name}'")], "a name without spaces");
    }
}

#[test]
fn a_braking_law_is_taken_up_to_the_ends_of_its_ranges() {
    let f1 = ["spin_down.f1 = -1e-12"];
    assert_range(PHYSICAL, &[], "spin_down.f1", ["-1e-3", "1e-3"], ["-1.001e-3", "1.001e-3"]);
    assert_refused(PHYSICAL, &["spin_down.f1 = 0.0"], "nonzero");
    assert_range(PHYSICAL, &f1, "spin_down.f2", ["-1e-9", "1e-9"], ["-1.001e-9", "1.001e-9"]);
    assert_range(PHYSICAL, &f1, "spin_down.index", ["-30.0", "30.0"], ["-30.01", "30.01"]);
    assert_range(PHYSICAL, &f1, "spin_down.torque", ["0.0", "1.0"], ["-0.001", "1.001"]);
    assert_range(PHYSICAL, &f1, "spin_down.damping_time", ["1e-3", "1e12"], ["9.9e-4", "1.01e12"]);
    let read = |lines: &[&str]| assert_taken(PHYSICAL, &[&f1, lines].concat()).spin_down.expect("a law");
    assert_eq!(
        read(&[]),
        SpinDown { f1: -1e-12, index: IndexOrSecond::Index(3.0), torque_share: 0.0, damping_time: None }
    );
    let shares =
        ["constant", "plasma", "vacuum"].map(|name| read(&[&format!("spin_down.torque = '{name}'")]).torque_share);
    assert_eq!(shares, [0.0, 0.5, 1.0]);
    assert_eq!(read(&["spin_down.damping_time = 2.0"]).damping_time, Some(2.0 * 86_400.0));
    assert_refused(PHYSICAL, &[f1[0], "spin_down.index = 2.0", "spin_down.damping_time = 2.0"], "braking index of 3");
    // n = F0 F2 / F1^2, at most 30 in size.
    let law = |second: f64| SpinDown { index: IndexOrSecond::Second(second), ..read(&[]) }.braking(2.0);
    assert_eq!(law(1.5e-24).map(|law| (law.index, law.rate)), Ok((3.0, 5e-13)));
    assert!(law(1.49e-23).is_ok() && law(-1.49e-23).is_ok() && law(1.51e-23).is_err() && law(-1.51e-23).is_err());
}

/// The oblateness keeps its digits however small it is; of 1.5e-15 a rounded `I^zz / I^xx` would leave one digit. `C t_c^2 = I^xx` in the units of the output
/// as well.
#[test]
fn the_oblateness_has_all_its_digits() {
    for oblateness in [0.7, 0.1, 3.1e-5, 1.234_567_8e-9, 7e-13, 1.5e-15] {
        let scene =
            assert_taken(PHYSICAL, &[format!("star.oblateness = {oblateness:?}"), "star.bulge = 1.0".to_owned()]);
        let (body, units) = (scene.problem.spheroid(), &scene.units);
        assert_relative_eq!(body.oblateness(), oblateness, max_relative = 3e-16);
        let ratio = |of: f64| of / body.inertia_xx;
        assert_relative_eq!(ratio(body.constant_c), 1.0, max_relative = 1e-15);
        assert_relative_eq!(ratio(0.25) / scene.problem.bulge(), 1.0, max_relative = 1e-15);
        assert_relative_eq!(units.momentum / units.time / units.energy, 1.0, max_relative = 1e-14);
        // Eqs. (77), (78) of a nearly spherical star: I^xx = 2 M R^2 / 5.
        let inertia = units.inertia_in_si() * body.inertia_xx;
        assert!(oblateness > 1e-3 || (inertia / (0.4 * 1.4 * 1.988_4e30 * 1.44e8) - 1.0).abs() < 1e-3, "{inertia:e}");
    }
}
