//! Sizes relative to which a series is measured, its order and its step.

use core::f64::consts::SQRT_2;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::numerics::arithmetic::LoadStore;
use crate::numerics::scalar::{Real, real_part};
use crate::propagation::taylor::series::{MAX_ORDER, MOMENTUM, Vectors};

/// Sizes relative to which errors are measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    /// Size of the angular momentum, including the contribution of the torque within its own time scale.
    pub(super) momentum: f64,
    /// Upper bound of the rotation rate of directions.
    pub(super) turning_rate: f64,
    /// A power of two near the inverse of that rate.
    pub(super) time: f64,
    /// Upper bound of the rate at which the torque makes a deviation from a state of rest grow.
    pub(super) growth_rate: f64,
}

/// Longest step, in units of the step for an exponential of size one that grows at the largest rate. Steps chosen for the absolute size of a
/// deviation reach this length at a deviation of `2^-order`; its relative truncation is then some `2^order` times that of a motion of size one.
const LONGEST: f64 = 2.0;

impl Scale {
    pub(super) fn of<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, momentum: &Vector3<S>) -> Self {
        let inertia = spheroid.inertia_xx.re();
        let pull = spheroid.constant_c.re().abs() * s.map(S::re).norm();
        // Two roots, since the product may be out of range even if they are not.
        let of_torque = (2.0 * inertia).sqrt() * pull.sqrt();
        let momentum = real_part(momentum).norm() + of_torque;
        let body_turn = (1.0 - spheroid.inertia_xx.re() / spheroid.inertia_zz.re()).abs();
        let turning_rate = momentum / inertia * (1.0 + body_turn);
        let time = if turning_rate > 0.0 { 2f64.powi(-turning_rate.log2().clamp(-1000.0, 1000.0) as i32) } else { 1.0 };
        // `rate^2 <= 2 C (largest - smallest eigenvalue) / I^xx`, and a difference of eigenvalues is at most `2^(1/2)` times the norm.
        let growth_rate = SQRT_2.sqrt() * of_torque / inertia;
        // A body at rest without torque remains at rest: any unit of momentum is suitable.
        Self { momentum: if momentum > 0.0 { momentum } else { inertia }, turning_rate, time, growth_rate }
    }

    /// Largest component of a coefficient, `L` in units of the momentum; NaN if one is NaN.
    #[inline(always)]
    pub(super) fn size<A: LoadStore, const V: usize>(&self, a: A, coefficient: &Vectors<A::Vector, V>) -> f64 {
        let mut sizes = [0.0; V];
        for i in 0..V {
            sizes[i] = a.largest(coefficient[i]);
        }
        sizes[MOMENTUM] /= self.momentum;
        let mut size = sizes[0];
        for other in &sizes[1..] {
            size = if *other <= size { size } else { *other };
        }
        size
    }

    /// The same from the largest components of `n` and of `L`.
    #[inline(always)]
    pub(super) fn size_of_both(&self, axis: f64, momentum: f64) -> f64 {
        let momentum = momentum / self.momentum;
        if momentum <= axis { axis } else { momentum }
    }
}

/// Growth of the time of a series with its order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Work {
    /// As the square of the order.
    Quadratic,
    /// More slowly: with instructions for whole vectors much of the time is spent waiting for the previous order.
    Waiting,
}

/// Order of the series for a relative truncation `budget` per radian. If the work grows as the square of the order, the
/// optimum is near `-ln(budget) / 2` (Jorba and Zou 2005); if it grows more slowly, the optimum is higher.
pub(super) fn order_for(budget: f64, work: Work) -> usize {
    let share = match work {
        Work::Quadratic => 0.5,
        Work::Waiting => 0.75,
    };
    // One more than a multiple of three, the number of orders that are computed at once.
    let triples = ((-budget.ln() * share - 1.0) / 3.0).round().clamp(2.0, (MAX_ORDER / 3 - 1) as f64);
    3 * triples as usize + 1
}

/// Step with truncation error at most `budget` per unit of time, from the sizes of the last coefficient and the one before
/// (two, since one may vanish by symmetry); zero where the coefficients are out of range.
#[inline(always)]
pub(super) fn step_size(sizes: [f64; 2], order: usize, scale: &Scale, budget: f64) -> f64 {
    // The binary logarithm of the largest step in units of the series.
    let bound = |size: f64, k: usize| match size {
        0.0 => f64::INFINITY,
        size if size.is_finite() => coarse_log2(budget * scale.time / size) / (k as f64 - 1.0),
        _ => f64::NEG_INFINITY,
    };
    // The first omitted term is about the last kept one times (step / radius of convergence), and that ratio is below
    // one fifth: so the last kept term bounds the whole remainder.
    let exponent = bound(sizes[0], order).min(bound(sizes[1], order - 1));
    if exponent == f64::NEG_INFINITY { 0.0 } else { coarse_exp2(exponent) * scale.time }
}

