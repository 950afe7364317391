//! Estimated difference between the averaged motion and the exact motion.
//!
//! With `x = |C| (s_max - s_min) I^xx / G^2` and the rotation angle `theta = G t / I^xx`, the averaged motion of order `p` neglects terms of the
//! following orders:
//!
//! ```text
//! periodic parts, in the transformation both ways           x^2
//! terms of the rates, and of the torque on l                x^(p + 1) G / I^xx
//! terms of the tensor that moves l, relative to it          x^p
//! ```
//!
//! The motion of a bulge alone is exact ([`bulge`](crate::dynamics::bulge)): with one, of strength `y = |b| (s_max - s_min) I^xx`, a
//! power `x^k` becomes `x (x + y)^(k - 1)`.
//!
//! The effect on `l` after a time `t` is estimated in three ways, of which the smallest result counts.
//!
//! * Neighbouring solutions separate at most at the rate `kappa = (k_1 - k_3) / 2` (half the largest `l.(d x k d)`, for unit `d`).
//! * If two values differ only by `g`, neighbouring solutions shear about the third axis: they separate at the rate `K = k_1 - k_3` times
//!   their difference along that axis, and this difference changes at most at the rate `g` times their distance. A distance therefore grows
//!   at most by the factor `(1 + K t) exp(t (sqrt(K g) + g))`, where `g` contains the error of the tensor.
//! * Neighbouring solutions stay near their own closed curves, and separate because their periods differ. The difference of the periods is
//!   computed from two neighbouring tops, shifted towards either axis. This is valid only if they are on the same side of the separatrix.

use nalgebra::Vector3;

use super::hamiltonian::AveragingOrder;
use super::motion::AveragedSolution;
use super::top::Top;
use crate::numerics::scalar::{Real, real_part};

/// Coefficients of the neglected terms, from random motions over the whole domain: see the accuracy of the averaged motion in
/// `docs/`.
const PERIODIC: f64 = 4.0;
const SECULAR: f64 = 4.0;
const TENSOR: f64 = 1.0;

/// Errors of an averaged motion, from which the error of its state is estimated.
struct Fault {
    /// Error at any time.
    constant: f64,
    /// Error of the rate at which the body turns about `L` (rad per unit of time).
    rate: f64,
    /// Error of the tensor and of the start, by which neighbouring solutions are displaced.
    neighbour: f64,
}

impl<S: Real> AveragedSolution<S> {
    /// Estimated largest error of `n`, `e_x` and `L / G` at the time `t`: [`truncation`](Self::truncation) and
    /// [`rounding`](Self::rounding).
    pub fn error_estimate(&self, t: f64) -> f64 {
        // The distance of two directions is at most two, and the relative error of G is less than the strength.
        let most = 2.0 * (1.0 + self.relative_strength.re());
        (self.truncation(t) + self.rounding(t)).min(most)
    }

    /// The truncation error of the averaging order at the time `t`.
    pub fn truncation(&self, t: f64) -> f64 {
        let (x, y) = (self.relative_strength.re(), self.bulge_strength().re());
        // The terms of higher order, as a geometric series.
        let series = 1.0 - (x + y);
        let (x, both) = (x / series, (x + y) / series);
        let power = match self.order {
            AveragingOrder::First => x,
            AveragingOrder::Second => x * both,
        };
        let fault = Fault {
            constant: PERIODIC * x * both,
            rate: SECULAR * power * both * self.turning_rate(),
            neighbour: TENSOR * power,
        };
        self.consequence(&fault, t.abs())
    }

