//! Fundamental frequencies of a motion: the mean rates of its angles.
//!
//! Every motion is quasi-periodic (it has the third integral of [`clebsch`](crate::dynamics::first_integrals::FirstIntegrals::clebsch)), with
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
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::observables::fundamental_frequencies::{fundamental_frequencies, mean_rate, mean_rates_about};
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?;
//! let motion = problem.taylor((0.0, 3000.0), 1e-12)?;
//! let found = fundamental_frequencies(&motion)?;
//! assert!(found.basis()?.generators().len() >= 2);
//! assert_eq!(mean_rates_about(&motion, &found.frame)?.alpha, found.alpha);
//! // Of any angle in equal steps.
//! let steps: Vec<f64> = (0..2000).map(|k| 0.3 * f64::from(k) + (0.1 * f64::from(k)).sin()).collect();
//! assert!((mean_rate(&steps, 1.0)?.value - 0.3).abs() < 1e-6);
//! # Ok::<(), twofold::Error>(())
//! ```

mod angles;
mod basis;
mod frame;
mod rotated;
mod samples;
mod turns;

pub use crate::numerics::mean_rate::{MeanRate, mean_rate};
pub use basis::FundamentalFrequencies;

use core::f64::consts::TAU;

use nalgebra::Matrix3;

use crate::dynamics::BodyState;
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::propagation::{ContinuousAngles, Motion};
use angles::{body_angles, momentum_angles, momentum_circles, nutation_angles, slow_angles};
use frame::frame_of_precession;
use rotated::Rotated;
use samples::{Averaged, Samples};
use turns::{by_whole_turns, turns_are_certain};

/// A mean rate less certain than this, in units of the rotation rate, is none.
const LEAST_CERTAINTY: f64 = 1e-5;

/// The nutation has the rate `|L| / I^xx` up to a shift of the order of s; what has another is not it.
const LARGEST_SHIFT: f64 = 0.5;

/// A slow precession of fewer turns has not shown its mean rate.
const FEWEST_TURNS: f64 = 3.0;

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
pub fn fundamental_frequencies<M: Motion<f64, State = BodyState<f64>>>(
    motion: &M,
) -> Result<FundamentalFrequencies, Error> {
    let samples = Samples::of(motion)?;
    let averages = samples.averages()?;
    let frame = frame_of_precession(&principal_frame(motion.coefficients())?.principal_from_given, &averages);
    about(motion, &frame, &samples, &averages)
}

/// Mean rates about the third axis of any frame, given by the rotation `frame` from that of the motion to it (the identity: about
/// Z of the motion). They need not be fundamental: about an axis that `L` does not go round `slow` is zero.
///
/// # Errors
/// As for [`fundamental_frequencies`], and [`Error::Domain`] unless `frame` is a rotation (to 1e-9).
pub fn mean_rates_about<M: Motion<f64, State = BodyState<f64>>>(
    motion: &M,
    frame: &Matrix3<f64>,
) -> Result<FundamentalFrequencies, Error> {
    let defect = (frame * frame.transpose() - Matrix3::identity()).norm() + (frame.determinant() - 1.0).abs();
    Error::ensure(defect < 1e-9, "distance of the frame from a rotation", defect, "below 1e-9")?;
    let samples = Samples::of(motion)?;
    let averages = samples.averages()?;
    about(motion, frame, &samples, &averages)
}

