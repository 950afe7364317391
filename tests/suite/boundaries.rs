//! Public functions of the model refuse what is outside their domain, and nothing else.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use twofold::Error;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates, angles_from_rotation, body_from_inertial, euler_rates};
use twofold::inference::{InferenceError, MeasuredArrival, TimingData, fit_timing};
use twofold::lorentz_violation::{PrincipalCoefficients, preferred_frame_parameter, principal_frame};
use twofold::numerics::elliptic::jacobi::{complete_integral, jacobi};
use twofold::observables::Observer;
use twofold::observables::bound::{
    SpinAxisDrift, eta_from_inclination, lambda_change, preferred_frame_bound, zeta_change_terms,
};
use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter};
use twofold::observables::pulsar::{Beam, PulsarClock, arrivals, pulse_train};
use twofold::propagation::{ContinuousAngles, Motion, PhasedMotion, TaylorMotion, UniformMotion};
use twofold::solutions::free::{free_precession_rates, free_rotation};
use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession, shifted_rates};
use twofold::solutions::steady::steady_precession_rate;
use twofold::solutions::symmetric::SymmetricSolution;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold_verify::given_states::GivenStates;

fn star() -> RigidSpheroid<f64> {
    RigidSpheroid::in_units_of_tc(1.1)
}

/// Requires a refusal of the named quantity, or acceptance if empty.
fn judged<T: std::fmt::Debug>(result: Result<T, Error>, quantity: &str) {
    match &result {
        Err(Error::Domain { quantity: found, .. }) if !quantity.is_empty() && found.contains(quantity) => {}
        Ok(_) if quantity.is_empty() => {}
        other => panic!("`{quantity}` was meant: {other:?}"),
    }
}

fn taylor(
    body: RigidSpheroid<f64>,
    s: Matrix3<f64>,
    start: BodyState<f64>,
    span: (f64, f64),
    tolerance: f64,
) -> Result<TaylorMotion<f64>, Error> {
    Problem::new(body, s, start)?.taylor(span, tolerance)
}

const S: PrincipalCoefficients<f64> = PrincipalCoefficients { xx: 0.02, yy: 0.01, zz: -0.04 };

#[test]
fn poles_are_reported() {
    for beta in [0.0, PI] {
        let angles = EulerAngles { alpha: 0.3, beta, gamma: 0.1 };
        judged(euler_rates(&angles, &Vector3::new(0.1, 0.2, 0.3)), "sin beta");
        judged(angles_from_rotation(&body_from_inertial(&angles)), "sin beta");
    }
    for (beta, quantity) in [(f64::EPSILON, "sin beta"), (2.0 * f64::EPSILON, ""), (-2.0 * f64::EPSILON, "")] {
        let angles = EulerAngles { alpha: 0.3, beta, gamma: 0.1 };
        judged(euler_rates(&angles, &Vector3::new(0.1, 0.2, 0.3)), quantity);
    }
}

