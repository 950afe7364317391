//! The equations of motion in Euler angles and in regular form. Eq. (25).

use nalgebra::Vector3;
use twofold::dynamics::BodyState;
use twofold::dynamics::equations_of_motion::{angular_velocity, body_state_rates, reduced_rates, torque_on_axis};
use twofold::dynamics::euler_angle_equations::euler_angle_residuals;
use twofold::dynamics::first_integrals::spin_in_angles;
use twofold::dynamics::wave_source::spheroid_inertia_acceleration;
use twofold::euler_angles::{body_from_inertial, body_rates};

use crate::check::{Check, Kind};
use crate::derivation::euler_lagrange::euler_lagrange;
use crate::derivation::spheroid_motion::{accelerations, axis_angles, fixed_spheroid, gamma_acceleration};
use crate::derivation::{Differentiable, moving_angles, moving_rates};
use crate::identity::{self, Identity};
use crate::random::Point;
use twofold::euler_angles::EulerRates;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identity::checks::<SpinEquation>(),
        identity::checks::<AxisEquations>(),
        identity::checks::<Accelerations>(),
        identity::checks::<RegularEquations>(),
        identity::checks::<InertialFrame>(),
        identity::checks::<SpinAlongPrincipalAxis>(),
    ]
    .concat()
}

struct SpinEquation;

impl Identity for SpinEquation {
    const ID: &'static str = "spin-equation";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "spin-equation-autodiff");
    const EQUATIONS: &'static [u8] = &[21, 23, 24];
    const STATEMENT: &'static str =
        "the Euler-Lagrange equation of gamma is I^zz d(Omega^z)/dt = 0, at any rates and accelerations";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let [_, _, of_gamma] = euler_lagrange(&p.spheroid, &p.s, &p.angles, &p.rates, &p.accelerations);
        let spin = spin_in_angles(&moving_angles(&p.angles, &p.rates), &moving_rates(&p.rates, &p.accelerations));
        vec![of_gamma - p.spheroid.inertia_zz * F::derivative(spin)]
    }
}

struct AxisEquations;

impl Identity for AxisEquations {
    const ID: &'static str = "euler-angle-equations";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "euler-angle-equations-autodiff");
    const EQUATIONS: &'static [u8] = &[21, 23, 24, 25];
    const STATEMENT: &'static str = "the Euler-Lagrange equations of alpha and beta at constant Omega^z are I^xx times those of the paper, at any \
         accelerations";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (q, v) = (&p.angles, &p.rates);
        let (alpha, beta) = (p.accelerations.alpha, p.accelerations.beta);
        let a = EulerRates { alpha, beta, gamma: gamma_acceleration(q, v, alpha) };
        let [of_alpha, of_beta, _] = euler_lagrange(&p.spheroid, &p.s, q, v, &a);
        let spin = spin_in_angles(q, v);
        let (r_alpha, r_beta) = euler_angle_residuals(&p.spheroid, &p.s, spin, &axis_angles(q, v), (alpha, beta));
        vec![of_alpha - p.spheroid.inertia_xx * r_alpha, of_beta - p.spheroid.inertia_xx * r_beta]
    }
}

struct Accelerations;

impl Identity for Accelerations {
    const ID: &'static str = "euler-angle-accelerations";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "euler-angle-accelerations-autodiff");
    const EQUATIONS: &'static [u8] = &[24, 25];
    const STATEMENT: &'static str =
        "the accelerations solve Eq. (25), and with gamma'' of constant Omega^z all three Euler-Lagrange equations";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (q, v) = (&p.angles, &p.rates);
        let a = accelerations(&p.spheroid, &p.s, q, v);
        let spin = spin_in_angles(q, v);
        let (r_alpha, r_beta) = euler_angle_residuals(&p.spheroid, &p.s, spin, &axis_angles(q, v), (a.alpha, a.beta));
        let mut out = vec![r_alpha, r_beta];
        out.extend(euler_lagrange(&p.spheroid, &p.s, q, v, &a));
        out
    }
}

struct RegularEquations;

impl Identity for RegularEquations {
    const ID: &'static str = "regular-equations";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "regular-equations-autodiff");
    const EQUATIONS: &'static [u8] = &[9, 22, 25, 61];
    const STATEMENT: &'static str =
        "n, L and e_x of a motion by Eq. (25) have the rates of the regular equations; Omega is that of Eq. (22)";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (q, v) = (&p.angles, &p.rates);
        let a = accelerations(&p.spheroid, &p.s, q, v);
        let moving = BodyState::from_angles(&fixed_spheroid(&p.spheroid), &moving_angles(q, v), &moving_rates(v, &a));
        let state = BodyState::from_angles(&p.spheroid, q, v);
        let rates = body_state_rates(&p.spheroid, &p.s.tensor(), &state);
        let rotation = body_from_inertial(q);
        let omega = angular_velocity(&p.spheroid, &state.axis, &state.momentum);
        let mut out = Vec::new();
        for (along_motion, by_kernel) in [
            (moving.axis, rates.axis),
            (moving.momentum, rates.momentum),
            (moving.equatorial_axis, rates.equatorial_axis),
        ] {
            out.extend(&(along_motion.map(F::derivative) - by_kernel));
        }
        out.extend(&(omega - rotation.transpose() * body_rates(q, v)));
        out.extend(&(state.body_from_inertial() - rotation));
        out
    }
}

struct InertialFrame;

impl Identity for InertialFrame {
    const ID: &'static str = "inertial-frame";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "inertial-frame-rounding");
    const EQUATIONS: &'static [u8] = &[7, 25, 60];
    const STATEMENT: &'static str = "the rates of the regular state, the torque and the wave's source turn with the inertial frame, for a tensor s^IJ \
         that is not diagonal";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let frame = body_from_inertial(&p.frame);
        let s_turned = frame * p.s_inertial * frame.transpose();
        let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
        let turned = state.rotated(&frame);
        let rates = body_state_rates(&p.spheroid, &p.s_inertial, &state).rotated(&frame);
        let rates_turned = body_state_rates(&p.spheroid, &s_turned, &turned);
        let source =
            |s, state: &BodyState<F>| spheroid_inertia_acceleration(&p.spheroid, s, &state.axis, &state.momentum);
        let torque = |s, axis: &Vector3<F>| torque_on_axis(p.spheroid.constant_c, s, axis);
        let mut out = Vec::new();
        out.extend(&(rates.axis - rates_turned.axis));
        out.extend(&(rates.momentum - rates_turned.momentum));
        out.extend(&(rates.equatorial_axis - rates_turned.equatorial_axis));
        out.extend(&(frame * torque(&p.s_inertial, &state.axis) - torque(&s_turned, &turned.axis)));
        out.extend(&(frame * source(&p.s_inertial, &state) * frame.transpose() - source(&s_turned, &turned)));
        out
    }
}

struct SpinAlongPrincipalAxis;

impl Identity for SpinAlongPrincipalAxis {
    const ID: &'static str = "spin-along-principal-axis";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "spin-along-principal-axis-rounding");
    const EQUATIONS: &'static [u8] = &[25, 27];
    const STATEMENT: &'static str =
        "with any three eigenvalues a spin along X, Y or Z, both ways, is stationary: along X and Y beta stays at pi/2";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let mut out = Vec::new();
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for axis in [axis, -axis] {
                let momentum = axis * (p.spheroid.inertia_zz * p.rates.gamma);
                let (turning, torque) = reduced_rates(&p.spheroid, &p.s.tensor(), &axis, &momentum);
                out.extend(turning.iter().chain(&torque));
            }
        }
        out
    }
}
