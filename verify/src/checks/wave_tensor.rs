//! The source of the quadrupole wave: second time derivative of the moment-of-inertia tensor. Eqs. (59)-(65), (67), (68).

use crate::derivation::{accelerated_angles, body_motion};
use crate::prelude::*;

checks! {
    /// with the torque d(R^T I Omega)/dt of any motion, the angular acceleration is the rate of the body rates
    eulers_equations: Autodiff "angular-acceleration" [22, 63, 67];
    /// R^T A R is the second time derivative of I^IJ along any motion with its torque, three moments of inertia; the trace vanishes
    wave_tensor_of_motion: Autodiff "wave-tensor" [60, 62, 63, 64, 65, 67];
    /// without torque, A^ij is the published free result, and the double commutator of the angular velocity with I^ij
    free_wave_tensor: Property "free-wave-tensor" [65, 67];
    /// the second derivative of I^IJ of a spheroid from n and L alone is R^T A R with the spheroid's torque
    spheroid_wave_source: Property "spheroid-wave-source" [64, 65, 66];
    /// Eq. (68) is R^T A R without torque, the short form with s = 0 and two time derivatives, at constant beta and a' = omega / cos b
    free_wave_source: Property "free-wave-source" [28, 65, 68];
    /// the strain from the moment of inertia is (2/r) times the second derivative of the mass quadrupole of turning masses
    quadrupole_formula: Autodiff "quadrupole-formula" [59, 60];
}

fn eulers_equations<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v, a) = (&p.angles, &p.rates, &p.accelerations);
    let torque = body_motion::torque_of_motion(&p.inertia, q, v, a);
    let by_torque = angular_acceleration(&p.inertia, &body_rates(q, v), &torque);
    components![by_torque - body_motion::angular_acceleration(q, v, a)]
}

fn wave_tensor_of_motion<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v, a) = (&p.angles, &p.rates, &p.accelerations);
    let torque = body_motion::torque_of_motion(&p.inertia, q, v, a);
    let tensor = wave_tensor(&p.inertia, &body_rates(q, v), &torque);
    let by_time = body_motion::inertia_tensor_acceleration(&p.inertia, q, v, a);
    let rotation = body_from_inertial(q);
    components![
        tensor.trace(),
        tensor_in_inertial_frame(&rotation, &tensor) - by_time,
        // The same in the body frame compares each component of Eq. (65).
        tensor - rotation * by_time * rotation.transpose(),
    ]
}

fn free_wave_tensor<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let omega = body_rates(&p.angles, &p.rates);
    let tensor = wave_tensor(&p.inertia, &omega, &Vector3::zeros());
    components![
        tensor - free_wave_tensor_of_zimmermann(&p.inertia, &omega),
        tensor - free_wave_tensor_by_commutators(&p.inertia, &omega),
    ]
}

/// The free result of M. Zimmermann, Phys. Rev. D 21, 891 (1980), with indices 1, 2, 3 for the body axes:
/// `A_11 = 2 (D_2 W_2^2 - D_3 W_3^2)`, `A_12 = (D_1 - D_2 + D_3^2 / I_3) W_1 W_2` and cyclic, with
/// `D_1 = I_2 - I_3` and cyclic.
fn free_wave_tensor_of_zimmermann<F: Differentiable>(inertia: &PrincipalInertia<F>, omega: &Vector3<F>) -> Matrix3<F> {
    let moment = [inertia.xx, inertia.yy, inertia.zz];
    let next = |i: usize| (i + 1) % 3;
    let difference = |i: usize| moment[next(i)] - moment[next(next(i))];
    let mut tensor = Matrix3::zeros();
    for i in 0..3 {
        let (j, k) = (next(i), next(next(i)));
        let square = |l: usize| difference(l) * omega[l] * omega[l];
        tensor[(i, i)] = (square(j) - square(k)) * 2.0;
        let mixed = difference(i) - difference(j) + difference(k) * difference(k) / moment[k];
        tensor[(i, j)] = mixed * omega[i] * omega[j];
        tensor[(j, i)] = tensor[(i, j)];
    }
    tensor
}

/// `A = [W', I] + [W, [W, I]]` with `W` the matrix of `Omega x`, and `Omega'` from `I Omega' = (I Omega) x Omega`.
fn free_wave_tensor_by_commutators<F: Differentiable>(inertia: &PrincipalInertia<F>, omega: &Vector3<F>) -> Matrix3<F> {
    let moments = Vector3::new(inertia.xx, inertia.yy, inertia.zz);
    let body = Matrix3::from_diagonal(&moments);
    let acceleration = (body * omega).cross(omega).component_div(&moments);
    let commutator = |a: &Matrix3<F>, b: &Matrix3<F>| a * b - b * a;
    let (w, w_rate) = (body_motion::cross_matrix(omega), body_motion::cross_matrix(&acceleration));
    commutator(&w_rate, &body) + commutator(&w, &commutator(&w, &body))
}

fn spheroid_wave_source<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, s) = (&p.angles, &p.s_inertial);
    let state = BodyState::from_angles(&p.spheroid, q, &p.rates);
    let rotation = body_from_inertial(q);
    let torque = rotation * torque_on_axis(p.spheroid.constant_c, s, &state.axis);
    let tensor = wave_tensor(&p.spheroid.inertia(), &body_rates(q, &p.rates), &torque);
    let short = spheroid_inertia_acceleration(&p.spheroid, s, &state.axis, &state.momentum);
    components![tensor_in_inertial_frame(&rotation, &tensor) - short]
}

fn free_wave_source<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, spheroid) = (&p.angles, &p.spheroid);
    let (_, cos_beta) = q.beta.sin_cos();
    let spin = p.rates.gamma;
    let alpha_rate = spheroid.free_precession_constant(spin) / cos_beta;
    let rates = EulerRates { alpha: alpha_rate, beta: F::zero(), gamma: spin - alpha_rate * cos_beta };
    let none = EulerRates { alpha: F::zero(), beta: F::zero(), gamma: F::zero() };
    let free = free_inertia_acceleration(spheroid, q.alpha, q.beta, alpha_rate);
    let tensor = wave_tensor(&spheroid.inertia(), &body_rates(q, &rates), &Vector3::zeros());
    let state = BodyState::from_angles(spheroid, q, &rates);
    components![
        free - tensor_in_inertial_frame(&body_from_inertial(q), &tensor),
        free - spheroid_inertia_acceleration(spheroid, &Matrix3::zeros(), &state.axis, &state.momentum),
        free - body_motion::inertia_tensor_acceleration(&spheroid.inertia(), q, &rates, &none),
    ]
}

fn quadrupole_formula<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    // Two point masses in general positions.
    let masses = [(p.inertia.xx, p.gradient), (p.inertia.yy, Vector3::from_fn(|i, _| p.numbers[i]))];
    let rotation = body_from_inertial(&accelerated_angles(&p.angles, &p.rates, &p.accelerations)).transpose();
    let turning = masses.map(|(mass, x)| (F::constant(mass), rotation * x.map(F::constant)));
    let zero = Matrix3::zeros();
    let quadrupole = turning.iter().fold(zero, |sum, (mass, x)| sum + x * x.transpose() * *mass);
    let inertia = turning
        .iter()
        .fold(zero, |sum, (mass, x)| sum + (Matrix3::from_diagonal_element(x.dot(x)) - x * x.transpose()) * *mass);
    let distance = p.spheroid.constant_c;
    let strain = metric_perturbation(distance, &inertia.map(F::derivative_12));
    components![strain * distance - quadrupole.map(F::derivative_12) * F::from_f64(2.0)]
}