#[test]
fn perturbation_solutions_know_where_they_hold() {
    // 2 s^ZZ - s^XX - s^YY vanishes up to the rounding of 0.015.
    let balanced = PrincipalCoefficients { xx: 0.02, yy: 0.01, zz: 0.015 };
    let nearly = PrincipalCoefficients { zz: 0.015 + 1e-14, ..balanced };
    let none = PrincipalCoefficients { xx: 0.0, yy: 0.0, zz: 0.0 };
    // Forced and free precession cancel: a^(1) = omega / cos beta_0 up to rounding.
    let zz = 1.21 * 0.01 / (2.0 * 0.7f64.cos().powi(2));
    let cancelling = PrincipalCoefficients { zz, ..none };
    let hardly = PrincipalCoefficients { zz: zz * (1.0 + 1e-14), ..none };
    let tiny = f64::EPSILON;
    for (form, kind, s, spin, beta_0, quantity) in [
        (Form::Printed, Precession::Single, S, 1.0, 0.0, "sin beta_0"),
        (Form::Printed, Precession::Single, S, 1.0, tiny, "sin beta_0"),
        (Form::Printed, Precession::Single, S, 1.0, 2.0 * tiny, ""),
        (Form::Printed, Precession::Single, S, 1.0, 0.7, ""),
        (Form::Printed, Precession::Single, S.scaled(1e-200), 1.0, 0.7, ""),
        (Form::Printed, Precession::Twofold, S, 1.0, FRAC_PI_2, "cos beta_0"),
        (Form::Corrected, Precession::Twofold, S, 1.0, FRAC_PI_2, "cos beta_0"),
        (Form::Printed, Precession::Twofold, S, 0.0, 0.7, "spin"),
        (Form::Printed, Precession::Twofold, S, 1e-310, 0.7, "precession rate"),
        (Form::Printed, Precession::Single, balanced, 1.0, 0.7, "precession rate"),
        (Form::Printed, Precession::Single, balanced, 1e-3, 0.7, "precession rate"),
        (Form::Printed, Precession::Single, none, 1.0, 0.7, "precession rate"),
        (Form::Printed, Precession::Single, nearly, 1.0, 0.7, ""),
        (Form::Printed, Precession::Twofold, balanced, 1.0, 0.7, ""),
        (Form::Printed, Precession::Twofold, cancelling, 0.1, 0.7, "precession rate"),
        (Form::Printed, Precession::Twofold, hardly, 0.1, 0.7, ""),
    ] {
        let constants = Constants { alpha_0: 0.1, beta_0, amplitude: 0.01, phase: 0.2 };
        judged(Perturbation::new(form, kind, &star(), &s, spin, &constants), quantity);
    }
    judged(shifted_rates(&star(), &S, 0.0, 0.7), "spin");
}

#[test]
fn steady_precession_knows_where_it_exists() {
    let symmetric = PrincipalCoefficients { xx: 0.0, yy: 0.0, zz: 0.2 };
    let rate = |s, spin, beta| steady_precession_rate(Precession::Single, &star(), &s, spin, beta);
    judged(rate(S, 1.0, 0.7), "s^XX - s^YY");
    judged(rate(symmetric, 0.5, 0.1), "8 (s^ZZ - s^XX)");
    judged(steady_precession_rate(Precession::Twofold, &star(), &symmetric, 1.0, FRAC_PI_2), "cos beta");
    judged(rate(PrincipalCoefficients { xx: 0.1, yy: 0.1, zz: 0.1 }, 0.0, 0.7), "I^zz Omega^z");
    assert!(rate(symmetric, 3.0, 0.1).is_ok());
    judged(free_precession_rates(&star(), 1.0, FRAC_PI_2), "cos beta");
    // Without spin the two roots differ only in sign, and the twofold one is the upper.
    let pendulum = PrincipalCoefficients { xx: 0.0, yy: 0.0, zz: -0.2 };
    let spinless = |kind| steady_precession_rate(kind, &star(), &pendulum, 0.0, 0.7).expect("real roots");
    assert!(spinless(Precession::Twofold) > 0.0);
    assert_eq!(spinless(Precession::Single), -spinless(Precession::Twofold));
}

#[test]
fn bounds_know_where_they_say_nothing() {
    let drift = SpinAxisDrift { polar_inertia_over_c: 1e-5, spin: 4e3, interval: 5e8, cos_lambda_change: -1e-4 };
    judged(SpinAxisDrift { interval: 0.0, ..drift }.combination_bound(1.0), "interval");
    judged(SpinAxisDrift { interval: f64::NAN, ..drift }.combination_bound(1.0), "interval");
    judged(eta_from_inclination(FRAC_PI_2), "cos beta_0");
    assert!(drift.combination_bound(eta_from_inclination(2.5).unwrap()).is_ok_and(|bound| bound > 0.0));
    assert_eq!(eta_from_inclination(PI), Ok(1.0));
    judged(preferred_frame_bound(1e-14, &Vector3::zeros()), "|w|^2");
    // If the line of sight passes through the axis of the beam, the width is largest and stationary.
    judged(lambda_change(PI - 0.6, 0.6, 0.0, 1e-3), "line of sight");
    judged(lambda_change(FRAC_PI_2, FRAC_PI_2, 0.3, 1e-3), "line of sight");
    let ([sine, turning], lambda) =
        (zeta_change_terms(1.0, 0.8, 0.3), lambda_change(PI - 1.0, 0.8, 0.3, 1e-3).unwrap());
    let zeta: f64 = sine / turning * 1e-3;
    assert!((zeta + lambda).abs() < 1e-17);
}