/// Longest step of any motion. Near a state of rest the coefficients are as small as the deviation from it. Steps chosen by their size would not
/// resolve the growth `exp(rate t)` of the deviation, with which it may leave an unstable rest.
pub(super) fn longest_step(order: usize, scale: &Scale, budget: f64) -> f64 {
    let size = |k: usize| (1..=k).fold(1.0, |size, j| size * scale.growth_rate * scale.time / j as f64);
    LONGEST * step_size([size(order), size(order - 1)], order, scale, budget)
}

/// Binary logarithm of a positive number, too small by at most 0.09: from its exponent and its mantissa, which is taken to
/// be linear. A step needs no more precision, and the library's logarithm takes as long as a tenth of a step.
#[inline(always)]
fn coarse_log2(x: f64) -> f64 {
    if !(f64::MIN_POSITIVE..f64::INFINITY).contains(&x) {
        return x.log2();
    }
    (x.to_bits() as f64) / (1u64 << 52) as f64 - 1023.0
}

/// Power of two, accurate to 0.4 %.
#[inline(always)]
fn coarse_exp2(x: f64) -> f64 {
    let x = x.clamp(-1020.0, 1020.0);
    // Positive, so that the conversion rounds down.
    let whole = (x + 1023.0) as u64;
    let rest = x + 1023.0 - whole as f64;
    f64::from_bits(whole << 52) * (1.0 + rest * (0.6565 + 0.3435 * rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coarse_powers_and_logarithms() {
        for i in -9000..9000 {
            let x = f64::from(i) * 0.1 + 0.037;
            let (power, log) = (coarse_exp2(x), coarse_log2(x.exp2()));
            assert!((power / x.exp2() - 1.0).abs() < 4e-3, "2^{x}: {power}");
            assert!(log <= x + 1e-12 && log > x - 0.09, "log2 of 2^{x}: {log}");
        }
        assert_eq!(coarse_log2(0.0), f64::NEG_INFINITY);
        assert_eq!(coarse_exp2(0.0), 1.0);
    }

    /// For a step of `2 h` the last term kept, `(2 rate h)^k / k!`, is `budget h`, up to the missing digits of powers and logarithms.
    #[test]
    fn the_longest_step_is_two_steps_of_an_exponential() {
        for (order, budget) in [(10, 1e-6_f64), (22, 1e-13)] {
            let scale = Scale { momentum: 2.5, turning_rate: 1.7, time: 0.5, growth_rate: 0.4 };
            let h = longest_step(order, &scale, budget) / 2.0;
            let term = |k: usize| (1..=k).fold(1.0, |term, j| term * scale.growth_rate * h / j as f64);
            let largest = f64::max(term(order), term(order - 1)) / (budget * h);
            assert!((0.8..1.05).contains(&largest), "{order}: {largest}");
            let free = Scale { growth_rate: 0.0, ..scale };
            assert!(longest_step(order, &free, budget) > 1e100);
        }
    }

    /// The bound is reached by `n` and `L` of a star at rest that turns in the plane of the largest and the smallest of two eigenvalues of opposite
    /// signs.
    #[test]
    fn a_deviation_grows_at_most_at_the_growth_rate() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.3, 0.0, -0.3));
        // For n along the unstable axis and L = 0: theta'' = 2 C (0.3 + 0.3) theta / I^xx.
        let fastest = (2.0 * 0.7 * 0.6 / 1.3_f64).sqrt();
        let scale = Scale::of(&spheroid, &s, &Vector3::zeros());
        assert!((scale.growth_rate / fastest - 1.0).abs() < 1e-15, "{}", scale.growth_rate / fastest);
        assert_eq!(Scale::of(&spheroid, &Matrix3::zeros(), &Vector3::z()).growth_rate, 0.0);
    }

    #[test]
    fn the_momentum_counts_in_its_unit() {
        let scale = Scale { momentum: 2.5, turning_rate: 1.7, time: 0.5, growth_rate: 0.4 };
        assert_eq!(scale.size_of_both(0.3, 1.0), 0.4);
        assert_eq!(scale.size_of_both(0.5, 1.0), 0.5);
    }

    #[test]
    fn coefficients_out_of_range_allow_no_step() {
        let scale = Scale { momentum: 2.5, turning_rate: 1.7, time: 0.5, growth_rate: 0.4 };
        for sizes in [[f64::INFINITY, 1.0], [1.0, f64::NAN]] {
            assert_eq!(step_size(sizes, 10, &scale, 1e-9), 0.0);
        }
        assert!(step_size([1.0, 1.0], 10, &scale, 1e-9) > 0.0);
    }

    #[test]
    fn a_body_at_rest_without_torque_has_units_of_one() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let scale = Scale::of(&spheroid, &Matrix3::<f64>::zeros(), &Vector3::zeros());
        assert_eq!((scale.momentum, scale.turning_rate, scale.time), (1.3, 0.0, 1.0));
    }
}