fn about<M: Motion<f64, State = BodyState<f64>>>(
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
        momentum: settled(rate(&momenta)?).filter(|_| turns_are_certain(&momenta)),
        slow,
        nutation,
        body,
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;
    use crate::dynamics::Problem;
    use crate::dynamics::{BodyState, RigidSpheroid};
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::observables::tests::Made;
    use crate::propagation::TaylorMotion;

    fn precession(s: [f64; 3], beta: f64, span: (f64, f64)) -> TaylorMotion<f64> {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let angles = EulerAngles { alpha: 0.0, beta, gamma: 0.0 };
        let rates = EulerRates { alpha: 1.1 / beta.cos(), beta: 0.0, gamma: -0.1 };
        let start = BodyState::from_angles(&spheroid, &angles, &rates);
        Problem::new(spheroid, PrincipalCoefficients::new(s).tensor(), start).unwrap().taylor(span, 1e-13).unwrap()
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

    #[test]
    fn frames_are_rotations_to_a_billionth() {
        let motion = turning(Turning::default(), 1.0, 0.0);
        let refused = |scale: f64| match mean_rates_about(&motion, &(Matrix3::identity() * scale)) {
            Err(Error::Domain { quantity, .. }) => quantity,
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(1.0 + 1e-8), "distance of the frame from a rotation");
        assert_eq!(refused(1.0 + 1e-10), "span in turns of n about L");
    }

    /// Rates of `L` round Z at the inclination `tilt`, of `n` round `L` at the inclination `opening`, and of `e_x` round `n`.
    #[derive(Clone, Copy)]
    struct Turning {
        slow: f64,
        tilt: f64,
        nutation: f64,
        opening: f64,
        body: f64,
    }

    impl Default for Turning {
        fn default() -> Self {
            Self { slow: 0.0, tilt: 0.0, nutation: 0.5, opening: 0.3, body: -0.13 }
        }
    }

    type State = Box<dyn Fn(f64) -> Result<BodyState<f64>, Error>>;

    /// With `|L| / I^xx = 0.5`, over times from 0 to `end`.
    fn made(end: f64, error: f64, state: State) -> Made<State> {
        let spheroid = RigidSpheroid { inertia_xx: 3.0, inertia_zz: 3.3, constant_c: 1.0 };
        Made { spheroid, coefficients: Matrix3::zeros(), span: (0.0, end), error, state }
    }

    fn turning(of: Turning, end: f64, error: f64) -> Made<State> {
        let state = move |t: f64| {
            let about_y = |angle| Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
            let about_z = |angle| Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
            let momentum = about_z(of.slow * t) * about_y(of.tilt);
            let body = momentum * about_z(of.nutation * t) * about_y(of.opening) * about_z(of.body * t);
            Ok(BodyState {
                axis: body * Vector3::z(),
                momentum: momentum * Vector3::z() * 1.5,
                equatorial_axis: body * Vector3::x(),
            })
        };
        made(end, error, Box::new(state))
    }

    const SPAN: f64 = 1200.0;

    fn found(of: Turning, error: f64) -> Result<FundamentalFrequencies, Error> {
        mean_rates_about(&turning(of, SPAN, error), &Matrix3::identity())
    }

    fn assert_rate(found: Option<MeanRate>, value: f64, uncertainty: f64) {
        let found = found.unwrap();
        assert!((found.value - value).abs() < 1e-10, "{found:?} {value}");
        assert!((found.uncertainty / uncertainty - 1.0).abs() < 1e-3, "{found:?} {uncertainty:e}");
    }

    #[test]
    fn rates_are_as_certain_as_the_angles_at_one_end() {
        // Ten errors over the span; at most 1e-5 of the rotation.
        let of = Turning::default();
        let rates = found(of, 4.9e-6 * SPAN / 10.0).unwrap();
        assert!(rates.slow.is_none());
        assert_rate(rates.nutation, 0.5, 4.9e-6);
        assert_rate(rates.body, -0.13, 4.9e-6);
        assert_rate(rates.alpha, 0.5, 4.9e-6);
        assert_rate(rates.gamma, -0.13, 4.9e-6);
        let rates = found(of, 5.1e-6 * SPAN / 10.0).unwrap();
        assert_eq!([rates.nutation, rates.body, rates.alpha, rates.gamma, rates.momentum], [None; 5]);
    }

    #[test]
    fn a_slow_precession_of_less_than_three_turns_is_uncertain_by_itself() {
        let of = |turns: f64| Turning { slow: TAU * turns / SPAN, tilt: 0.5, ..Turning::default() };
        for turns in [2.9, -2.9] {
            match found(of(turns), 1e-9) {
                Err(Error::NotConverged { residual, .. }) => {
                    assert!((residual / of(2.9).slow - 1.0).abs() < 1e-6, "{residual}");
                }
                other => panic!("{other:?}"),
            }
        }
        for turns in [3.1, -3.1] {
            let (of, rates) = (of(turns), found(of(turns), 1e-8).unwrap());
            let rounding = 10.0 * 1e-8 / SPAN;
            assert_rate(rates.slow, of.slow, rounding);
            assert_rate(rates.nutation, 0.5, rounding);
            assert_rate(rates.alpha, of.slow, rounding);
            assert_rate(rates.gamma, 0.5 - 0.13, rounding);
        }
        // So little of a turn that it is known all the same: then no rate is known better.
        let slow = 2e-6;
        let rates = found(Turning { slow, tilt: 0.5, ..Turning::default() }, 1e-6 * SPAN / 10.0).unwrap();
        for (rate, value) in [
            (rates.slow, slow),
            (rates.momentum, slow),
            (rates.alpha, slow),
            (rates.gamma, 0.5 - 0.13),
            (rates.nutation, 0.5),
            (rates.body, -0.13),
        ] {
            assert_rate(rate, value, 3e-6);
        }
    }

    /// Far from the time zero, where the end is nine times the span.
    #[test]
    fn rates_do_not_depend_on_when_the_span_begins() {
        let of = |turns: f64| Turning { slow: TAU * turns / SPAN, tilt: 0.5, ..Turning::default() };
        let later = |of: Turning| {
            let mut motion = turning(of, SPAN, 1e-8);
            motion.span = (8.0 * SPAN, 9.0 * SPAN);
            mean_rates_about(&motion, &Matrix3::identity())
        };
        assert!(matches!(later(of(2.9)), Err(Error::NotConverged { .. })));
        let rates = later(of(3.1)).unwrap();
        assert_rate(rates.slow, of(3.1).slow, 1e-7 / SPAN);
        assert_rate(rates.nutation, 0.5, 1e-7 / SPAN);
    }

    #[test]
    fn a_nutation_has_the_rate_of_the_rotation_but_for_half() {
        for (nutation, is_one) in [(0.26, true), (0.24, false), (0.74, true), (0.76, false), (-0.5, false)] {
            let rates = found(Turning { nutation, ..Turning::default() }, 1e-9).unwrap();
            assert_eq!(rates.nutation.is_some(), is_one, "{nutation}");
            assert_eq!(rates.body.is_some(), is_one, "{nutation}");
        }
    }

    #[test]
    fn angles_are_averaged_from_the_first_sample_to_the_last() {
        // A slow oscillation is not averaged away over the span; each sample counts.
        let angles = |t: f64| EulerAngles {
            alpha: 0.5 * t + 1e-3 * (35.0 * t / SPAN).sin(),
            beta: 0.3,
            gamma: -0.13 * t + 1e-3 * (35.0 * t / SPAN + 0.8).sin(),
        };
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let rates = EulerRates { alpha: 0.0, beta: 0.0, gamma: 0.0 };
        let state = move |t: f64| {
            Ok(BodyState {
                momentum: Vector3::new(0.0, 0.0, 1.5),
                ..BodyState::from_angles(&spheroid, &angles(t), &rates)
            })
        };
        let motion = made(SPAN, 1e-6, Box::new(state));
        let found = mean_rates_about(&motion, &Matrix3::identity()).unwrap();
        let of = |angle: fn(EulerAngles<f64>) -> f64| {
            let times = (0..=1200).map(|i| SPAN * f64::from(i) / 1200.0);
            mean_rate(&times.map(|t| angle(angles(t))).collect::<Vec<_>>(), SPAN / 1200.0).unwrap()
        };
        for (found, expected) in [(found.alpha, of(|angles| angles.alpha)), (found.gamma, of(|angles| angles.gamma))] {
            let found = found.unwrap();
            assert!((found.value - expected.value).abs() < 1e-12, "{found:?} {expected:?}");
            assert!((found.uncertainty - expected.uncertainty - 10.0 * 1e-6 / SPAN).abs() < 1e-12);
        }
    }

    #[test]
    fn alpha_is_that_of_the_nutation_where_no_precession_is_and_a_turn_is_lost() {
        // n goes round L, along Z, but once passes Z on the other side.
        let state = |t: f64| {
            let (sin, cos) = (0.53 * t).sin_cos();
            let aside = 0.05 + 0.4 * (-((t - 9.0 * core::f64::consts::PI / 0.53) / 6.0).powi(2)).exp();
            let (x, y) = (0.3 * cos + aside, 0.3 * sin);
            let axis = Vector3::new(x, y, (1.0 - x * x - y * y).sqrt());
            let equatorial_axis = axis.cross(&Vector3::new(sin, -cos, 0.0)).normalize();
            Ok(BodyState { axis, momentum: Vector3::new(0.0, 0.0, 1.5), equatorial_axis })
        };
        let rounding = 1e-9;
        let found =
            mean_rates_about(&made(SPAN, rounding * SPAN / 10.0, Box::new(state)), &Matrix3::identity()).unwrap();
        let (alpha, nutation) = (found.alpha.unwrap(), found.nutation.unwrap());
        assert!(found.slow.is_none() && (nutation.value - 0.53).abs() < 1e-10, "{found:?}");
        assert!((alpha.value - nutation.value).abs() < 1e-14, "{found:?}");
        assert!((alpha.uncertainty - nutation.uncertainty - rounding).abs() < 1e-14, "{found:?}");
    }
}