#[test]
fn tensors_are_refused_with_the_entry_that_is_wrong() {
    judged(principal_frame(&Matrix3::from_diagonal_element(f64::NAN)), "entry of s^IJ");
    judged(principal_frame(&Matrix3::new(0.0, 0.1, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0)), "s^JI");
    let w = Vector3::new(1e-3, 2e-3, 0.0);
    judged(preferred_frame_parameter(&Matrix3::identity(), &w), "alpha_2");
    judged(preferred_frame_parameter::<f64>(&Matrix3::identity(), &Vector3::zeros()), "|w|^2");
}

#[test]
fn tensors_may_be_asymmetric_by_rounding_only() {
    let with_asymmetry = |size: f64| {
        let mut tensor = Matrix3::from_diagonal(&Vector3::new(100.0, 20.0, 3.0));
        tensor[(0, 1)] = size;
        principal_frame(&tensor)
    };
    assert!(with_asymmetry(5e-11).is_ok());
    judged(with_asymmetry(2e-10), "s^JI");
}

/// The convention for what an eigenvalue problem leaves free: descending values, X and Y axes with a positive largest
/// component, Z right-handed.
#[test]
fn principal_axes_have_settled_signs() {
    let frame = principal_frame(&S.tensor()).expect("a diagonal tensor");
    assert_eq!((frame.coefficients, frame.principal_from_given), (S, Matrix3::identity()));
    for (i, angles) in [(0.4, 1.0, 2.0), (-2.0, 2.5, 0.3), (3.0, 0.2, -1.0), (1.0, 1.6, -2.8)].into_iter().enumerate() {
        let (alpha, beta, gamma) = angles;
        let turn = body_from_inertial(&EulerAngles { alpha, beta, gamma });
        let q =
            principal_frame(&(turn.transpose() * S.tensor() * turn)).expect("a symmetric tensor").principal_from_given;
        for row in 0..2 {
            let axis = q.row(row);
            assert!(axis[axis.transpose().iamax()] > 0.0, "case {i}, axis {row}: {axis}");
        }
        assert!((q.determinant() - 1.0).abs() < 1e-14, "case {i}: left-handed");
    }
}

#[test]
fn coefficients_scale_and_combine() {
    let doubled = S.scaled(2.0);
    assert_eq!([doubled.xx, doubled.yy, doubled.zz], [0.04, 0.02, -0.08]);
    assert_eq!((doubled.asymmetry(), doubled.combination()), (0.02, -0.22));
    assert_eq!(doubled.permuted(), PrincipalCoefficients::new([0.02, -0.08, 0.04]));
}

