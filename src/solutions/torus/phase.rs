//! The angles of a torus as functions of time.

use super::closed_orbits::{ClosedOrbits, HalfPeriod};
use crate::numerics::arithmetic::Componentwise;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::four_lanes::FourLanes;
use crate::numerics::rounding::two_product;
use crate::numerics::scalar::Real;

/// `offset + rate t`, in turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Phase {
    pub(super) rate: DoubleDouble,
    pub(super) offset: DoubleDouble,
}

impl Phase {
    /// Turns at the time `t[0] + t[1]`, without whole turns.
    #[inline(always)]
    pub(super) fn at<F: FourLanes>(&self, t: [f64; 2]) -> f64 {
        let rate = self.rate.high;
        let (turns, rest) = if F::FUSED {
            let turns = rate * t[0];
            (turns, rate.mul_add(t[0], -turns))
        } else {
            two_product(rate, t[0])
        };
        let rest = rest + self.rate.low * t[0] + rate * t[1];
        let turns = (turns - turns.round_ties_even()) + (rest - rest.round_ties_even()) + self.offset.high;
        turns - turns.round_ties_even()
    }

    /// Whole turns since the start, to the nearest, and the remaining fraction of a turn.
    pub(super) fn passed(&self, t: [f64; 2]) -> [f64; 2] {
        let part = Self { offset: DoubleDouble::default(), ..*self }.at::<Componentwise<f64>>(t);
        [(self.rate.high * (t[0] + t[1]) - part).round(), part]
    }
}

/// Both angles of the torus, from the state in the plane, and the angle by which `e_x` is behind the vector of the torus. `rate_about_axis` is
/// the value of the method with this name of [`RigidSpheroid`](crate::dynamics::RigidSpheroid).
pub(super) fn phases<S: Real + Into<DoubleDouble>>(rate_about_axis: S, orbits: &ClosedOrbits<S>) -> [Phase; 3] {
    let whole = |half: &HalfPeriod<S>| (half.times.map(|time| time * 2.0), half.turn * 2.0);
    let (([t1, k1], psi1), ([t2, k2], psi2)) = (whole(&orbits.fast), whole(&orbits.slow));
    let determinant = t1 * k2 - t2 * k1;
    let turns = |[t, k]: [S; 2]| [(t * k2 - k * t2) / determinant, (k * t1 - t * k1) / determinant];
    let [f1, f2] = turns([S::one(), S::zero()]);
    let [a, b] = turns(orbits.to_plane.times).map(|turns| -turns);
    // 2 pi, to the precision of the number type.
    let tau = S::zero().atan2(-S::one()) * 2.0;
    let phase = |rate: S, offset: S| {
        let offset: DoubleDouble = offset.into();
        // Whole turns, which the path to the plane of a thin torus may contain, would cost digits of a sum of doubles.
        Phase { rate: rate.into(), offset: offset - DoubleDouble::from(offset.high.round_ties_even()) }
    };
    [
        phase(f1, a),
        phase(f2, b),
        phase((-rate_about_axis - f1 * psi1 - f2 * psi2) / tau, -(orbits.to_plane.turn + a * psi1 + b * psi2) / tau),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a turn is counted once: either in the whole turns or in the fraction.
    #[test]
    fn whole_turns_and_the_part_beside_them_are_all_turns() {
        for (rate, t, turns) in [
            (1.0, [2.5, 0.0], 2.5),
            (1.0, [3.5, 0.0], 3.5),
            (0.25, [1e9, 5.0], 2.5e8 + 1.25),
            (-0.5, [7.0, -2.5], -2.25),
        ] {
            // The offset is the angle at the start, not part of the elapsed turns.
            let phase = Phase { rate: DoubleDouble::from(rate), offset: DoubleDouble::from(0.3) };
            let [whole, part] = phase.passed(t);
            assert_eq!(whole + part, turns);
            assert!(whole == whole.round() && part.abs() <= 0.5, "{whole} {part}");
        }
    }

    /// If the product of rate and time is rounded, the whole turns are still integers.
    #[test]
    fn whole_turns_are_whole_numbers() {
        for k in 0..50 {
            let phase = Phase { rate: DoubleDouble::from(0.123_456_7), offset: DoubleDouble::from(0.0) };
            let [whole, part] = phase.passed([1e6 + 0.1 * f64::from(k), 0.37]);
            assert!(whole == whole.round() && part.abs() <= 0.5, "{whole} {part}");
        }
    }
}
