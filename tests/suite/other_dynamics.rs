//! Pulses of motions that do not obey the equations of the library: every pulse is found, with exact edges, or the motion is
//! refused.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Vector3};
use twofold::Error;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, PulseTrain, arrivals, pulse_train};
use twofold::propagation::Motion;
use twofold_verify::given_states::{GivenStates, Law};

const SPAN: (f64, f64) = (0.0, 100.0);

/// A motion with these states over the span, without violation.
fn given<F>(state: F, law: Option<Law>) -> GivenStates<F> {
    GivenStates { spheroid: RigidSpheroid::in_units_of_tc(1.1), violation: Matrix3::zeros(), span: SPAN, state, law }
}

/// A star rotating about Z at a rate, with the momentum of one radian per unit of time.
fn turned(rate: f64) -> impl Fn(f64) -> Result<BodyState<f64>, Error> {
    move |t| {
        let (sin, cos) = (rate * t).sin_cos();
        Ok(BodyState { axis: Vector3::z(), momentum: Vector3::z() * 1.1, equatorial_axis: Vector3::new(cos, sin, 0.0) })
    }
}

fn beam_and_sight() -> (Beam<f64>, Vector3<f64>) {
    (Beam::new(0.5, 0.4, 0.3), Observer::at(0.6, 0.3).direction)
}

/// Times at which the margin of a beam changes sign, by a scan in steps of 1e-3 and bisection, and the direction of the change.
fn scanned<M: Motion<f64, State = BodyState<f64>>>(motion: &M, beam: &Beam<f64>, n: &Vector3<f64>) -> Vec<(f64, bool)> {
    let inside = |t: f64| beam.margin(&motion.state(t).expect("a state"), n) > 0.0;
    let changes = (0..100_000).map(|k| f64::from(k) * 1e-3).filter(|&t| inside(t) != inside(t + 1e-3));
    let root = |from: f64| {
        let (mut low, mut high) = (from, from + 1e-3);
        let entering = inside(high);
        for _ in 0..60 {
            let middle = low + (high - low) / 2.0;
            *(if inside(middle) == entering { &mut high } else { &mut low }) = middle;
        }
        (high, entering)
    };
    changes.map(root).collect()
}

/// The edges of a train within its span.
fn edges(train: &PulseTrain) -> Vec<(f64, bool)> {
    let of = |pulse: &twofold::observables::pulsar::Pulse| {
        [(pulse.start, true, !pulse.cut_at_start), (pulse.end, false, !pulse.cut_at_end)]
    };
    train
        .pulses
        .iter()
        .flat_map(of)
        .filter(|(_, _, is_edge)| *is_edge)
        .map(|(time, entering, _)| (time, entering))
        .collect()
}

fn assert_all_found<M: Motion<f64, State = BodyState<f64>>>(motion: &M, least: usize) {
    for (chi, zeta, rho) in [(0.5, 0.6, 0.3), (1.2, 1.1, 0.11), (0.9, 1.5, 1.1), (1.4, 1.4, 2.2)] {
        let (beam, n) = (Beam::new(chi, 0.4, rho), Observer::at(zeta, 0.3).direction);
        let train = pulse_train(motion, &beam, &n, SPAN).expect("pulses");
        let (found, expected) = (edges(&train), scanned(motion, &beam, &n));
        assert!(expected.len() >= least, "{} edges", expected.len());
        assert_eq!(found.len(), expected.len(), "{chi} {zeta} {rho}");
        for ((time, entering), (exact, is_entering)) in found.iter().zip(&expected) {
            assert!(entering == is_entering && (time - exact).abs() < 1e-11, "{chi} {zeta} {rho}: {time} {exact}");
        }
    }
}