/// In steady precession the derivatives of the rates are the time derivatives of those of the angles.
#[test]
fn steady_rates_carry_the_derivatives_of_the_angles() {
    let lift = |x: f64| Dual64::from_re(x);
    let symmetric = PrincipalCoefficients { xx: 0.01, yy: 0.01, zz: -0.04 };
    let rate = steady_precession_rate(Precession::Twofold, &star(), &symmetric, 1.0, 0.7).expect("a root");
    let spheroid = RigidSpheroid::in_units_of_tc(lift(1.1));
    let s = PrincipalCoefficients { xx: lift(0.01), yy: lift(0.01), zz: lift(-0.04) };
    let angles = EulerAngles { alpha: lift(0.0), beta: lift(0.7), gamma: lift(0.0) };
    let rates = EulerRates { alpha: lift(rate), beta: Dual64::new(0.0, 1.0), gamma: lift(1.0 - rate * 0.7f64.cos()) };
    let motion = SymmetricSolution::new(&spheroid, &s, &angles, &rates).expect("steady precession");
    let (t, h) = (2.3, 1e-4);
    let slope = (motion.angles(lift(t + h)).beta.eps - motion.angles(lift(t - h)).beta.eps) / (2.0 * h);
    let carried = motion.rates(lift(t)).beta.eps;
    assert!((carried - slope).abs() < 1e-7 && slope.abs() > 0.1, "{carried} and {slope}");
}

/// Nearly equal axes keep the digits of their difference, which their ratio has lost.
#[test]
fn eccentricity_comes_from_the_axes_themselves() {
    let (a1, difference) = (3.0, 2f64.powi(-40));
    let shape = SpheroidShape::from_semi_axes(a1, a1 - difference).expect("a spheroid");
    let exact = difference / a1 * ((2.0 * a1 - difference) / a1);
    assert!((shape.eccentricity_squared() / exact - 1.0).abs() < 1e-15);
}

#[test]
fn time_unit_needs_an_oblate_star() {
    judged(RigidSpheroid { inertia_xx: 1.0, inertia_zz: 0.9, constant_c: -0.1 }.time_unit(), "constant C");
    judged(RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.0, constant_c: 0.0 }.time_unit(), "constant C");
    assert_eq!(RigidSpheroid { inertia_xx: 8.0, inertia_zz: 9.0, constant_c: 2.0 }.time_unit(), Ok(2.0));
}

#[test]
fn propagation_refuses_what_it_cannot_follow() {
    let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.0 };
    let start = BodyState::from_angles(&star(), &angles, &EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.0 });
    let (axis, equatorial_axis, momentum) = (start.axis, start.equatorial_axis, start.momentum);
    let (long, near) = ((0.0, 1e9), (0.0, 1.0));
    for (state, span, tolerance, quantity) in [
        (start, near, 1e-17, "tolerance"),
        (start, near, f64::NAN, "tolerance"),
        (start, near, 0.1, "tolerance"),
        (start, (0.0, f64::INFINITY), 1e-10, "time span"),
        (BodyState { axis: axis * 1.1, ..start }, near, 1e-10, "axis n"),
        (BodyState { equatorial_axis: axis, ..start }, near, 1e-10, "n . e_x"),
        (BodyState { equatorial_axis: equatorial_axis * 0.5, ..start }, near, 1e-10, "axis e_x"),
        (BodyState { momentum: momentum * f64::NAN, ..start }, near, 1e-10, "component of L"),
        (start, long, 1e-10, "steps"),
    ] {
        judged(taylor(star(), S.tensor(), state, span, tolerance), quantity);
    }
    for (body, s, quantity) in [
        (RigidSpheroid { inertia_zz: 0.0, ..star() }, S, "moment of inertia"),
        (star(), S.scaled(f64::INFINITY), "entry of s^IJ"),
        (RigidSpheroid { constant_c: f64::NAN, ..star() }, S, "constant C"),
    ] {
        judged(taylor(body, s.tensor(), start, near, 1e-10), quantity);
    }

    let motion = taylor(star(), S.tensor(), start, (1.0, 3.0), 1e-10).expect("a short motion");
    for t in [0.999, 3.001, f64::NAN] {
        judged(motion.state(t), "time t");
        assert!(motion.error_estimate(t).is_nan());
    }
    assert!(motion.state(1.0).is_ok() && motion.state(3.0).is_ok());
}

