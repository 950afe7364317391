//! Torques as generalised forces. Eq. (66).

use crate::derivation::virtual_rotation::{gradient_in_angles, torque_by_virtual_rotation, unit_rates};
use crate::prelude::*;

checks! {
    /// the torque does the work -dU under a change of any one Euler angle, for any potential (U_gamma not zero)
    work_of_torque: Property "torque-from-gradient" [22, 66];
    /// Eq. (66) of the potential in angles, torque_on_body with the tensor U^ij of a spheroid and -2 C n x (s n) agree
    torque_on_spheroid: Property "torque-on-spheroid" [21, 66];
    /// torque_on_body is minus the derivative of -(1/2) s^ij U^ij under a rotation about each body axis, and Eq. (66) of its angle derivatives;
    /// U^ij with six components
    torque_under_rotations: Autodiff "torque-on-body" [6, 17, 66];
}

fn work_of_torque<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let torque = torque_from_gradient(&p.angles, &p.gradient);
    (0..3).map(|i| torque.dot(&body_rates(&p.angles, &unit_rates(i))) + p.gradient[i]).collect()
}

fn torque_on_spheroid<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (xx, zz) = (p.numbers[0], p.numbers[1]);
    let (q, c) = (&p.angles, (xx - zz) / 2.0);
    let (by_alpha, by_beta) = potential_gradient_in_angles(c, &p.s, q.alpha, q.beta);
    let from_gradient = torque_from_gradient(q, &Vector3::new(by_alpha, by_beta, F::zero()));
    let rotation = body_from_inertial(q);
    let s_body = tensor_in_body_frame(&rotation, &p.s.tensor());
    let on_body = torque_on_body(&s_body, &Matrix3::from_diagonal(&Vector3::new(xx, xx, zz)));
    let on_axis = rotation * torque_on_axis(c, &p.s.tensor(), &rotation.row(2).transpose());
    components![from_gradient - on_body, from_gradient - on_axis]
}

fn torque_under_rotations<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, u) = (&p.angles, &p.potential_energy_tensor);
    let rotation = body_from_inertial(q);
    let on_body = torque_on_body(&tensor_in_body_frame(&rotation, &p.s_inertial), u);
    let inertial = torque_on_body(&p.s_inertial, &(rotation.transpose() * u * rotation));
    let gradient = gradient_in_angles(q, &p.s_inertial, u);
    components![
        on_body - torque_by_virtual_rotation(&rotation, &p.s_inertial, u),
        on_body - torque_from_gradient(q, &gradient),
        on_body - rotation * inertial,
    ]
}
