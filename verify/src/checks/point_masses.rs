//! Two point masses, and the coefficients from the action. Eqs. (1)-(6), (17).

use crate::prelude::*;
use nalgebra::Matrix4;
use twofold::curvature_coupling::{CurvatureTensor, coefficients_from_vacuum_value};
use twofold::dynamics::point_masses::preferred_frame_potential_of_masses;

checks! {
    /// with s^ij = -alpha_2 w^i w^j the potential of two masses is that of the PPN formalism; over three directions at right angles it sums to
    /// tr(s) / 2 of Newton's
    potential_of_masses: Property "potential-of-masses" [2, 4, 5];
    /// the potentials of the pairs of three masses sum to -(1/2) s^ij U^ij with U^ij = (1/2) sum_A sum_B m_A m_B r^i r^j / r^3
    self_energy_of_pairs: Property "self-energy-of-pairs" [2, 6, 17];
    /// k R of the action is s^{ab} R_{ab} for a curvature of Ricci tensor R_{ab} without trace and without Weyl part, for any k with the symmetries
    /// of the Riemann tensor; s is symmetric and has no trace
    coupling_to_curvature: Property "coupling-to-curvature" [1, 3];
}

fn potential_of_masses<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (masses, distance) = ([p.inertia.xx, p.inertia.yy], p.inertia.zz);
    let directions = body_from_inertial(&p.angles).transpose();
    let (alpha_2, w) = (p.numbers[0], &p.gradient);
    let direction = directions.column(2).into_owned();
    let s = coefficients_from_preferred_frame(alpha_2, w);
    let of = |i: usize| {
        let direction = directions.column(i).into_owned();
        anisotropic_potential_of_masses(&p.s_inertial, masses, distance, &direction)
    };
    let newton = -(masses[0] * masses[1] / distance);
    vec![
        anisotropic_potential_of_masses(&s, masses, distance, &direction)
            - preferred_frame_potential_of_masses(alpha_2, w, masses, distance, &direction),
        of(0) + of(1) + of(2) - newton * p.s_inertial.trace() / 2.0,
    ]
}

/// The self-energy of three masses is that of their pairs. The identity holds pair by pair, so that the three separations need not form a triangle.
fn self_energy_of_pairs<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let m = [p.spheroid.inertia_xx, p.spheroid.inertia_zz, p.spheroid.constant_c];
    let [first, second] = [&p.angles, &p.frame].map(|angles| body_from_inertial(angles).row(2).transpose());
    let third: Vector3<F> = body_from_inertial(&p.angles).row(0).transpose();
    let pairs = [
        ([m[0], m[1]], p.inertia.xx, first),
        ([m[1], m[2]], p.inertia.yy, second),
        ([m[2], m[0]], p.inertia.zz, third),
    ];
    let mut of_pairs = F::zero();
    let mut tensor = Matrix3::zeros();
    for (masses, distance, direction) in &pairs {
        of_pairs += anisotropic_potential_of_masses(&p.s_inertial, *masses, *distance, direction);
        // Both orders of the double sum, with the factor 1/2.
        let separation = direction * *distance;
        let weight = masses[0] * masses[1] / (*distance * *distance * *distance);
        tensor += separation * separation.transpose() * weight;
    }
    vec![of_pairs - anisotropic_potential_of_body(&p.s_inertial, &tensor)]
}

/// In the term `k^{abcd} R_{abcd}` of the action, the part with the trace-free Ricci tensor is `s^{ab} R_{ab}`.
fn coupling_to_curvature<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let metric = Matrix4::from_diagonal(&nalgebra::Vector4::new(-F::one(), F::one(), F::one(), F::one()));
    let first = symmetric(&p.s_inertial, &p.gradient, p.numbers[0]);
    let rates = Vector3::new(p.rates.alpha, p.rates.beta, p.rates.gamma);
    let second = symmetric(&p.potential_energy_tensor, &rates, p.numbers[1]);
    // A `k` with all parts: Weyl, Ricci and scalar.
    let k = sum(&product(&first, &second), &product(&first, &first));
    let accelerations = Vector3::new(p.accelerations.alpha, p.accelerations.beta, p.accelerations.gamma);
    let ricci = symmetric(&p.s.tensor(), &accelerations, p.numbers[2]);
    let trace = metric.component_mul(&ricci).sum();
    let ricci = ricci - metric * (trace / 4.0);
    let curvature = product(&ricci, &metric);
    let mut coupling = F::zero();
    for (a, b, c, d) in indices() {
        coupling += k[a][b][c][d] * curvature[a][b][c][d] / 2.0;
    }
    let s = coefficients_from_vacuum_value(&k);
    components![coupling - s.component_mul(&ricci).sum(), s.component_mul(&metric).sum(), s - s.transpose()]
}

/// A symmetric matrix from its spatial part, its time column and the time-time component.
fn symmetric<F: Scalar>(space: &Matrix3<F>, mixed: &Vector3<F>, time: F) -> Matrix4<F> {
    Matrix4::from_fn(|a, b| match (a, b) {
        (0, 0) => time,
        (0, i) | (i, 0) => mixed[i - 1],
        (i, j) => space[(i - 1, j - 1)],
    })
}

fn indices() -> impl Iterator<Item = (usize, usize, usize, usize)> {
    (0..256).map(|i| (i / 64, i / 16 % 4, i / 4 % 4, i % 4))
}

/// The Kulkarni-Nomizu product `h_ac q_bd + h_bd q_ac - h_ad q_bc - h_bc q_ad` has the symmetries of the Riemann tensor. If one factor is the metric,
/// half of the product is a curvature whose Ricci tensor is the other factor, if that is trace-free.
fn product<F: Scalar>(h: &Matrix4<F>, q: &Matrix4<F>) -> CurvatureTensor<F> {
    let mut result = [[[[F::zero(); 4]; 4]; 4]; 4];
    for (a, b, c, d) in indices() {
        result[a][b][c][d] =
            h[(a, c)] * q[(b, d)] + h[(b, d)] * q[(a, c)] - h[(a, d)] * q[(b, c)] - h[(b, c)] * q[(a, d)];
    }
    result
}

fn sum<F: Scalar>(first: &CurvatureTensor<F>, second: &CurvatureTensor<F>) -> CurvatureTensor<F> {
    let mut result = *first;
    for (a, b, c, d) in indices() {
        result[a][b][c][d] += second[a][b][c][d];
    }
    result
}