/// A pulse search over too many turns, or over turns that doubles do not resolve, is refused at once.
#[test]
fn pulses_are_searched_in_turns_that_can_be_counted() {
    // The steps follow the symmetry axis, here a slow one, however many turns the body makes about it.
    let needle = RigidSpheroid { inertia_xx: 1e68, inertia_zz: 1.6, constant_c: 1.0 };
    let spinning = |spin| BodyState {
        axis: Vector3::z(),
        momentum: Vector3::z() * (needle.inertia_zz * spin),
        equatorial_axis: Vector3::x(),
    };
    let (none, beam, n) = (Matrix3::zeros(), Beam::new(0.5, 0.0, 0.3), Vector3::new(0.6, 0.0, 0.8));
    let train = |spin, span: (f64, f64)| {
        let motion = Problem::new(needle, none, spinning(spin))?.taylor(span, 1e-10)?;
        pulse_train(&motion, &beam, &n, span)
    };
    for (spin, span, quantity) in [
        (1e9, (0.0, 2.0), "rotation (rad)"),
        (1e52, (0.0, 10.0), "rotation (rad)"),
        (-1e52, (3.0, 4.0), "rotation (rad)"),
        (1.0, (1e17, 1e17 + 128.0), "time t"),
        (1.0, (-1e17, -1e17 + 128.0), "time t"),
    ] {
        judged(train(spin, span), quantity);
    }
    assert!(train(1.0, (1e15, 1e15 + 128.0)).is_ok_and(|train| train.pulses.len() == 21));
    assert!(train(0.0, (0.0, 1e15)).is_ok_and(|train| train.pulses.len() == 1));

    // The turns of the train of a slower star, counted along a faster one.
    let train = train(1.0, (0.0, 100.0)).expect("a train");
    let faster = taylor(needle, none, spinning(1e52), (0.0, 100.0), 1e-10).expect("a motion");
    judged(arrivals(&faster, &beam, &n, &train), "rotation (rad)");
}

#[test]
fn a_clock_takes_finite_times_of_two_parts() {
    let start = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 2.2, equatorial_axis: Vector3::x() };
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.3), Observer::at(0.6, 0.0));
    let problem = Problem::new(star(), Matrix3::zeros(), start).expect("a problem");
    let motion = PhasedMotion::averaged(&problem).expect("a motion");
    let clock = PulsarClock::new(motion, &beam, &observer).expect("a clock");
    let (endless, huge) = (f64::INFINITY, f64::MAX);
    for t in [[endless, 0.0], [0.0, endless], [huge, huge], [-huge, -huge], [1.0, f64::NAN], [endless, -endless]] {
        judged(clock.pulse_near(t), "time t");
    }
    let whole = clock.pulse_near([1e6 + 0.25, 0.0]).expect("a time").expect("a pulse");
    let parts = clock.pulse_near([1e6, 0.25]).expect("a time").expect("a pulse");
    assert_eq!((whole.number, whole.midpoint[0]), (parts.number, parts.midpoint[0]));
}

/// An axis that stays at a pole, or passes close to it, neither hangs the count nor spoils it.
#[test]
fn turns_are_counted_next_to_the_poles() {
    for beta in [1e-9, 1e-3, PI - 1e-9] {
        let angles = EulerAngles { alpha: 0.3, beta, gamma: 0.1 };
        let start = BodyState::from_angles(&star(), &angles, &EulerRates { alpha: 0.2, beta: 0.0, gamma: 1.0 });
        let symmetric = PrincipalCoefficients { xx: 0.01, yy: 0.01, zz: -0.04 };
        let motion = taylor(star(), symmetric.tensor(), start, (0.0, 100.0), 1e-13).expect("a motion");
        let end = ContinuousAngles::new(&motion, 0.0, &angles).and_then(|mut a| a.at(100.0)).expect("angles");
        // Rotation about Z: alpha + gamma near the upper pole, alpha - gamma near the lower one.
        let (turned, expected) =
            if beta < 1.0 { (end.alpha + end.gamma, 0.4 + 120.0) } else { (end.alpha - end.gamma, 0.2 - 80.0) };
        let lost = (turned - expected).abs();
        assert!(lost < 0.5, "beta = {beta}: {turned} where about {expected} is expected");
    }
}

