//! The torus of a motion: a frame in which it has its symmetries, and its closed orbits.

use nalgebra::{Matrix3, Vector3};

use super::closed_orbits::ClosedOrbits;
use super::flow::{Axes, Integrals, tangents};
use super::flow_series::DOUBLE;
use super::lattice::lattice;
use crate::dynamics::{Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::principal_frame;

/// Allowed rounding error after a quarter of a turn.
const EXACT: f64 = 2e-15;

/// A torus narrower than this is treated as a circle or a point.
pub(super) const THINNEST: f64 = 1e-8;

/// A motion within this distance (in `n` and `L / unit`) of an unstable state of rest is refused. `K` and `E` differ from their values at rest by the
/// square of the distance, which for other motions is above 1e-12.
const AT_REST: f64 = 1e-6;

/// Eigenvalues that differ by less than this fraction of the largest difference count as equal near a state of rest.
const EQUAL: f64 = 1e-8;

/// Whether `n` and `L` are nearly at rest in the plane of two equal eigenvalues of `s`. There a deviation grows in proportion to time: both periods of
/// the torus are those of the fast rotation.
fn near_neutral_rest(values: &Vector3<f64>, axis: &Vector3<f64>, momentum: &Vector3<f64>, unit: f64) -> bool {
    let spread = values.max() - values.min();
    let aside = axis.cross(momentum).norm() / unit;
    (0..3).any(|i| {
        let apart = (values[(i + 1) % 3] - values[(i + 2) % 3]).abs();
        apart <= EQUAL * spread && aside.max(axis[i].abs()).max(momentum[i].abs() / unit) <= AT_REST
    })
}

/// Whether `n` and `L` are nearly at rest, both along a principal axis `i` of `s`, in an unstable way. The torque is that of the energy
/// `C n.s n`, `C (s_i + sum of (s_j - s_i) u_j^2)` for small components `u_j` of `n`, so that with `k_j = 2 C (s_j - s_i)` and the spin momentum `G`
///
/// ```text
/// I^xx u_1'' + G u_2' + k_1 u_1 = 0,    I^xx u_2'' - G u_1' + k_2 u_2 = 0.
/// ```
///
/// Their solutions `exp(lambda t)` have `I^2 lambda^4 + (I (k_1 + k_2) + G^2) lambda^2 + k_1 k_2 = 0`, which is stable if both roots `lambda^2` are
/// real and below zero. At the axis of the middle eigenvalue it never is, `k_1 k_2 < 0`; at the axis of the highest energy only for large `G`.
fn near_unstable_rest(
    spheroid: &RigidSpheroid<f64>,
    values: &Vector3<f64>,
    axis: Vector3<f64>,
    momentum: Vector3<f64>,
    unit: f64,
) -> bool {
    let i = axis.iamax();
    let beside = |v: Vector3<f64>| [(i + 1) % 3, (i + 2) % 3].map(|j| v[j]);
    if beside(axis).into_iter().chain(beside(momentum / unit)).any(|part| part.abs() > AT_REST) {
        return false;
    }
    let inertia = spheroid.inertia_xx;
    let [first, second] = beside(*values).map(|value| 2.0 * spheroid.constant_c * (value - values[i]) * inertia);
    let half = (first + second + momentum[i] * momentum[i]) / 2.0;
    first * second < 0.0 || (first < 0.0 && half < (first * second).sqrt())
}

/// A torus with the data from which it was found, in a frame in which half a turn about Z maps it to itself.
#[derive(Debug, Clone)]
pub(super) struct Torus {
    pub(super) spheroid: RigidSpheroid<f64>,
    /// Spread of the eigenvalues of `s`.
    pub(super) spread: f64,
    /// Unit of `L`: its size at the start, or `(2 I^xx |C| (s_max - s_min))^(1/2)`, which the torque can produce, if that is larger.
    pub(super) unit: f64,
    pub(super) initial: Axes<f64>,
    pub(super) orbits: ClosedOrbits<f64>,
    pub(super) integrals: Integrals<f64>,
    pub(super) from_given: Matrix3<f64>,
}

impl Torus {
    /// The torus of a motion, in a frame with Y along the axis of the middle eigenvalue and Z along one of the other two, about which half a turn
    /// maps the torus to itself.
    ///
    /// # Errors
    /// [`Error::Domain`] for isotropic `s`; [`Error::Unsupported`] if the search over the torus does not find its symmetric states.
    pub(super) fn of(problem: &Problem<f64>) -> Result<Self, Error> {
        let frame = principal_frame(problem.coefficients())?.principal_from_given;
        let principal = problem.rotated(&frame);
        let mut values = principal.coefficients().diagonal();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
        let [high, middle, low] = order;
        values.add_scalar_mut(-values[middle]);
        let spread = values[high] - values[low];
        Error::ensure(spread > 0.0, "s_max - s_min", spread, "above zero; otherwise there is no torus")?;
        let (spheroid, initial) = (*problem.spheroid(), principal.initial());
        let pull = (2.0 * spheroid.inertia_xx * spheroid.constant_c.abs() * spread).sqrt();
        let unit = initial.momentum.norm().max(pull);
        // A large `L` circles the axis on whose side of the separatrix it is.
        let level = values.dot(&initial.momentum.component_mul(&initial.momentum));
        let [x, z] = if level > 0.0 { [low, high] } else { [high, low] };
        let in_frame = |x: usize| {
            let [x, y] = [x, middle].map(|i| Vector3::ith(i, 1.0));
            let turn = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
            let values = turn.map(f64::abs) * values;
            let integrals = Integrals::new(&spheroid, &Matrix3::from_diagonal(&values), spread, DOUBLE);
            let initial = initial.rotated(&turn);
            let start = [initial.axis, initial.momentum, initial.equatorial_axis];
            (turn, integrals, start)
        };
        let given = principal.coefficients().diagonal();
        if near_unstable_rest(&spheroid, &given, initial.axis, initial.momentum, unit)
            || near_neutral_rest(&given, &initial.axis, &initial.momentum, unit)
        {
            let what = "a series on the torus";
            return Err(Error::Unsupported { what, why: "n and L are nearly at rest, where deviations grow" });
        }
        let (turn, integrals, start) = in_frame(x);
        let found = lattice(&integrals, unit, &start)
            .ok_or(Error::not_found("symmetric states of the torus, as near the separatrix"))?;
        let (turn, integrals, initial) = if found.about_x { in_frame(z) } else { (turn, integrals, start) };
        let orbits = ClosedOrbits::near(&integrals, unit, &initial, [found.to_plane, found.fast, found.slow]);
        let orbits = orbits.ok_or(Error::not_found("periods of the torus, as near the separatrix"))?;
        Ok(Self { spheroid, spread, unit, initial, orbits, integrals, from_given: turn * frame })
    }

    /// Width of the torus at the state in the plane: the smallest singular value of the rates of both flows, divided by the rotation rate of the
    /// body. It is zero on a circle, and near a stationary state it is as small as the distance of `n` and `L` from that state.
    pub(super) fn width(&self) -> f64 {
        let rates = tangents(&self.integrals.both_rates(&self.orbits.plane), self.unit);
        rates.singular_values().min() / (self.unit * self.integrals.inverse_inertia())
    }

    /// States along a quarter of a turn of the second angle, if they are as accurate as the flow: the last one must be in the plane `X = 0`. Rounding
    /// grows near the separatrix.
    pub(super) fn starts(&self, quarter: usize) -> Option<Vec<Axes<f64>>> {
        let starts = self.orbits.starts(&self.integrals, quarter);
        let [n, momentum, _] = starts[quarter];
        (n.x.abs().max((momentum.x / self.unit).abs()) < EXACT).then_some(starts)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix4;

    use super::*;

    /// By the growth of deviations in the equations of motion: with `d = (u_1, u_2, u_1', u_2')` and `d' = M d`, whether an eigenvalue of `M`
    /// has a positive real part. Just below and above the spin that stabilises the axis of the highest energy, and at the other axes.
    #[test]
    fn rest_is_unstable_where_deviations_grow() {
        for (inertia_xx, constant_c, size) in
            [(1.3_f64, 0.8, 1.0_f64), (3.0, -0.7, 1.0), (0.4, -0.7, 1e-3), (0.4, 5.0, 1e-3)]
        {
            let body = RigidSpheroid { inertia_xx, inertia_zz: 1.5, constant_c };
            let values = Vector3::new(0.21, -0.04, 0.09) * size;
            for axis in 0..3 {
                let stiffness = [(axis + 1) % 3, (axis + 2) % 3].map(|j| 2.0 * constant_c * (values[j] - values[axis]));
                let roots = stiffness.map(|k| (-k * inertia_xx).max(0.0).sqrt());
                let critical = (roots[0] + roots[1]).max(1e-2 * size.sqrt());
                for momentum in [0.99 * critical, 1.01 * critical] {
                    // G u_2' and -G u_1' in the equations above, divided by I^xx.
                    let gyroscopic = momentum / inertia_xx;
                    let [k1, k2] = stiffness.map(|k| k / inertia_xx);
                    let matrix = Matrix4::from_row_slice(
                        &[
                            [0.0, 0.0, 1.0, 0.0],
                            [0.0, 0.0, 0.0, 1.0],
                            [-k1, 0.0, 0.0, -gyroscopic],
                            [0.0, -k2, gyroscopic, 0.0],
                        ]
                        .concat(),
                    );
                    let growth = matrix.complex_eigenvalues().iter().fold(f64::NEG_INFINITY, |most, x| most.max(x.re));
                    let (n, momentum) = (Vector3::ith(axis, 1.0), Vector3::ith(axis, momentum));
                    let found = near_unstable_rest(&body, &values, n, momentum, momentum.norm().max(1.0));
                    assert_eq!(found, growth > 1e-4 * size.sqrt(), "{body:?} {axis} {momentum} {growth:e}");
                }
            }
        }
    }
}