    /// Rounding of the initial state and of the contribution of Lorentz violation to the phases, at the time `t`. The free rotation itself is known
    /// to 32 digits, with one exception: an axis `n` given in doubles has length one only to rounding, and the rate about `n` has a relative error of
    /// that size.
    pub fn rounding(&self, t: f64) -> f64 {
        // The contribution to the phases, which includes the slow rate; at c^2 = 1/3 the slow rate is small.
        let added = self.tensor().map(S::re).amax() + self.relative_strength.re() * self.turning_rate();
        // Theta functions lose half of the digits of k'.
        let lost = self.top().complement().sqrt().max(1e-8);
        let fault = Fault {
            constant: 16.0 * f64::EPSILON / lost,
            rate: 8.0 * f64::EPSILON * added,
            neighbour: 8.0 * f64::EPSILON,
        };
        self.consequence(&fault, t.abs()) + self.rounding_of_rate_about_axis() * t.abs()
    }

    fn consequence(&self, fault: &Fault, elapsed: f64) -> f64 {
        let k = self.tensor().map(S::re);
        let l = real_part(&self.direction());
        let kappa = (k.max() - k.min()) / 2.0;
        let middle = k.sum() - k.max() - k.min();
        // (e^(kappa t) - 1) / kappa, and its limit if nothing moves.
        let grown = kappa * elapsed;
        let integral = if grown > 0.0 { grown.exp_m1() / grown * elapsed } else { elapsed };
        let by_growth = (fault.constant + fault.rate * integral) + fault.constant * (integral * kappa);
        let gap = (k.max() - middle).min(middle - k.min()) + 2.0 * kappa * fault.neighbour;
        let by_shear = (fault.constant + fault.rate * elapsed)
            * ((1.0 + 2.0 * grown) * (((2.0 * kappa * gap).sqrt() + gap) * elapsed).exp());
        let [along, about] = neighbouring_rates(&k, &l, fault.neighbour);
        let by_periods = fault.constant + (fault.rate + along) * elapsed;
        let of_momentum = by_growth.min(by_shear).min(by_periods);
        let of_angle = fault.rate * elapsed + (about * elapsed).min(2.0 * grown * of_momentum);
        of_momentum.min(2.0) * 2.0 + of_angle
    }
}

/// Rates at which two neighbours on the sphere separate: along their curves, and in the angle about `l`.
fn neighbouring_rates(k: &Vector3<f64>, l: &Vector3<f64>, distance: f64) -> [f64; 2] {
    // Normalised like its neighbours, so that the rates do not differ if the distance is zero.
    let here = Top::new((*k).into(), &l.normalize());
    let speed = k.component_mul(l).cross(l).norm().max(here.largest_speed());
    let mut most = [0.0_f64; 2];
    for axis in [k.imin(), k.imax()] {
        let mut beside = *l;
        beside[axis] += distance.copysign(l[axis]);
        let beside = Top::new((*k).into(), &beside.normalize());
        if !beside.is_beside(&here) {
            return [f64::INFINITY, f64::INFINITY];
        }
        let (there, here) = (beside.rates, here.rates);
        let slow = here.slow.abs().max(f64::MIN_POSITIVE);
        most[0] = most[0].max((there.slow - here.slow).abs() / slow * speed);
        most[1] = most[1].max((there.about - here.about).abs());
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::problem;

    /// The second order leaves out terms that are smaller by the strengths of torque and bulge together, however weak the torque.
    #[test]
    fn a_bulge_counts_in_what_the_second_order_leaves_out() {
        for strength in [0.02, 0.1] {
            let stiff = problem([2e-9, 1e-9, -3e-9]).with_bulge(strength / (5e-9 * 1.3)).unwrap();
            let growth = |order| {
                let mean = AveragedSolution::new(&stiff, order).unwrap();
                assert!((mean.bulge_strength() / strength - 1.0).abs() < 1e-12 && mean.relative_strength < 1e-8);
                mean.truncation(100.0) - mean.truncation(0.0)
            };
            let ratio = growth(AveragingOrder::Second) / growth(AveragingOrder::First);
            // The series of the powers has the sum strength / (1 - strength).
            assert!((ratio * (1.0 - strength) / strength - 1.0).abs() < 0.1, "{strength}: {ratio}");
        }
    }
}