/// A motion that neglects the torque may stay where the torque could turn the azimuth at any time.
#[test]
fn turns_next_to_a_pole_are_refused_where_they_cannot_be_counted() {
    let s = Matrix3::new(0.2, 0.1, 0.1, 0.1, -0.1, 0.0, 0.1, 0.0, -0.1);
    let count = |off: f64, spin: f64| {
        let angles = EulerAngles { alpha: 0.3, beta: off, gamma: 0.1 };
        let start = BodyState::from_angles(&star(), &angles, &EulerRates { alpha: 0.0, beta: 0.0, gamma: spin });
        let motion = UniformMotion::free(&Problem::new(star(), s, start).expect("a problem"), (0.0, 30.0));
        ContinuousAngles::new(&motion, 0.0, &angles).and_then(|mut turns| turns.at(30.0))
    };
    judged(count(1e-13, 0.0), "pieces");
    assert!(count(1e-3, 0.0).is_ok_and(|end| (end.alpha - 0.3).abs() < 1e-9));
    assert!(count(0.3, 1.5).is_ok());
}

/// Turns that were counted before a refusal are not counted again.
#[test]
fn turns_go_on_after_a_refusal() {
    let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
    let start = BodyState::from_angles(&star(), &angles, &EulerRates { alpha: 2.4, beta: 0.0, gamma: 0.5 });
    let none = Matrix3::zeros();
    let whole = UniformMotion::free(&Problem::new(star(), none, start).expect("a problem"), (0.0, 30.0));
    let exact = ContinuousAngles::new(&whole, 0.0, &angles).and_then(|mut turns| turns.at(15.0)).expect("angles");
    // The state is not finite for a moment.
    let broken = GivenStates::like(&whole, |t| {
        let state = whole.state(t)?;
        let is_gone = (18.7..18.8).contains(&t);
        Ok(if is_gone { BodyState { axis: state.axis * f64::NAN, ..state } } else { state })
    });
    let mut turns = ContinuousAngles::new(&broken, 0.0, &angles).expect("a start");
    judged(turns.at(25.0), "state of the motion");
    let found = turns.at(15.0).expect("angles");
    assert!(
        (found.alpha - exact.alpha).abs() < 1e-9 && (found.gamma - exact.gamma).abs() < 1e-9,
        "{found:?} {exact:?}"
    );
}

/// A motion in units of time from 1e-30 to 1e30: the same motion, or an error, but never a wrong motion.
#[test]
fn the_unit_of_time_does_not_matter() {
    let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
    let rates = EulerRates { alpha: 1.2, beta: 0.3, gamma: -0.2 };
    let start = BodyState::from_angles(&star(), &angles, &rates);
    let expected = taylor(star(), S.tensor(), start, (0.0, 20.0), 1e-14).and_then(|m| m.state(20.0)).expect("a motion");
    for rate in [1e-30, 1e-18, 1e-10, 1e10, 1e18, 1e30] {
        let body = RigidSpheroid { constant_c: rate * rate, ..star() };
        let start = BodyState { momentum: start.momentum * rate, ..start };
        let motion = taylor(body, S.tensor(), start, (0.0, 20.0 / rate), 1e-14).expect("a motion");
        let end = motion.state(20.0 / rate).expect("its end");
        let difference = (end.axis - expected.axis).norm() + (end.equatorial_axis - expected.equatorial_axis).norm();
        assert!(difference < 1e-13, "rate {rate:e}: {difference:e}");
    }
    // Squares of L overflow.
    let heavy = RigidSpheroid { inertia_xx: 1e200, inertia_zz: 1.1e200, constant_c: 1e200 };
    let start = BodyState { momentum: start.momentum * 1e200, ..start };
    judged(taylor(heavy, S.tensor(), start, (0.0, 20.0), 1e-14), "rate at which the body turns");

    let symmetric = PrincipalCoefficients { yy: 0.02, ..S };
    for rate in [1e-160, 1e-100, 1e100, 1e150] {
        let body = RigidSpheroid { constant_c: rate * rate, ..star() };
        let rates = EulerRates { alpha: 1.2 * rate, beta: 0.3 * rate, gamma: -0.2 * rate };
        judged(SymmetricSolution::new(&body, &symmetric, &angles, &rates), "period");
    }
}

