//! Taylor series of a motion about one time: the recurrences of the quadratic equations of motion.

use nalgebra::{Matrix2x3, Matrix3, SMatrix, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::scalar::Scalar;

/// The vectors that a series carries, by columns: `n`, `L` and, with `V = 3`, `e_x`.
pub(super) type Vectors<S, const V: usize> = SMatrix<S, 3, V>;

/// Column of the symmetry axis.
pub(super) const AXIS: usize = 0;

/// Column of the angular momentum.
pub(super) const MOMENTUM: usize = 1;

/// Column of the equatorial axis, where it is carried.
pub(super) const EQUATORIAL_AXIS: usize = 2;

/// The recurrences of the Taylor coefficients about one time, `state(t0 + h) = sum_k coefficients[k] (h / unit)^k`.
///
/// The unit of time, a power of two near the time of the motion, keeps high orders within the range of doubles whatever unit
/// the caller counts in; being a power of two it rounds nothing.
///
/// The right-hand sides are quadratic, so each order is a convolution of cross products of the lower ones:
///
/// ```text
/// (k+1) n_{k+1}   = sum_j L_j x n_{k-j} / I^xx
/// (k+1) L_{k+1}   = sum_j (s n)_j x n_{k-j} 2 C
/// (k+1) e_x_{k+1} = sum_j Omega_j x e_x_{k-j},    Omega_j = L_j / I^xx - epsilon Omega^z n_j
/// ```
pub(super) struct Recurrence<S> {
    inverse_inertia: S,
    twice_c: S,
    inverse_inertia_zz: S,
    oblateness: S,
    violation: Matrix3<S>,
    /// `unit / (k + 1)`, divided in `S`: a quotient rounded to a double would cost wider numbers their digits.
    shares: Vec<S>,
    /// `L_j` and `(s n)_j` of the series at work, by rows: both turn `n_{k-j}`, and side by side they do so at once.
    turning: Vec<Matrix2x3<S>>,
    /// `Omega_j`.
    angular_velocity: Vec<Vector3<S>>,
}

impl<S: Scalar> Recurrence<S> {
    /// The recurrences up to `order` (at least one) for time in the given unit.
    pub(super) fn new(spheroid: &RigidSpheroid<S>, violation: &Matrix3<S>, order: usize, unit: f64) -> Self {
        Self {
            inverse_inertia: S::one() / spheroid.inertia_xx,
            twice_c: spheroid.constant_c * 2.0,
            inverse_inertia_zz: S::one() / spheroid.inertia_zz,
            oblateness: spheroid.oblateness(),
            violation: *violation,
            shares: (1..=order).map(|k| S::from_f64(unit) / S::from_f64(k as f64)).collect(),
            turning: Vec::with_capacity(order),
            angular_velocity: Vec::with_capacity(order),
        }
    }

    /// Appends the `order + 1` coefficients about the state `start`.
    pub(super) fn append<const V: usize>(&mut self, start: &Vectors<S, V>, coefficients: &mut Vec<Vectors<S, V>>) {
        let first = coefficients.len();
        coefficients.push(*start);
        let body_turn = start.column(MOMENTUM).dot(&start.column(AXIS)) * self.inverse_inertia_zz * self.oblateness;
        self.turning.clear();
        self.angular_velocity.clear();
        for (k, &share) in self.shares.iter().enumerate() {
            let series = &coefficients[first..];
            let (axis, momentum) = (series[k].column(AXIS), series[k].column(MOMENTUM));
            let pulled = self.violation * axis;
            self.turning.push(Matrix2x3::from_rows(&[momentum.transpose(), pulled.transpose()]));
            let mut next = Vectors::<S, V>::zeros();
            let [axis_change, momentum_change] = self.turned_axis(series);
            next.set_column(AXIS, &(axis_change * (self.inverse_inertia * share)));
            next.set_column(MOMENTUM, &(momentum_change * (self.twice_c * share)));
            if V > EQUATORIAL_AXIS {
                self.angular_velocity.push(momentum * self.inverse_inertia - axis * body_turn);
                next.set_column(EQUATORIAL_AXIS, &(self.turned_equatorial_axis(series) * share));
            }
            coefficients.push(next);
        }
    }

    /// `sum_j L_j x n_{k-j}` and `sum_j (s n)_j x n_{k-j}` for the last coefficient `k` of a series.
    fn turned_axis<const V: usize>(&self, series: &[Vectors<S, V>]) -> [Vector3<S>; 2] {
        let zero = Matrix2x3::zeros();
        let (mut ahead, mut behind) = (zero, zero);
        for (turning, vectors) in self.turning.iter().zip(series.iter().rev()) {
            for i in 0..3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                for row in 0..2 {
                    ahead[(row, i)] += turning[(row, j)] * vectors[(k, AXIS)];
                    behind[(row, i)] += turning[(row, k)] * vectors[(j, AXIS)];
                }
            }
        }
        let sum = ahead - behind;
        [0, 1].map(|row| sum.row(row).transpose())
    }

    /// `sum_j Omega_j x e_x_{k-j}` for the last coefficient `k` of a series.
    fn turned_equatorial_axis<const V: usize>(&self, series: &[Vectors<S, V>]) -> Vector3<S> {
        let pairs = self.angular_velocity.iter().zip(series.iter().rev());
        pairs.fold(Vector3::zeros(), |sum, (omega, vectors)| sum + omega.cross(&vectors.column(EQUATORIAL_AXIS)))
    }
}

/// Change of the state over the time `h`, in units of the series, by its coefficients: the sum without its constant term,
/// which the caller adds last.
pub(super) fn change<S: Scalar, const V: usize>(series: &[Vectors<S, V>], h: S) -> Vectors<S, V> {
    // Even and odd powers apart: two short chains of products instead of a long one. The largest terms come last.
    let square = h * h;
    let zero = Vectors::zeros();
    let (mut even, mut odd) = (zero, zero);
    for pair in series[2..].chunks(2).rev() {
        even = even * square + pair[0];
        odd = odd * square + pair.get(1).copied().unwrap_or(zero);
    }
    ((even + odd * h) * h + series[1]) * h
}
