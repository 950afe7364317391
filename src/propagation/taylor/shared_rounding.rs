//! Rounding that all steps of a motion share: of its start, its constants and its frame.
//!
//! Each of them is a known number: the error of the rounded operation. Over many steps it accumulates in one direction,
//! whereas the rounding of single steps averages out, and near the separatrix it grows like any other difference. So it is
//! carried along the motion with its sign.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::numerics::rounding::{two_product, two_sum};
use crate::numerics::scalar::Real;
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::series::{AXIS, COMPANION, MENDED, MOMENTUM};

/// Number of coefficients for which the rounding of the factors matters: the terms of the later ones are small.
pub(super) const SHARES: usize = 12;

/// Differences of the equations and the start that the series solve from the given ones. "Excess" is the value used minus the given one, in real
/// parts, in the frame and the unit of time of the series.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharedRounding {
    /// Relative excess of `1 / I^xx`.
    pub(super) inverse_inertia: f64,
    /// Excess of `2 C s^IJ`, up to a multiple of the identity.
    tensor: Matrix3<f64>,
    /// Excess of `2 C` times the differences of eigenvalues, in addition to that of the tensor.
    differences: Vector3<f64>,
    /// Excess of the rate at which `e_x` rotates about `n`.
    pub(super) rate_about_axis: f64,
    /// Error of `e_x` because it is not exactly normal to `n`, as the rotation about `n` assumes.
    pub(super) off_frame: f64,
}

impl SharedRounding {
    /// The excess for a motion, and the difference of its start in `n`, `L` and the vector carried along.
    pub(super) fn of<S: Real, const V: usize>(setup: &ScaledProblem<S, V>) -> (Self, [Vector3<f64>; V]) {
        let spheroid = setup.spheroid.map(S::re);
        let given = setup.tensor.map(S::re);
        let frame = &setup.frame;
        let used = frame.tensor.map(S::re);
        let start = setup.given_start.map(|v| v.map(S::re));
        let rates = setup.drive().rates();

        let isotropic = given.trace() / 3.0;
        let traceless = given.map_with_location(|i, j, x| if i == j { two_sum(x, -isotropic) } else { (x, 0.0) });
        let back = frame.given_from_series().unwrap_or(Matrix3::identity());
        // The frame after correction: `back` is not exactly a rotation, `back (1 - stretch)` is one to much higher order.
        let stretch = Matrix3::from_fn(|i, j| {
            let unit = if i == j { -1.0 } else { 0.0 };
            sum_of_products(&back.column(i).into(), &back.column(j).into(), unit) / 2.0
        });
        let half_turned = Matrix3::from_fn(|i, j| {
            let (row, column) = (traceless.row(i).transpose(), back.column(j).into_owned());
            let high = sum_of_products_with_rest(&row.map(|x| x.0), &column, 0.0);
            (high.0, high.1 + row.map(|x| x.1).dot(&column))
        });
        let turned_excess = Matrix3::from_fn(|i, j| {
            let (axis, column) = (back.column(i).into_owned(), half_turned.column(j));
            sum_of_products(&axis, &column.map(|x| x.0), -used[(i, j)]) + axis.dot(&column.map(|x| x.1))
        });
        let twice = 2.0 * spheroid.constant_c * setup.scale.time;
        let tensor = (stretch * used + used * stretch - turned_excess) * twice;
        let differences = if frame.is_principal() {
            let products = rates.momentum_of_principal.map(S::re);
            Vector3::from_fn(|i, _| {
                let (difference, lost) = two_sum(used[((i + 1) % 3, (i + 1) % 3)], -used[((i + 2) % 3, (i + 2) % 3)]);
                let (product, rest) = two_product(twice, difference);
                (products[i] - product) - rest - twice * lost
            })
        } else {
            Vector3::zeros()
        };

        let (product, lost) = two_product(rates.axis.re(), spheroid.inertia_xx);
        let inverse_inertia = (product - setup.scale.time + lost) / setup.scale.time;
        let (mut rate_about_axis, mut off_frame) = (0.0, 0.0);
        if V > COMPANION {
            // The exact rotation about `n` is by `|n|` times the angle that is used.
            let (rate, n) = (setup.rate_about_axis.re(), &start[AXIS]);
            let length = sum_of_products(n, n, -1.0) / 2.0;
            rate_about_axis = (excess_of_rate_about_axis(&spheroid, &start, rate) - rate * length) * setup.scale.time;
            off_frame = 2.0 * (sum_of_products(n, &start[COMPANION], 0.0).abs() + length.abs());
        }
        let in_series = setup.start.map(|v| v.vector().map(S::re));
        let at_start = core::array::from_fn(|i| {
            let excess = |j: usize| -sum_of_products(&back.column(j).into(), &start[i], -in_series[i][j]);
            Vector3::from_fn(|j, _| excess(j)) + stretch * in_series[i]
        });
        (Self { inverse_inertia, tensor, differences, rate_about_axis, off_frame }, at_start)
    }

