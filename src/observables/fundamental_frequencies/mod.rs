//! Fundamental frequencies of a motion: the mean rates of its angles.
//!
//! Every motion is quasi-periodic (it has the third integral of [`clebsch_integral`](crate::dynamics::first_integrals)), with
//! at most three independent frequencies. Which angles show them depends on the motion:
//!
//! * Where the symmetry axis `n` swings round `L` farther than `L` is from the axis that it precesses about (twofold
//!   precession), the mean rate of `alpha` is that of the fast rotation, and the slow precession of `L` is a frequency of its own.
//! * Where `n` stays near `L` (single precession), `alpha` follows `L`: their mean rates are equal, and the rotation of `n`
//!   about `L`, the nutation, is the frequency of its own.
//! * `L` itself oscillates with `n`. Where that is more than its own slow circle (tp-I), the azimuth of `L` counts turns of
//!   `alpha`: its mean rate is that of `alpha`, as the paper says. The slow frequency is there all the same; it is that of `L` averaged
//!   over the fast rotation.
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! use twofold::observables::fundamental_frequencies::{fundamental_frequencies, mean_rate, mean_rates_about};
//! use twofold::propagation::propagate;
//!
//! let motion = propagate(&star, &s.tensor(), &state, (0.0, 3000.0), 1e-12)?;
//! let found = fundamental_frequencies(&motion)?;
//! assert!(found.basis()?.generators().len() >= 2);
//! let same = mean_rates_about(&motion, &found.frame)?;
//! assert_eq!(same.alpha, found.alpha);
//! // Of any angle in equal steps.
//! let steps: Vec<f64> = (0..2000).map(|k| 0.3 * f64::from(k) + (0.1 * f64::from(k)).sin()).collect();
//! assert!((mean_rate(&steps, 1.0)?.value - 0.3).abs() < 1e-6);
//! # Ok::<(), twofold::Error>(())
//! ```

mod angles;
mod mean_rate;
mod rotated;
mod samples;

pub use mean_rate::{MeanRate, mean_rate};

use core::f64::consts::TAU;

use nalgebra::Matrix3;

use crate::error::Error;
use crate::euler_angles::permuted_from_inertial;
use crate::lorentz_violation::principal_frame;
use crate::observables::spectrum::{FrequencyBasis, Generator};
use crate::propagation::{ContinuousAngles, Motion};
use angles::{body_angles, momentum_angles, momentum_circles, nutation_angles, slow_angles};
use rotated::Rotated;
use samples::{Averaged, Samples};

/// A mean rate less certain than this, in units of the rotation rate, is none.
const LEAST_CERTAINTY: f64 = 1e-5;

/// The nutation has the rate `|L| / I^xx` up to a shift of the order of s; what has another is not it.
const LARGEST_SHIFT: f64 = 0.5;

/// A slow precession of fewer turns has not shown its mean rate.
const FEWEST_TURNS: f64 = 3.0;

/// Between two samples an angle must change by less than this (rad), or its turns are not certain.
const LONGEST_STEP: f64 = 2.0;

/// Mean rates of the angles of a motion about one axis (rad per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FundamentalFrequencies {
    /// Rotation from the frame of the motion to the one to which the angles belong: the third row is the axis.
    pub frame: Matrix3<f64>,
    /// Of the precession angle `alpha`. None where `n` comes as near as one likes to a pole of the axis, on either side of it: `alpha`
    /// and `gamma` then jump by half a turn in no regular sequence, and their mean rates are no fundamental frequencies.
    pub alpha: Option<MeanRate>,
    /// Of the rotation angle `gamma`. None with `alpha`.
    pub gamma: Option<MeanRate>,
    /// Of the azimuth of `L`. None where `L` passes the axis so near that its turns cannot be counted.
    pub momentum: Option<MeanRate>,
    /// Of the azimuth of `L` averaged over the fast rotation: the slow precession. Zero about an axis that it does not go round.
    /// None where it stays on the axis: there is no such circle.
    pub slow: Option<MeanRate>,
    /// Of the fast part of `n` round the averaged `L`, from the plane of `L` and the axis (from a fixed plane where `slow` is
    /// none). None where `n` has no fast part, as in steady precession.
    pub nutation: Option<MeanRate>,
    /// Of `e_x` about `n`, from the direction in which the fast part of `n` moves: `gamma'` but for whole turns of the nutation, and
    /// regular at the poles. None with `nutation`.
    pub body: Option<MeanRate>,
}