/// About Z at four radians per unit of time, with the momentum of one: 63 turns.
#[test]
fn a_star_turned_rigidly_at_another_rate_shows_every_pulse() {
    let law: Law = (|_| [Vector3::z() * 4.0, Vector3::zeros(), Vector3::zeros()], [4.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let motion = given(turned(4.0), Some(law));
    assert_all_found(&motion, 2 * (400.0 / TAU) as usize);
    let (beam, n) = beam_and_sight();
    let train = pulse_train(&motion, &beam, &n, SPAN).expect("pulses");
    let numbers: Vec<_> = arrivals(&motion, &beam, &n, &train).expect("numbers").iter().map(|a| a.number).collect();
    assert_eq!(numbers, (0..numbers.len() as i64).collect::<Vec<_>>());
}

/// A star that claims to obey the equations of motion, which would turn it at 1 radian per unit of time.
#[test]
fn a_motion_that_does_not_turn_as_it_says_is_refused() {
    let (beam, n) = beam_and_sight();
    let pulses = |rate: f64| pulse_train(&given(turned(rate), None), &beam, &n, SPAN);
    for rate in [4.0, 1.03] {
        let error = pulses(rate).unwrap_err().to_string();
        assert!(error.contains("do not turn as the motion's `turning` says"), "{rate}: {error}");
    }
    assert_eq!(pulses(1.0).expect("as it says").pulses.len(), 17, "15 whole ones, and one cut at either end");
}

/// A torque along Z that changes sign, `Omega = (1.3 + 3 cos 2t) Z`: the star turns backwards at times.
#[test]
fn a_star_with_a_torque_of_its_own_shows_every_pulse() {
    let state = |t: f64| {
        let (sin, cos) = (1.3 * t + 1.5 * (2.0 * t).sin()).sin_cos();
        let momentum = Vector3::z() * (1.1 * (1.3 + 3.0 * (2.0 * t).cos()));
        Ok(BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::new(cos, sin, 0.0) })
    };
    let rates = |t: f64| {
        let (sin, cos) = (2.0 * t).sin_cos();
        [1.3 + 3.0 * cos, -6.0 * sin, -12.0 * cos].map(|rate| Vector3::z() * rate)
    };
    let law = Some((rates as fn(f64) -> _, [4.3, 6.0, 12.0, 24.0, 48.0, 96.0]));
    let motion = given(state, law);
    assert_all_found(&motion, 60);
}

/// A torque that moves the axis of a star on a cone about Z, by seventeen radians for two of the rotation about the axis.
#[test]
fn a_star_that_is_made_to_precess_shows_every_pulse() {
    const TILT: f64 = 0.4;
    let axis = |t: f64| {
        let (sin, cos) = (1.7 * t).sin_cos();
        Vector3::new(TILT.sin() * cos, TILT.sin() * sin, TILT.cos())
    };
    let state = move |t: f64| {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 1.7 * t)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), TILT)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), 0.2 * t);
        Ok(BodyState { axis: axis(t), momentum: Vector3::z(), equatorial_axis: turn * Vector3::x() })
    };
    let rates = |t: f64| {
        let (sin, cos) = (1.7 * t).sin_cos();
        let across = 0.2 * TILT.sin();
        [
            Vector3::new(across * cos, across * sin, 1.7 + 0.2 * TILT.cos()),
            Vector3::new(-sin, cos, 0.0) * (1.7 * across),
            Vector3::new(-cos, -sin, 0.0) * (1.7 * 1.7 * across),
        ]
    };
    let law = Some((
        rates as fn(f64) -> _,
        [0, 1, 2, 3, 4, 5].map(|order| 0.2 * 1.7_f64.powi(order) + if order == 0 { 1.7 } else { 0.0 }),
    ));
    let motion = given(state, law);
    assert_all_found(&motion, 10);
}

/// Rates above the bounds stated by their motion, and invalid bounds.
#[test]
fn rates_above_their_bounds_are_refused() {
    let rates = |_| [Vector3::z() * 4.0, Vector3::x() * 0.1, Vector3::zeros()];
    for (bounds, refused) in [
        ([4.0, 0.1, 0.0, 0.0, 0.0, 0.0], None),
        ([3.99, 0.1, 0.0, 0.0, 0.0, 0.0], Some(("size of Omega or a derivative of it", 4.0))),
        ([4.0, 0.09, 0.0, 0.0, 0.0, 0.0], Some(("size of Omega or a derivative of it", 0.1))),
        ([4.0, 0.1, 0.0, -1.0, 0.0, 0.0], Some(("bound on a derivative of Omega", -1.0))),
        ([4.0, 0.1, 0.0, 0.0, 0.0, f64::INFINITY], Some(("bound on a derivative of Omega", f64::INFINITY))),
    ] {
        let law = Some((rates as fn(f64) -> _, bounds));
        let motion = GivenStates { span: (0.0, 0.1), ..given(turned(4.0), law) };
        let found = pulse_train(&motion, &Beam::new(0.5, 0.4, 0.3), &Vector3::x(), (0.0, 0.1));
        match (found, refused) {
            (Ok(_), None) => {}
            (Err(Error::Domain { quantity, value, .. }), Some((expected, size))) => {
                assert_eq!((quantity, value), (expected, size));
            }
            (found, _) => panic!("{bounds:?}: {found:?}"),
        }
    }
}