    /// The excess of the rate of `L` at the axis `n`.
    pub(super) fn torque(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let products = Vector3::new(n.y * n.z, n.z * n.x, n.x * n.y);
        (self.tensor * n).cross(n) + self.differences.component_mul(&products)
    }
}

/// Relative excess of the rounded factors of the recurrences, `rate / (k + 1)`: for `n` (and the vector carried along) and for
/// the components of `L`, for the coefficients `k + 1 = 1, 2, ...`. For the first ones it has been corrected.
pub(super) fn excess_of_shares<S: Real, const V: usize>(setup: &ScaledProblem<S, V>) -> [[Vector3<f64>; 2]; SHARES] {
    let rates = setup.drive().rates();
    let of_momentum = if setup.frame.is_principal() { rates.momentum_of_principal } else { [rates.momentum; 3] };
    let rates = [[rates.axis; 3], of_momentum].map(|rates| Vector3::from(rates.map(S::re)));
    core::array::from_fn(|k| {
        if k < MENDED {
            return [Vector3::zeros(); 2];
        }
        let divisor = (k + 1) as f64;
        rates.map(|rates| {
            rates.map(|rate| {
                let (product, lost) = two_product(rate / divisor, divisor);
                if rate == 0.0 { 0.0 } else { (product - rate + lost) / rate }
            })
        })
    })
}

/// Excess of the rounded `rate` over `-(1 / I^xx - 1 / I^zz) L.n`.
fn excess_of_rate_about_axis<const V: usize>(body: &RigidSpheroid<f64>, start: &[Vector3<f64>; V], rate: f64) -> f64 {
    let [xx, zz] = [body.inertia_xx, body.inertia_zz];
    let (dot, dot_rest) = sum_of_products_with_rest(&start[AXIS], &start[MOMENTUM], 0.0);
    let (difference, difference_rest) = two_sum(zz, -xx);
    // `rate I^xx I^zz + (I^zz - I^xx) L.n` vanishes except for rounding.
    let (once, once_rest) = two_product(rate, xx);
    let (twice, twice_rest) = two_product(once, zz);
    let (product, product_rest) = two_product(difference, dot);
    let rest = twice_rest + once_rest * zz + product_rest + difference * dot_rest + difference_rest * dot;
    ((twice + product) + rest) / xx / zz
}

/// `a.b + c` as if computed with twice the digits.
fn sum_of_products(a: &Vector3<f64>, b: &Vector3<f64>, c: f64) -> f64 {
    let (high, low) = sum_of_products_with_rest(a, b, c);
    high + low
}

