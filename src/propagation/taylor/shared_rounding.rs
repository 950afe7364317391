//! Rounding that all steps of a motion share: of its start, its constants and its frame.
//!
//! Each of them is a number that is known: what the rounded operation lost. Over many steps it adds up in one direction, where
//! the rounding of single steps averages out, and near the separatrix it grows as any other difference does. So it is carried
//! along the motion with its sign.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::propagation::taylor::series::{AXIS, COMPANION, MOMENTUM};
use crate::propagation::taylor::setup::Setup;
use crate::rounding::{two_product, two_sum};
use crate::scalar::Real;

/// Coefficients of which the rounding of the factors matters: the terms of the later ones are small.
pub(super) const SHARES: usize = 12;

/// What the equations and the start that the series solve are more than those given, by real parts, in the frame and the unit
/// of time of the series.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharedRounding {
    /// Relative, of `1 / I^xx`.
    pub(super) inverse_inertia: f64,
    /// Of `2 C s^IJ`, up to a multiple of the identity.
    tensor: Matrix3<f64>,
    /// Of `2 C` times the differences of eigenvalues, beyond those of the tensor.
    differences: Vector3<f64>,
    /// Of the rate at which `e_x` turns about `n`.
    pub(super) rate_about_axis: f64,
    /// Of `e_x`, for not being normal to `n` as the turn about `n` takes it to be.
    pub(super) off_frame: f64,
}

impl SharedRounding {
    /// Of a motion, and the difference of its start in `n`, `L` and the vector carried along.
    pub(super) fn of<S: Real, const V: usize>(setup: &Setup<S, V>) -> (Self, [Vector3<f64>; V]) {
        let spheroid = setup.spheroid.map(S::re);
        let given = setup.violation.map(S::re);
        let frame = &setup.frame;
        let used = frame.violation.map(S::re);
        let start = setup.given_start.map(|v| v.map(S::re));
        let rates = setup.drive().rates();

        let isotropic = given.trace() / 3.0;
        let traceless = given.map_with_location(|i, j, x| if i == j { two_sum(x, -isotropic) } else { (x, 0.0) });
        let back = frame.given_from_series().unwrap_or(Matrix3::identity());
        // The frame turned by: `back` is not quite a rotation, `back (1 - stretch)` is one to much higher order.
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
                debug_assert!(products[i].is_nan() || products[i] == twice * difference);
                -two_product(twice, difference).1 - twice * lost
            })
        } else {
            Vector3::zeros()
        };

        let (product, lost) = two_product(rates.axis.re(), spheroid.inertia_xx);
        let inverse_inertia = (product - setup.scale.time + lost) / setup.scale.time;
        let (mut rate_about_axis, mut off_frame) = (0.0, 0.0);
        if V > COMPANION {
            // By `|n|` times the angle that is taken.
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

    /// What it makes of the rate of `L` at the axis `n`.
    pub(super) fn torque(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let products = Vector3::new(n.y * n.z, n.z * n.x, n.x * n.y);
        (self.tensor * n).cross(n) + self.differences.component_mul(&products)
    }
}

/// What the rounded factors of the recurrences, `rate / (k + 1)`, are more than that, relative: of `n` (and the vector carried
/// along) and of the components of `L`, for the coefficients `k + 1 = 1, 2, ...`.
pub(super) fn excess_of_shares<S: Real, const V: usize>(setup: &Setup<S, V>) -> [[Vector3<f64>; 2]; SHARES] {
    let rates = setup.drive().rates();
    let of_momentum = if setup.frame.is_principal() { rates.momentum_of_principal } else { [rates.momentum; 3] };
    let rates = [[rates.axis; 3], of_momentum].map(|rates| Vector3::from(rates.map(S::re)));
    core::array::from_fn(|k| {
        let divisor = (k + 1) as f64;
        rates.map(|rates| {
            rates.map(|rate| {
                let (product, lost) = two_product(rate / divisor, divisor);
                if rate == 0.0 { 0.0 } else { (product - rate + lost) / rate }
            })
        })
    })
}

/// What the rounded `rate` is more than `-(1 / I^xx - 1 / I^zz) L.n`.
fn excess_of_rate_about_axis<const V: usize>(body: &RigidSpheroid<f64>, start: &[Vector3<f64>; V], rate: f64) -> f64 {
    let [xx, zz] = [body.inertia_xx, body.inertia_zz];
    let (dot, dot_rest) = sum_of_products_with_rest(&start[AXIS], &start[MOMENTUM], 0.0);
    let (difference, difference_rest) = two_sum(zz, -xx);
    // `rate I^xx I^zz + (I^zz - I^xx) L.n` vanishes but for rounding.
    let (once, once_rest) = two_product(rate, xx);
    let (twice, twice_rest) = two_product(once, zz);
    let (product, product_rest) = two_product(difference, dot);
    let rest = twice_rest + once_rest * zz + product_rest + difference * dot_rest + difference_rest * dot;
    ((twice + product) + rest) / xx / zz
}

/// `a.b + c` as if in twice the digits.
fn sum_of_products(a: &Vector3<f64>, b: &Vector3<f64>, c: f64) -> f64 {
    let (high, low) = sum_of_products_with_rest(a, b, c);
    high + low
}

/// The same with what is lost when it is rounded (Ogita, Rump and Oishi 2005).
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
