//! Counts whole turns of angles.

use core::f64::consts::TAU;

use super::MeanRate;

/// Between two samples an angle must change by less than this (rad), or its turns are not certain.
const LONGEST_STEP: f64 = 2.0;

/// Turns from the first of some continuous angles to the last.
pub(super) fn turns(angles: &[f64]) -> f64 {
    (angles[angles.len() - 1] - angles[0]).abs() / TAU
}

/// Whether no angle is so far from the one before that there may have been another turn between them.
pub(super) fn turns_are_certain(angles: &[f64]) -> bool {
    angles.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= LONGEST_STEP)
}

/// The rate of an angle that differs from another one by whole turns of the nutation and what averages to zero. Near a pole `alpha` and
/// `gamma` are rough functions of time and their own averages converge slowly, but well enough to count those turns.
pub(super) fn by_whole_turns(rough: MeanRate, base: MeanRate, nutation: MeanRate) -> MeanRate {
    let turns = ((rough.value - base.value) / nutation.value).round();
    let value = base.value + turns * nutation.value;
    let uncertainty = base.uncertainty + turns.abs() * nutation.uncertainty;
    let counted = rough.uncertainty < 0.02 * nutation.value.abs();
    let agree = (value - rough.value).abs() <= 3.0 * (rough.uncertainty + uncertainty);
    if counted && agree && uncertainty < rough.uncertainty { MeanRate { value, uncertainty } } else { rough }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn rate(value: f64, uncertainty: f64) -> MeanRate {
        MeanRate { value, uncertainty }
    }

    #[test]
    fn rough_rates_are_those_of_the_base_and_whole_turns() {
        let (base, nutation) = (rate(0.3, 1e-9), rate(-1.1, 2e-9));
        let close = |a: MeanRate, b: MeanRate| {
            (a.value - b.value).abs() < 1e-15 && (a.uncertainty - b.uncertainty).abs() < 1e-22
        };
        for turns in [-3.0, -1.0, 0.0, 2.0] {
            let exact = rate(0.3 - 1.1 * turns, 1e-9 + 2e-9 * f64::abs(turns));
            // As far as both errors, thrice, allow.
            for off in [0.0, 2.99e-5, -2.99e-5] {
                assert!(close(by_whole_turns(rate(exact.value + off, 1e-5), base, nutation), exact), "{turns} {off}");
            }
            for off in [3.01e-5, -3.01e-5] {
                let rough = rate(exact.value + off, 1e-5);
                assert_eq!(by_whole_turns(rough, base, nutation), rough);
            }
            // Both errors count: that of the base alone would allow it.
            let rough = rate(exact.value + 3.5e-4, 1e-4);
            assert_eq!(by_whole_turns(rough, rate(0.3, 1e-5), nutation), rough);
            assert!(close(by_whole_turns(rough, rate(0.3, 5e-5), rate(-1.1, 0.0)), rate(exact.value, 5e-5)));
            // What is better already stays, and so does what cannot be counted: a fiftieth of the nutation, 0.022.
            let fine = rate(exact.value + 1e-10, 1e-10);
            assert_eq!(by_whole_turns(fine, base, nutation), fine);
            for (error, is_counted) in [(0.0219, true), (0.0221, false)] {
                let rough = rate(exact.value + 0.01, error);
                assert_eq!(by_whole_turns(rough, base, nutation) != rough, is_counted, "{turns} {error}");
            }
        }
        // The base counts, be it above half of the nutation.
        assert!(close(by_whole_turns(rate(-1.3, 1e-5), rate(0.9, 1e-9), nutation), rate(-1.3, 5e-9)));
    }

    #[test]
    fn turns_are_those_from_end_to_end_and_certain_below_two_radians() {
        assert!((turns(&[5.0, 5.9, 9.0, 12.3]) - 7.3 / TAU).abs() < 1e-15);
        assert!((turns(&[12.3, 11.0, 9.0, 5.0]) - 7.3 / TAU).abs() < 1e-15);
        for sign in [1.0, -1.0] {
            for (angles, is_certain) in
                [([5.0, 6.9, 8.8, 10.7], true), ([5.0, 7.1, 8.8, 10.7], false), ([5.0, 6.9, 8.8, 10.9], false)]
            {
                assert_eq!(turns_are_certain(&angles.map(|angle| sign * angle)), is_certain, "{angles:?}");
            }
        }
    }
}