impl FundamentalFrequencies {
    /// The independent frequencies, for [`FrequencyBasis::identify`]: `alpha'`, `gamma'`, and of `l'` (`slow`) and `nu'` (`nutation`)
    /// the one that is no combination of those before it; `l'`, `nu'` and `psi'` (`body`) where `alpha` has no mean rate. Frequencies that are
    /// zero within their errors are left out.
    ///
    /// # Errors
    /// [`Error::Domain`] if all are zero.
    pub fn basis(&self) -> Result<FrequencyBasis, Error> {
        let differ = |a: &MeanRate, b: &MeanRate| {
            (a.value - b.value).abs() > 10.0 * (a.uncertainty + b.uncertainty) + 1e-12 * (a.value.abs() + b.value.abs())
        };
        let zero = MeanRate { value: 0.0, uncertainty: 0.0 };
        let moving = |rate: Option<MeanRate>| rate.filter(|rate| differ(rate, &zero));
        let (alpha, slow, nutation) = (moving(self.alpha), moving(self.slow), moving(self.nutation));
        let alpha_is_fast = alpha.is_some_and(|alpha| slow.is_none_or(|slow| differ(&slow, &alpha)));
        let chosen = if self.alpha.is_some() && self.gamma.is_some() {
            let (slow, nutation) = if alpha_is_fast { (slow, None) } else { (None, nutation) };
            vec![("alpha'", alpha), ("gamma'", moving(self.gamma)), ("l'", slow), ("nu'", nutation)]
        } else {
            vec![("l'", slow), ("nu'", nutation), ("psi'", moving(self.body))]
        };
        let generators = chosen.into_iter().filter_map(|(symbol, rate)| {
            rate.map(|rate| Generator { symbol, frequency: rate.value, uncertainty: rate.uncertainty })
        });
        FrequencyBasis::new(generators.collect())
    }
}

/// Mean rates about the principal axis of `s^IJ` that the angular momentum goes round, over the whole span of a motion.
///
/// That is the axis of the smallest eigenvalue (Z in the paper's examples) or that of the largest one (X: the frame is
/// then Y-Z-X, Eq. (36)), never that of the middle one. Where `L` goes round neither, as without Lorentz violation, it is that of
/// the smallest. The axis points along the frame's axis to which it is nearest.
///
/// Accuracy: that of the motion, about its error over the span, once the span is some 80 over the lowest frequency that is
/// noticeable in the angles; mostly this is twice `slow`, 2,000 `t_c` are enough for the paper's examples. Each rate comes with
/// its estimated error.
///
/// # Errors
/// [`Error::NotConverged`] where the span is too short for the slow precession to be known to 1e-5 of the rotation rate, or where it
/// has no mean rate (on a separatrix); [`Error::Domain`] for a span of less than 35 turns of `n` about `L`, for a motion that is
/// exactly on a pole of the axis at one of the sampled times, and for what the motion refuses.
pub fn fundamental_frequencies<M: Motion<f64>>(motion: &M) -> Result<FundamentalFrequencies, Error> {
    let samples = Samples::of(motion)?;
    let averages = samples.averages()?;
    let principal = principal_frame(motion.violation())?.principal_from_given;
    let about_third = axis_to_front(&principal);
    let about_first = axis_to_front(&(permuted_from_inertial::<f64>() * principal));
    let turns = |frame: &Matrix3<f64>| {
        let angles = slow_angles(&averages, frame);
        (angles[angles.len() - 1] - angles[0]).abs() / TAU
    };
    let (first, third) = (turns(&about_first), turns(&about_third));
    let frame = if first > third.max(0.5) { about_first } else { about_third };
    about(motion, &frame, &samples, &averages)
}

/// Mean rates about the third axis of any frame, given by the rotation `frame` from that of the motion to it (the identity: about
/// Z of the motion). They need not be fundamental: about an axis that `L` does not go round `slow` is zero.
///
/// # Errors
/// As for [`fundamental_frequencies`], and [`Error::Domain`] unless `frame` is a rotation (to 1e-9).
pub fn mean_rates_about<M: Motion<f64>>(motion: &M, frame: &Matrix3<f64>) -> Result<FundamentalFrequencies, Error> {
    let defect = (frame * frame.transpose() - Matrix3::identity()).norm() + (frame.determinant() - 1.0).abs();
    Error::unless(defect < 1e-9, "distance of the frame from a rotation", defect, "below 1e-9")?;
    let samples = Samples::of(motion)?;
    let averages = samples.averages()?;
    about(motion, frame, &samples, &averages)
}

/// The frame with its third axis turned, if need be, to the positive side of the axis of the motion's frame nearest to it.
fn axis_to_front(frame: &Matrix3<f64>) -> Matrix3<f64> {
    let axis = frame.row(2).transpose();
    if axis[axis.iamax()] >= 0.0 {
        return *frame;
    }
    Matrix3::from_rows(&[-frame.row(0), frame.row(1).into_owned(), -frame.row(2)])
}

