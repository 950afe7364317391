//! The rotation matrix, the angular velocity and the permuted axes. Eqs. (7)-(9), (22), (36), (61), (62).

use crate::derivation::body_motion::{composed_rotation, cross_matrix, rotation_derivative};
use crate::prelude::*;

checks! {
    /// R is R_z(gamma) R_x(beta) R_z(alpha), orthogonal, of determinant one, and its last row is the symmetry axis
    rotation_matrix: Property "rotation-matrix" [8, 9];
    /// s^ij = R^iI R^jJ s^IJ is e_i . (s e_j), component by component
    tensor_components: Property "tensor-components" [7];
    /// (dR/dt) R^T is minus the matrix of Omega x with the body rates, all nine components
    angular_velocity: Autodiff "angular-velocity" [9, 22];
    /// the rate of R along the Euler rates is epsilon^IJK Omega^J R^iK
    rate_along_euler_rates: Autodiff "rotation-rate" [61, 62];
    /// the potential in the angles of the frame Y-Z-X with permuted coefficients is that of the same axis; three permutations are the identity
    axis_permutation: Property "axis-permutation" [21, 36];
}

fn rotation_matrix<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let r = body_from_inertial(&p.angles);
    let [x, y, z] = [0, 1, 2].map(|row| r.row(row).transpose());
    components![
        x.cross(&y).dot(&z) - F::one(),
        r - composed_rotation(&p.angles),
        r * r.transpose() - Matrix3::identity(),
        z - symmetry_axis(p.angles.alpha, p.angles.beta),
    ]
}

fn tensor_components<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let r = body_from_inertial(&p.angles);
    let body = tensor_in_body_frame(&r, &p.s_inertial);
    let axis = |i: usize| r.row(i).transpose();
    (0..9).map(|k| (k / 3, k % 3)).map(|(i, j)| body[(i, j)] - axis(i).dot(&(p.s_inertial * axis(j)))).collect()
}

fn angular_velocity<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let turning = rotation_derivative(&p.angles, &p.rates) * body_from_inertial(&p.angles).transpose();
    components![turning + cross_matrix(&body_rates(&p.angles, &p.rates))]
}

fn rate_along_euler_rates<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let r = body_from_inertial(&p.angles);
    let omega = r.transpose() * body_rates(&p.angles, &p.rates);
    components![rotation_derivative(&p.angles, &p.rates) - rotation_rate(&r, &omega)]
}

fn axis_permutation<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let permuted = permuted_from_inertial::<F>();
    let c = p.spheroid.constant_c;
    let axis = permuted.transpose() * symmetry_axis(p.angles.alpha, p.angles.beta);
    let thrice = p.s.permuted().permuted().permuted();
    components![
        anisotropic_potential_in_angles(c, &p.s.permuted(), p.angles.alpha, p.angles.beta)
            - anisotropic_potential_of_axis(c, &p.s.tensor(), &axis),
        [thrice.xx - p.s.xx, thrice.yy - p.s.yy, thrice.zz - p.s.zz],
        permuted * p.s.tensor() * permuted.transpose() - p.s.permuted().tensor(),
        // A vector along X becomes the third axis of the permuted frame, and the frame stays right-handed.
        permuted * Vector3::x() - Vector3::z(),
        permuted * permuted * permuted - Matrix3::identity(),
    ]
}