/// The sum of [`sum_of_products`] with its rounding error (Ogita, Rump and Oishi 2005).
fn sum_of_products_with_rest(a: &Vector3<f64>, b: &Vector3<f64>, c: f64) -> (f64, f64) {
    let (mut sum, mut rest) = (c, 0.0);
    for i in 0..3 {
        let (product, lost) = two_product(a[i], b[i]);
        let (next, lost_too) = two_sum(sum, product);
        sum = next;
        rest += lost + lost_too;
    }
    (sum, rest)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::{BodyState, Problem, RotationState};
    use crate::numerics::double_double::DoubleDouble;
    use crate::propagation::taylor::step_size::Work;

    const SPHEROID: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 0.1, constant_c: 0.8 };

    fn setup<const V: usize>(
        spheroid: RigidSpheroid<f64>,
        tensor: &Matrix3<f64>,
        vectors: [Vector3<f64>; V],
    ) -> ScaledProblem<f64, V> {
        let vectors = core::array::from_fn(|i| vectors.get(i).copied().unwrap_or_default());
        let problem = Problem::unchecked(spheroid, *tensor, BodyState::from_vectors(vectors));
        ScaledProblem::new((true, Work::Waiting), &problem, (0.0, 1.0), 1e-10).unwrap()
    }

    /// `U - (B^T T B - U) + (S U + U S)` with `S = (B^T B - 1) / 2`, in 32 digits.
    #[test]
    fn the_tensor_solved_for_differs_by_what_was_rounded() {
        let given = Matrix3::new(0.21, 0.04, -0.03, 0.04, 0.0011, 0.06, -0.03, 0.06, -0.003);
        let setup = setup(SPHEROID, &given, [Vector3::z(), Vector3::new(0.1, 0.2, 2.9)]);
        let found = SharedRounding::of(&setup).0.tensor;
        let (back, used) = (setup.frame.given_from_series().unwrap(), setup.frame.tensor);
        let isotropic = given.trace() / 3.0;
        let sum = |term: &dyn Fn(usize) -> DoubleDouble| term(0) + term(1) + term(2);
        let traceless = |i: usize, j: usize| DoubleDouble::sum(given[(i, j)], if i == j { -isotropic } else { 0.0 });
        let turned = |i: usize, j: usize| {
            let half = |k: usize| sum(&|l| traceless(k, l) * back[(l, j)]);
            sum(&|k| half(k) * back[(k, i)]) - used[(i, j)].into()
        };
        let stretch = |i: usize, j: usize| {
            let unit = if i == j { 1.0 } else { 0.0 };
            (sum(&|k| DoubleDouble::product(back[(k, i)], back[(k, j)])) - unit.into()) * 0.5
        };
        let exact = Matrix3::from_fn(|i, j| {
            let stretched = |k: usize| stretch(i, k) * used[(k, j)] + stretch(k, j) * used[(i, k)];
            (sum(&stretched) - turned(i, j)).high * (2.0 * 0.8 * setup.scale.time)
        });
        assert!((found - exact).amax() < 1e-9 * exact.amax(), "{found} {exact}");
        assert!((0..3).any(|i| traceless(i, i).low != 0.0));
    }

    /// `(T n) x n` for a diagonal `T`, from its differences.
    #[test]
    fn differences_of_eigenvalues_make_the_torque_of_the_tensor() {
        let of = |values: [f64; 3], differences: [f64; 3]| SharedRounding {
            inverse_inertia: 0.0,
            tensor: Matrix3::from_diagonal(&values.into()),
            differences: differences.into(),
            rate_about_axis: 0.0,
            off_frame: 0.0,
        };
        let n = Vector3::new(0.48, -0.6, 0.64);
        let [x, y, z] = [0.3, -0.7, 1.9];
        let expected = of([x, y, z], [0.0; 3]).torque(&n);
        assert!((of([0.0; 3], [y - z, z - x, x - y]).torque(&n) - expected).amax() < 1e-15);
        assert!(expected.iter().all(|torque| torque.abs() > 0.1), "{expected}");
    }

    #[test]
    fn the_rate_about_the_axis_differs_by_what_was_rounded() {
        let start = [Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2)];
        let rate = SPHEROID.rate_about_axis(&start[0], &start[1]);
        let [xx, zz] = [1.3, 0.1];
        let difference = DoubleDouble::sum(zz, -xx);
        assert_ne!(difference.low, 0.0);
        let dot = DoubleDouble::dot(&start[0].into(), &start[1].into());
        let exact = DoubleDouble::product(rate, xx) * zz + difference * dot;
        let found = excess_of_rate_about_axis(&SPHEROID, &start, rate);
        assert_relative_eq!(found, exact.high / (xx * zz), epsilon = 0.0, max_relative = 1e-10);
    }

    #[test]
    fn an_axis_that_is_short_and_not_normal_to_the_other_is_off_the_frame() {
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let vectors = |across: f64| [axis * (1.0 - 1e-10), Vector3::z(), Vector3::y() + axis * across];
        for across in [3e-10, -3e-10] {
            let off_frame = SharedRounding::of(&setup(SPHEROID, &Matrix3::zeros(), vectors(across))).0.off_frame;
            assert_relative_eq!(off_frame, 8e-10, epsilon = 0.0, max_relative = 1e-5);
        }
    }

    /// The excess is compared with fused multiplication for the last of twelve coefficients: the earlier ones are corrected. A rate of one is
    /// not exact in its parts; a rate of zero is.
    #[test]
    fn shares_of_the_rates_are_rounded() {
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.021, 0.021, -0.042));
        let spheroid = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.0, constant_c: 0.8 };
        let vectors = [Vector3::z(), Vector3::new(0.1, 0.2, 1.1)];
        let setup = setup(spheroid, &tensor, vectors);
        let rates = setup.drive().rates();
        assert_eq!((rates.axis, rates.momentum_of_principal[2]), (1.0, 0.0));
        let found = excess_of_shares(&setup);
        assert_eq!(found.len(), 12);
        for (k, [axis, momentum]) in found.iter().enumerate() {
            let divisor = (k + 1) as f64;
            let excess = |rate: f64| (rate / divisor).mul_add(divisor, -rate) / rate;
            if k < MENDED {
                assert_eq!((*axis, *momentum), (Vector3::zeros(), Vector3::zeros()));
                continue;
            }
            assert_eq!(*axis, Vector3::repeat(excess(1.0)));
            for i in [0, 1] {
                let exact = excess(rates.momentum_of_principal[i]);
                assert_relative_eq!(momentum[i], exact, epsilon = 0.0, max_relative = 1e-12);
            }
            assert_eq!(momentum.z, 0.0);
        }
        assert_ne!(found[8][0].x, 0.0);
    }
}