/// An isotropic `s^IJ` exerts no torque, and a body at rest without torque stays at rest; the error estimates reflect this.
#[test]
fn what_exerts_no_torque_makes_no_error() {
    let state = BodyState { axis: Vector3::z(), momentum: Vector3::new(0.1, 0.7, 1.3), equatorial_axis: Vector3::x() };
    let free = UniformMotion::free(&Problem::new(star(), Matrix3::zeros(), state).expect("a problem"), (0.0, 1e6));
    assert_eq!(free.state(77_777.7).expect("a state").momentum, state.momentum);
    let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
    let slow = BodyState::from_angles(&star(), &angles, &EulerRates { alpha: 1.2e-6, beta: 3e-7, gamma: -2e-7 });
    for s in [0.3, 1.0 / 3.0, 100.1] {
        let isotropic = Matrix3::from_diagonal_element(s);
        let motion = taylor(star(), isotropic, slow, (0.0, 1e4), 1e-13).expect("a motion");
        let (end, exact) = (motion.state(1e4).expect("its end"), free_rotation(&star(), &slow, 1e4));
        let error = (end.axis - exact.axis).norm().max((end.momentum - exact.momentum).norm() / slow.momentum.norm());
        assert!(error <= motion.error_estimate(1e4), "s = {s}: {error:e}, estimate {:e}", motion.error_estimate(1e4));
    }
    let at_rest = BodyState { momentum: Vector3::zeros(), ..slow };
    let motion = taylor(star(), Matrix3::zeros(), at_rest, (0.0, 1e8), 1e-13).expect("a motion");
    assert!(motion.error_estimate(1e8) < 2e-13, "{:e}", motion.error_estimate(1e8));
}

/// Without spin and `L_Z` the axis swings like a pendulum, through a pole or about the equator.
#[test]
fn a_pendulum_keeps_its_plane() {
    let angles = EulerAngles { alpha: 0.3, beta: 0.5, gamma: 0.1 };
    for (zz, beta, alpha_rate) in
        [(-0.5, 0.5, 0.0), (-0.5, 0.5, 1e-170), (-0.5, 0.5, -1e-20), (0.5, 1.2, 0.0), (-0.5, 2.8, 0.0)]
    {
        let s = PrincipalCoefficients { xx: 0.0, yy: 0.0, zz };
        let angles = EulerAngles { beta, ..angles };
        let rates = EulerRates { alpha: alpha_rate, beta: 0.1, gamma: 0.0 };
        let start = BodyState::from_angles(&star(), &angles, &rates);
        let motion = taylor(star(), s.tensor(), start, (0.0, 50.0), 1e-14).expect("a motion");
        let solution = SymmetricSolution::new(&star(), &s, &angles, &rates).expect("a solution");
        for t in (0..=100).map(|i| 0.5 * f64::from(i)) {
            let (now, exact) = (motion.state(t).expect("in the span"), body_from_inertial(&solution.angles(t)));
            let difference = (exact - now.body_from_inertial()).norm();
            assert!(difference < 1e-12, "s^ZZ = {zz}, beta = {beta}, t = {t}: {difference:e}");
        }
    }
}

#[test]
fn elliptic_functions_are_not_numbers_outside_their_domain() {
    for m1 in [0.0, -0.1, f64::NAN] {
        assert!(complete_integral(m1).is_nan() && jacobi(0.5, m1).sn.is_nan(), "m1 = {m1}");
    }
    assert!((complete_integral(f64::MIN_POSITIVE) / (4.0 / f64::MIN_POSITIVE.sqrt()).ln() - 1.0).abs() < 1e-15);
}