fn about<M: Motion<f64>>(
    motion: &M,
    frame: &Matrix3<f64>,
    samples: &Samples,
    averages: &[Averaged],
) -> Result<FundamentalFrequencies, Error> {
    let turned = Rotated::new(motion, frame);
    let start = turned.state(samples.start)?.angles()?;
    let mut angles = ContinuousAngles::new(&turned, samples.start, &start)?;
    let (from, to) = motion.span();
    let end = from.max(to);
    let (mut alphas, mut gammas) = (Vec::new(), Vec::new());
    for index in 0..samples.states.len() {
        let at = angles.at(samples.time(index).min(end))?;
        alphas.push(at.alpha);
        gammas.push(at.gamma);
    }
    let momenta = momentum_angles(samples, frame);
    let counted = momenta.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= LONGEST_STEP);

    // An error of the angles of this size at one end, under weights that vary as those of the mean rate.
    let rounding = 10.0 * motion.error_estimate(to) / (end - samples.start);
    let rate = |angles: &[f64]| {
        let rate = mean_rate(angles, samples.step)?;
        Ok(MeanRate { uncertainty: rate.uncertainty + rounding, ..rate })
    };
    let size = samples.states.iter().map(|state| state.momentum.norm()).sum::<f64>() / samples.states.len() as f64;
    let rotation = size / motion.spheroid().inertia_xx;
    let certain = |rate: &MeanRate| rate.uncertainty <= LEAST_CERTAINTY * rotation;
    let circles = momentum_circles(samples, averages, frame);
    let mut slow = circles.then(|| rate(&slow_angles(averages, frame))).transpose()?;
    // Less than some turns say what the precession is now, not what it is on average.
    let part_of_turn = slow.filter(|slow| slow.value.abs() * (end - samples.start) < FEWEST_TURNS * TAU);
    let unknown = part_of_turn.map_or(0.0, |slow| slow.value.abs());
    if let Some(slow) = &mut slow {
        slow.uncertainty += unknown;
        if !certain(slow) {
            return Err(Error::NotConverged {
                what: "rate of the slow precession of L over the span: it is too short, or this is a separatrix",
                iterations: samples.states.len(),
                residual: slow.uncertainty,
            });
        }
    }
    let settled = |rate: MeanRate| Some(MeanRate { uncertainty: rate.uncertainty + unknown, ..rate }).filter(certain);
    let nutation = settled(rate(&nutation_angles(averages, frame, circles))?)
        .filter(|nutation| (nutation.value / rotation - 1.0).abs() < LARGEST_SHIFT);
    let (mut alpha, mut gamma, mut body) = (rate(&alphas)?, rate(&gammas)?, None);
    if let Some(nutation) = nutation {
        let still = MeanRate { value: 0.0, uncertainty: rounding };
        let turning = rate(&body_angles(averages))?;
        alpha = by_whole_turns(alpha, slow.unwrap_or(still), nutation);
        gamma = by_whole_turns(gamma, turning, nutation);
        body = settled(turning);
    }
    Ok(FundamentalFrequencies {
        frame: *frame,
        alpha: settled(alpha),
        gamma: settled(gamma),
        momentum: settled(rate(&momenta)?).filter(|_| counted),
        slow,
        nutation,
        body,
    })
}

