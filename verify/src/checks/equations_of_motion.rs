//! The equations of motion in Euler angles and in regular form. Eq. (25).

use crate::derivation::euler_lagrange::euler_lagrange;
use crate::derivation::spheroid_motion::{accelerations, axis_angles, fixed_coefficients, gamma_acceleration};
use crate::prelude::*;

checks! {
    /// the Euler-Lagrange equation of gamma is I^zz d(Omega^z)/dt = 0, at any rates and accelerations
    spin_equation: Autodiff "spin-equation" [21, 23, 24];
    /// the Euler-Lagrange equations of alpha and beta at constant Omega^z are I^xx times those of the paper, at any accelerations
    axis_equations: Autodiff "euler-angle-equations" [21, 23, 24, 25];
    /// the accelerations solve Eq. (25), and with gamma'' of constant Omega^z all three Euler-Lagrange equations
    accelerations_of_angles: Autodiff "euler-angle-accelerations" [24, 25];
    /// n, L and e_x of a motion by Eq. (25) have the rates of the regular equations; Omega is that of Eq. (22)
    regular_equations: Autodiff "regular-equations" [9, 22, 25, 61];
    /// the rates of the regular state, the torque and the source of the wave rotate with the inertial frame, for a tensor s^IJ that is not diagonal
    inertial_frame: Property "inertial-frame" [7, 25, 60];
    /// with any three eigenvalues a spin along X, Y or Z, both ways, is stationary: along X and Y beta stays at pi/2
    spin_along_principal_axis: Property "spin-along-principal-axis" [25, 27];
    /// where beta' = 0, beta'' changes at the rate -(C/I^xx) (s^XX - s^YY) sin(2 alpha) sin(beta) (4 cos(beta) alpha' - I^zz Omega^z/I^xx)
    constant_inclination: Autodiff "constant-inclination" [24, 25, 27];
    /// a star without spin whose axis turns in a principal plane stays in it: in X-Y, beta stays at pi/2
    swing_in_principal_plane: Property "swing-in-principal-plane" [25, 27];
}

fn spin_equation<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let [_, _, of_gamma] = euler_lagrange(&p.spheroid, &p.s, &p.angles, &p.rates, &p.accelerations);
    let spin = spin_in_angles(&moving_angles(&p.angles, &p.rates), &moving_rates(&p.rates, &p.accelerations));
    vec![of_gamma - p.spheroid.inertia_zz * F::derivative(spin)]
}

fn axis_equations<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v) = (&p.angles, &p.rates);
    let (alpha, beta) = (p.accelerations.alpha, p.accelerations.beta);
    let a = EulerRates { alpha, beta, gamma: gamma_acceleration(q, v, alpha) };
    let [of_alpha, of_beta, _] = euler_lagrange(&p.spheroid, &p.s, q, v, &a);
    let spin = spin_in_angles(q, v);
    let (r_alpha, r_beta) = euler_angle_residuals(&p.spheroid, &p.s, spin, &axis_angles(q, v), (alpha, beta));
    vec![of_alpha - p.spheroid.inertia_xx * r_alpha, of_beta - p.spheroid.inertia_xx * r_beta]
}

fn accelerations_of_angles<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v) = (&p.angles, &p.rates);
    let a = accelerations(&p.spheroid, &p.s, q, v);
    let spin = spin_in_angles(q, v);
    let (r_alpha, r_beta) = euler_angle_residuals(&p.spheroid, &p.s, spin, &axis_angles(q, v), (a.alpha, a.beta));
    components![r_alpha, r_beta, euler_lagrange(&p.spheroid, &p.s, q, v, &a)]
}

fn regular_equations<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v) = (&p.angles, &p.rates);
    let a = accelerations(&p.spheroid, &p.s, q, v);
    let moving = BodyState::from_angles(&fixed_spheroid(&p.spheroid), &moving_angles(q, v), &moving_rates(v, &a));
    let state = BodyState::from_angles(&p.spheroid, q, v);
    let rates = body_state_rates(&p.spheroid, &p.s.tensor(), &state).vectors();
    let along_motion = moving.vectors().map(|vector| vector.map(F::derivative));
    let rotation = body_from_inertial(q);
    let omega = angular_velocity(&p.spheroid, &state.axis, &state.momentum);
    components![
        [0, 1, 2].map(|i| along_motion[i] - rates[i]),
        omega - rotation.transpose() * body_rates(q, v),
        state.body_from_inertial() - rotation,
    ]
}

fn inertial_frame<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let frame = body_from_inertial(&p.frame);
    let s_turned = frame * p.s_inertial * frame.transpose();
    let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
    let turned = state.rotated(&frame);
    let rates = body_state_rates(&p.spheroid, &p.s_inertial, &state).rotated(&frame).vectors();
    let rates_turned = body_state_rates(&p.spheroid, &s_turned, &turned).vectors();
    let source = |s, state: &BodyState<F>| spheroid_inertia_acceleration(&p.spheroid, s, &state.axis, &state.momentum);
    let torque = |s, axis: &Vector3<F>| torque_on_axis(p.spheroid.constant_c, s, axis);
    components![
        [0, 1, 2].map(|i| rates[i] - rates_turned[i]),
        frame * torque(&p.s_inertial, &state.axis) - torque(&s_turned, &turned.axis),
        frame * source(&p.s_inertial, &state) * frame.transpose() - source(&s_turned, &turned),
    ]
}

fn spin_along_principal_axis<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let rates = |axis: Vector3<F>| {
        let momentum = axis * (p.spheroid.inertia_zz * p.rates.gamma);
        let (turning, torque) = reduced_rates(&p.spheroid, &p.s.tensor(), &axis, &momentum);
        [turning, torque]
    };
    components![[Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| [rates(axis), rates(-axis)])]
}

fn constant_inclination<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (spheroid, q) = (&p.spheroid, &p.angles);
    let v = EulerRates { beta: F::zero(), ..p.rates };
    let a = accelerations(spheroid, &p.s, q, &v);
    let moving = axis_angles(&moving_angles(q, &v), &moving_rates(&v, &a));
    let spin = F::fixed(spin_in_angles(q, &v));
    let (_, acceleration) =
        euler_angle_accelerations(&fixed_spheroid(spheroid), &fixed_coefficients(&p.s), spin, &moving);
    let ((sa, ca), (sb, cb)) = (q.alpha.sin_cos(), q.beta.sin_cos());
    let pull = spheroid.constant_c * p.s.asymmetry() * sa * ca * 2.0 / spheroid.inertia_xx;
    let omega = spheroid.free_precession_constant(spin_in_angles(q, &v));
    vec![F::derivative(acceleration) + pull * sb * (cb * v.alpha * 4.0 - omega)]
}

fn swing_in_principal_plane<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (sine, cosine) = p.angles.alpha.sin_cos();
    let off = |normal: usize| {
        let [one, other] = [1, 2].map(|step| (normal + step) % 3);
        let (mut axis, mut momentum) = (Vector3::zeros(), Vector3::zeros());
        (axis[one], axis[other], momentum[normal]) = (cosine, sine, p.spheroid.inertia_xx * p.rates.alpha);
        let (turning, torque) = reduced_rates(&p.spheroid, &p.s.tensor(), &axis, &momentum);
        [turning[normal], torque[one], torque[other]]
    };
    components![[0, 1, 2].map(off)]
}