/// A needle that spins fast about its axis and slowly about L is not a clock.
#[test]
fn a_clock_turns_about_its_momentum() {
    let (beam, observer) = (Beam::new(0.2, 0.0, 0.3), Observer::at(0.6, 0.0));
    let clock = |inertia_zz: f64| {
        let needle = RigidSpheroid { inertia_xx: 1.0, inertia_zz, constant_c: 0.0 };
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let start = BodyState { axis, momentum: Vector3::z(), equatorial_axis: Vector3::y() };
        let problem = Problem::new(needle, Matrix3::zeros(), start).expect("a problem");
        PhasedMotion::averaged(&problem).and_then(|motion| PulsarClock::new(motion, &beam, &observer))
    };
    judged(clock(1e-4), "");
    judged(clock(1e-5), "rotation (rad) of the body");
}

#[test]
fn pulses_are_counted_up_to_9e15() {
    let star = TimingModel::new([2.0, 0.0], &[]).expect("a model");
    for (number, quantity) in [(9_000_000_000_000_000, ""), (9_000_000_000_000_100, "phase"), (i64::MIN, "phase")] {
        judged(star.arrival(number), quantity);
        judged(star.phase([number as f64 / 2.0, 0.0]), quantity);
        let arrival = MeasuredArrival { time: [1.0, 0.0], sigma: 1e-6, number: Some(number) };
        judged(TimingData { arrivals: vec![arrival], ..TimingData::default() }.numbered(&star), quantity);
    }
    judged(star.phase([f64::NAN, 0.0]), "phase");
    judged(star.phase([0.0, f64::NAN]), "phase");
}

/// The sum of two doubles in either order, for a star with constant frequency and for one that slows down with its own F2.
#[test]
fn the_greater_part_of_a_time_may_be_the_second() {
    let slowing = [(TimingParameter::F1, -1e-12), (TimingParameter::F2, 1e-20)];
    for parameters in [&[], &slowing[..]] {
        let star = TimingModel::new([2.0, 0.0], parameters).expect("a model");
        let ways = [[1e8, 1e-9], [1e-9, 1e8]];
        let [one, other] = ways.map(|time| star.phase_and_derivatives(time).expect("a phase"));
        assert_eq!(one, other);
        assert_eq!(ways.map(|time| star.phase(time).expect("a phase")), [one.0; 2]);
        let quantity = if parameters.is_empty() { "phase" } else { "F1" };
        judged(star.phase([1e-9, 1e300]), quantity);
        judged(star.phase_and_derivatives([1e-9, 1e300]), quantity);
        let arrival = MeasuredArrival { time: [1e-9, 1e300], sigma: 1e-6, number: Some(2) };
        judged(TimingData { arrivals: vec![arrival], ..TimingData::default() }.numbered(&star), quantity);
    }
}

/// Squares of residuals and of derivatives, in standard deviations, that overflow a double.
#[test]
fn errors_that_are_too_small_are_refused() {
    let star = TimingModel::new([2.0, 0.0], &[]).expect("a model");
    let unknowns = [TimingParameter::Phase, TimingParameter::F0];
    for (sigma, is_refused) in [(1e-140, false), (1e-160, true)] {
        let arrival = |k: i32| MeasuredArrival { time: [f64::from(k * k) / 7.0, 0.0], sigma, number: None };
        let data = TimingData { arrivals: (0..9).map(arrival).collect(), ..TimingData::default() };
        let found = fit_timing(&star, &data, &unknowns);
        let is_of_size = matches!(found, Err(InferenceError::Model(Error::Domain { quantity, .. })) if quantity.contains("standard deviations"));
        assert_eq!(is_of_size, is_refused, "{sigma}: {found:?}");
        let without = fit_timing(&star, &data, &[]);
        assert!(matches!(without, Err(InferenceError::Model(Error::Unsupported { what: "a fit", .. }))), "{without:?}");
    }
}