/// The rate of an angle that differs from another one by whole turns of the nutation and what averages to zero. Near a pole `alpha` and
/// `gamma` are rough functions of time and their own averages converge slowly, but well enough to count those turns.
fn by_whole_turns(rough: MeanRate, base: MeanRate, nutation: MeanRate) -> MeanRate {
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
    use crate::dynamics::{BodyState, RigidSpheroid};
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::propagation::{TaylorMotion, propagate};

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
    }

    fn with_rates(rates: [Option<MeanRate>; 5]) -> FundamentalFrequencies {
        let [alpha, gamma, slow, nutation, body] = rates;
        FundamentalFrequencies { frame: Matrix3::identity(), alpha, gamma, momentum: None, slow, nutation, body }
    }

    #[test]
    fn the_basis_is_of_what_moves_and_differs() {
        let symbols = |rates: [Option<MeanRate>; 5]| {
            let basis = with_rates(rates).basis().map_err(|_| ())?;
            Ok::<_, ()>(basis.generators().iter().map(|g| (g.symbol, g.frequency, g.uncertainty)).collect::<Vec<_>>())
        };
        let [alpha, gamma, slow] = [rate(1.3, 1e-9), rate(-0.2, 2e-9), rate(-0.04, 3e-9)];
        let [nutation, body] = [rate(1.34, 4e-9), rate(0.7, 5e-9)];
        let of = |symbol: &'static str, rate: MeanRate| (symbol, rate.value, rate.uncertainty);
        let all = [Some(alpha), Some(gamma), Some(slow), Some(nutation), Some(body)];
        assert_eq!(symbols(all), Ok(vec![of("alpha'", alpha), of("gamma'", gamma), of("l'", slow)]));
        // alpha' is the slow precession itself, within ten times both errors, or 1e-12 of both.
        let near = |off: f64, size: f64, error: f64| {
            let slow = rate(size, error);
            let alpha = rate(size + off, 2.0 * error);
            symbols([Some(alpha), Some(gamma), Some(slow), Some(nutation), Some(body)]).unwrap()[2].0
        };
        for sign in [1.0, -1.0] {
            for off in [29.9e-9, -29.9e-9] {
                assert_eq!(near(off, 0.04 * sign, 1e-9), "nu'");
                assert_eq!(near(off * 1.01, 0.04 * sign, 1e-9), "l'");
            }
            for off in [1.99e-8, -1.99e-8] {
                assert_eq!(near(off, 1e4 * sign, 0.0), "nu'");
                assert_eq!(near(off * 1.02, 1e4 * sign, 0.0), "l'");
            }
        }
        // Without alpha' or gamma', or where one does not move.
        let others = Ok(vec![of("l'", slow), of("nu'", nutation), of("psi'", body)]);
        assert_eq!(symbols([None, None, Some(slow), Some(nutation), Some(body)]), others);
        assert_eq!(symbols([Some(alpha), None, Some(slow), Some(nutation), Some(body)]), others);
        assert_eq!(symbols([None, Some(gamma), Some(slow), Some(nutation), Some(body)]), others);
        let still = Some(rate(0.9e-8, 1e-9));
        assert_eq!(
            symbols([still, Some(gamma), Some(slow), Some(nutation), None]),
            Ok(vec![of("gamma'", gamma), of("nu'", nutation)])
        );
        assert_eq!(symbols([Some(alpha), still, None, Some(nutation), None]), Ok(vec![of("alpha'", alpha)]));
        assert_eq!(symbols([still; 5]), Err(()));
        assert_eq!(symbols([None; 5]), Err(()));
    }

    fn precession(s: [f64; 3], beta: f64, span: (f64, f64)) -> TaylorMotion<f64> {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let angles = EulerAngles { alpha: 0.0, beta, gamma: 0.0 };
        let rates = EulerRates { alpha: 1.1 / beta.cos(), beta: 0.0, gamma: -0.1 };
        let start = BodyState::from_angles(&spheroid, &angles, &rates);
        propagate(&spheroid, &PrincipalCoefficients::new(s).tensor(), &start, span, 1e-13).unwrap()
    }

    #[test]
    fn free_precession_about_z_has_two_frequencies() {
        for span in [(0.0, 500.0), (500.0, 0.0)] {
            let found = fundamental_frequencies(&precession([0.0; 3], 0.7, span)).unwrap();
            assert!((found.alpha.unwrap().value - 1.1 / 0.7_f64.cos()).abs() < 1e-12);
            assert!((found.gamma.unwrap().value + 0.1).abs() < 1e-12);
            assert!(found.slow.is_none() && found.momentum.is_none_or(|rate| rate.value.is_finite()));
            assert_eq!(found.basis().unwrap().generators().len(), 2);
        }
    }

    #[test]
    fn spans_too_short_are_refused() {
        let s = [0.02, 0.01, -0.04];
        let over = |span| fundamental_frequencies(&precession(s, 0.9, (0.0, span)));
        assert!(matches!(over(50.0), Err(Error::Domain { .. })));
        assert!(matches!(over(200.0), Err(Error::NotConverged { .. })));
        let motion = precession(s, 0.9, (0.0, 300.0));
        assert!(matches!(mean_rates_about(&motion, &(Matrix3::identity() * 1.1)), Err(Error::Domain { .. })));
        assert!(matches!(mean_rates_about(&motion, &-Matrix3::<f64>::identity()), Err(Error::Domain { .. })));
    }

    #[test]
    fn a_mean_rate_needs_angles() {
        assert!(mean_rate(&[0.0; 15], 1.0).is_err() && mean_rate(&[0.0; 16], 1.0).is_ok());
        assert!(mean_rate(&[f64::NAN; 16], 1.0).is_err() && mean_rate(&[0.0; 16], 0.0).is_err());
    }
}
