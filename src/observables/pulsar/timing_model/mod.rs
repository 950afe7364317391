//! The pulses of a wobbling pulsar that slows down, in the form a timing program needs: the phase at a time, and the width of the pulse there,
//! with derivatives with respect to [its parameters](TimingParameter).
//!
//! ```text
//! phase(t) = phase + F0 tau + B(psi) / 2 pi + (F2 - 3 F1^2 / F0) t^3 / 6,    psi = psi_0 + w tau,    t = tau + kappa tau^2 / 2 + Q(tau) - Q(0),    kappa = -F1 / F0
//! B = arg[sin chi (1 - (1 - cos theta) cos^2 psi) - sin theta cos chi cos psi - i sin psi (sin theta cos chi + sin chi (1 - cos theta) cos psi)]
//! ```
//!
//! with the [stretched time](crate::spin_down::StretchedTime) `tau` of a torque with the braking index 3. That law contributes the F2 of a dipole,
//! `3 F1^2 / F0`; any excess of F2 is added as a Taylor term, whatever its origin. The phase counts the turns of the magnetic axis about `L` from the
//! line of sight: `n` circles `L` at `2 pi F0 + w`, and the magnetic axis is ahead of `n` by `pi - psi + B(psi)`. A pulse arrives when the phase is
//! an integer.
//!
//! Lorentz violation moves `L`, and so changes the [inclination](TimingParameter::InclinationRate), which the width shows. Because turns are counted
//! from the line of sight, which rotates about the moving `L`, F0 and F1 absorb offsets that a fit cannot distinguish from them.
//!
//! ```
//! use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter::*};
//!
//! // Ten turns a second, slowing down, with a wobble of 0.05 rad of 500 days.
//! let rate = core::f64::consts::TAU / (500.0 * 86400.0);
//! let star = [(F1, -3e-13), (Wobble, 0.05), (Chi, 1.3), (PrecessionRate, rate), (TorqueShare, 1.0), (Inclination, 1.2), (Rho, 0.3)];
//! let model = TimingModel::new([10.0, 0.0], &star)?;
//! let (phase, derivatives) = model.phase_and_derivatives([3e8, 0.0])?;
//! assert_eq!(phase.whole, 2_999_986_500);
//! // By F1 about t^2 / 2.
//! assert!((derivatives[F1 as usize] / 4.5e16 - 1.0).abs() < 1e-3);
//! # Ok::<(), twofold::Error>(())
//! ```

mod parameter;

pub use parameter::TimingParameter;

use core::f64::consts::{PI, TAU};

use nalgebra::{Const, SVector, U1};
use num_dual::{Derivative, Dual64, DualSVec64};

use super::width::{PulseWidth, pulse_width};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::Real;
pub use crate::solutions::averaged::Turns;
use crate::spin_down::{Braking, Precession, StretchedTime, secular_delay, slowing, torque_delay};
use TimingParameter::*;

/// Number of parameters.
const COUNT: usize = TimingParameter::ALL.len();

type Dual = DualSVec64<COUNT>;

/// Largest number of turns: every integer up to it is a double.
const MOST_TURNS: f64 = 9e15;

/// Maximum number of Newton steps from a number to its time.
const STEPS: usize = 40;

/// Upper limit on the rounding of a phase (turns) at a given double of the time: of its geometry and of its fraction, some 1e-16 each.
const ROUNDING: f64 = 1e-13;

/// Largest rounding of a phase (turns) with which an arrival is a time.
const LARGEST_ROUNDING: f64 = 1e-3;

/// A pulsar described by its timing parameters.
#[derive(Debug, Clone)]
pub struct TimingModel {
    values: [f64; COUNT],
    /// F0 to 32 digits: over 1e12 turns a double has an error of 1e-4 of a turn.
    frequency: DoubleDouble,
    time: StretchedTime,
}

impl TimingModel {
    /// A model with the frequency F0 (Hz), the unevaluated sum of two doubles, and the given parameters; the others are zero, except `chi` and the
    /// inclination, which are right angles.
    ///
    /// # Errors
    /// [`Error::Domain`] for a frequency that is not above zero; a wobble that is not between 0 and a right angle; a `chi` closer to 0 or pi than the
    /// wobble, for which the path of the magnetic axis about `n` does not encircle `L`; an angle of the beam outside 0 to pi; and as for
    /// [`StretchedTime::new`].
    pub fn new(frequency: [f64; 2], parameters: &[(TimingParameter, f64)]) -> Result<Self, Error> {
        let mut values = [0.0; COUNT];
        (values[Chi as usize], values[Inclination as usize]) = (PI / 2.0, PI / 2.0);
        for (parameter, value) in parameters {
            values[*parameter as usize] = *value;
        }
        Self::of_values(values, DoubleDouble::from(frequency))
    }

    fn of_values(mut values: [f64; COUNT], frequency: DoubleDouble) -> Result<Self, Error> {
        values[F0 as usize] = frequency.high;
        for (parameter, value) in TimingParameter::ALL.into_iter().zip(values) {
            Error::ensure(value.is_finite(), parameter.key(), value, "a finite number")?;
        }
        let of = |parameter: TimingParameter| values[parameter as usize];
        Error::ensure(frequency.high > 0.0, "f0 (Hz)", frequency.high, "above zero")?;
        Error::ensure((0.0..PI / 2.0).contains(&of(Wobble)), "wobble (rad)", of(Wobble), "from 0 to below pi / 2")?;
        let least = of(Chi).min(PI - of(Chi));
        let beyond = "above the wobble, and so must pi - chi; the path of the magnetic axis about n must encircle L";
        Error::ensure(least > of(Wobble), "chi (rad)", of(Chi), beyond)?;
        Error::ensure((0.0..=PI).contains(&of(Inclination)), "inclination (rad)", of(Inclination), "from 0 to pi")?;
        Error::ensure((0.0..PI).contains(&of(Rho)), "rho (rad)", of(Rho), "from 0 to below pi")?;
        let braking = braking(&values);
        let time = StretchedTime::new(&braking, &precession(&values))?;
        Ok(Self { values, frequency, time })
    }

    /// The value of a parameter.
    pub fn value(&self, parameter: TimingParameter) -> f64 {
        self.values[parameter as usize]
    }

    /// F0 (Hz), the unevaluated sum of two doubles.
    pub fn frequency(&self) -> [f64; 2] {
        self.frequency.into()
    }

    /// The model with some parameters changed. F0 keeps 32 digits, so that small changes accumulate correctly.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn moved(&self, changes: &[(TimingParameter, f64)]) -> Result<Self, Error> {
        let (mut values, mut frequency) = (self.values, self.frequency);
        for (parameter, change) in changes {
            match parameter {
                F0 => frequency += (*change).into(),
                other => values[*other as usize] += change,
            }
        }
        Self::of_values(values, frequency)
    }

    /// The turns of the magnetic axis about `L` from the line of sight, at a time (s) since the epoch, the unevaluated sum of two doubles.
    ///
    /// # Errors
    /// [`Error::Domain`] for more than 9e15 turns; as for [`StretchedTime::stretched_at`].
    pub fn phase(&self, t: [f64; 2]) -> Result<Turns, Error> {
        self.phase_at(self.time.stretched_at(t)?, t[0] + t[1])
    }

    /// Rate of the [`phase`](Self::phase) (turns per second): a pulse whose phase is off by `x` turns is late by `x` over this rate.
    ///
    /// # Errors
    /// As for [`phase`](Self::phase).
    pub fn phase_rate(&self, t: [f64; 2]) -> Result<f64, Error> {
        let tau = self.time.stretched_at(t)?[0];
        let values = self.values.map(Dual64::from_re);
        let of_tau = values[F0 as usize].re + geometry(&precession(&values), Dual64::new(tau, 1.0)).eps / TAU;
        Ok(of_tau * self.time.slowing(tau) + beyond_dipole(&values, Dual64::new(t[0] + t[1], 1.0)).eps)
    }

    /// Arrival time (s since the epoch) of a pulse: the time at which the phase equals its number. The unevaluated sum of two doubles, accurate to
    /// the rounding of the geometry, 1e-16 of a turn, and to what the geometry and F2 change the phase by within the last digit of the time as one
    /// double.
    ///
    /// # Errors
    /// As for [`phase`](Self::phase); [`Error::NotConverged`] where the geometry changes the phase about as fast as the rotation does.
    pub fn arrival(&self, number: i64) -> Result<[f64; 2], Error> {
        check_turns(number as f64)?;
        // Up to the largest number of turns every integer is a double.
        let wanted = DoubleDouble::from(number as f64);
        let mut time = (wanted - self.value(Phase).into()) / self.frequency;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let tau = self.time.stretched_at(time.into())?;
            let Turns { whole, fraction } = self.phase_at(tau, time.high)?;
            let off = (whole - number) as f64 + fraction;
            // This slope leaves out that of the geometry. Each step therefore leaves a fraction of the error, the relative
            // contribution of the geometry, which is small for a slow precession.
            time -= (off / (self.frequency.high * self.time.slowing(tau[0]))).into();
            if off.abs() < 1e-15 || off.abs() >= last && last < self.rounding_at(time.into())? {
                return Ok(time.into());
            }
            last = off.abs();
        }
        Err(Error::NotConverged { what: "arrival of a pulse (turns)", iterations: STEPS, residual: last })
    }

    /// Rounding of the phase (turns) at a time: the geometry and F2 beyond that of a dipole are evaluated at the time as one double.
    fn rounding_at(&self, t: [f64; 2]) -> Result<f64, Error> {
        let of_rotation = self.frequency.high * self.time.slowing(self.time.stretched_at(t)?[0]);
        let rate_of_rest = self.phase_rate(t)? - of_rotation;
        Ok((ROUNDING + f64::EPSILON * (rate_of_rest * t[0]).abs()).min(LARGEST_ROUNDING))
    }

    fn phase_at(&self, tau: [f64; 2], t: f64) -> Result<Turns, Error> {
        let rest = self.value(Phase) + beyond_dipole(&self.values, t) + geometry(self.time.precession(), tau[0]) / TAU;
        check_turns(self.frequency.high * tau[0])?;
        check_turns(rest)?;
        Ok(Turns::at(rest, self.frequency, tau.into()))
    }

    /// The phase and its derivatives, in the order of [`TimingParameter::ALL`].
    ///
    /// # Errors
    /// As for [`phase`](Self::phase).
    pub fn phase_and_derivatives(&self, t: [f64; 2]) -> Result<(Turns, [f64; COUNT]), Error> {
        let (seeded, moved, tau) = self.seeded(t)?;
        let t = t[0] + t[1];
        let phase = seeded[Phase as usize]
            + seeded[F0 as usize] * moved
            + beyond_dipole(&seeded, Dual::from_re(t))
            + geometry(&precession(&seeded), moved) / TAU;
        Ok((self.phase_at(tau, t)?, derivatives(&phase)))
    }

    /// The width of a pulse (s) near a time since the epoch: the azimuth range in which the line of sight is inside the beam, Eq. (56) `[pulsewid]`,
    /// divided by the rotation rate. This rate is taken as F0 at the time, accurate to `w / (2 pi F0)`.
    ///
    /// # Errors
    /// As for [`phase`](Self::phase); [`Error::Domain`] where the line of sight stays inside or outside the beam.
    pub fn width(&self, t: f64) -> Result<f64, Error> {
        Ok(self.width_and_derivatives(t)?.0)
    }

    /// The width of a pulse and its derivatives, in the order of [`TimingParameter::ALL`].
    ///
    /// # Errors
    /// As for [`width`](Self::width).
    pub fn width_and_derivatives(&self, t: f64) -> Result<(f64, [f64; COUNT]), Error> {
        let (seeded, moved, _) = self.seeded([t, 0.0])?;
        let Some(azimuth) = azimuth_of_pulse(&seeded, moved, t) else {
            let allowed = "such that the line of sight crosses the edge of the beam";
            return Err(Error::Domain { quantity: "rho (rad)", value: self.value(Rho), allowed });
        };
        let duration = azimuth / (seeded[F0 as usize] * slowing(&braking(&seeded), &precession(&seeded), moved) * TAU);
        Ok((duration.re, derivatives(&duration)))
    }

    /// Returns the parameters as dual numbers, the stretched time `tau` of the time `t` as a dual number, and `tau` in two doubles. A parameter
    /// that delays the star by `d` at a fixed `tau` lowers the `tau` of a fixed `t` by `d` times the slowing.
    fn seeded(&self, t: [f64; 2]) -> Result<([Dual; COUNT], Dual, [f64; 2]), Error> {
        let tau = self.time.stretched_at(t)?;
        let seed = |k| -> Derivative<f64, Const<COUNT>, U1> { Derivative::derivative_generic(Const, U1, k) };
        let seeded = core::array::from_fn(|k| Dual::new(self.values[k], seed(k)));
        let (braking, precession, at) = (braking(&seeded), precession(&seeded), Dual::from_re(tau[0]));
        let late = secular_delay(&braking, at) + torque_delay(&braking, &precession, at);
        Ok((seeded, Dual::new(tau[0], late.eps * -self.time.slowing(tau[0])), tau))
    }
}

/// Refuses pulse numbers that are too large, and NaN.
pub(crate) fn check_turns(turns: f64) -> Result<(), Error> {
    Error::ensure(turns.abs() <= MOST_TURNS, "phase (turns)", turns, "at most 9e15 in size")
}

fn derivatives(value: &Dual) -> [f64; COUNT] {
    let eps: SVector<f64, COUNT> = value.eps.unwrap_generic(Const, U1);
    eps.into()
}

/// The braking law, with the index of a dipole.
fn braking<S: Real>(values: &[S; COUNT]) -> Braking<S> {
    let [f0, f1, torque_share] = [F0, F1, TorqueShare].map(|parameter| values[parameter as usize]);
    Braking { rate: -f1 / f0, index: S::from_f64(3.0), torque_share }
}

/// The turns from the part of F2 that exceeds the F2 of a dipole.
fn beyond_dipole<S: Real>(values: &[S; COUNT], t: S) -> S {
    let [f0, f1, f2] = [F0, F1, F2].map(|parameter| values[parameter as usize]);
    (f2 - f1 * f1 * 3.0 / f0) * (t * t * t / 6.0)
}

fn precession<S: Real>(values: &[S; COUNT]) -> Precession<S> {
    let [wobble, chi, phase, rate, damping] =
        [Wobble, Chi, PrecessionPhase, PrecessionRate, Damping].map(|parameter| values[parameter as usize]);
    Precession::new([wobble, chi, phase], rate, damping)
}

/// Phase lead (rad) of the magnetic axis about `L` over its mean.
fn geometry<S: Real>(precession: &Precession<S>, tau: S) -> S {
    azimuth_ahead(precession.wobble_at(tau), precession.chi, precession.phase_at(tau)) - precession.ahead(tau)
}

/// `B(psi)` (rad): lead of the azimuth of the magnetic axis about `L` over the azimuth of `n` plus `pi - psi`.
pub(super) fn azimuth_ahead<S: Real>(wobble: S, chi: S, psi: S) -> S {
    let ((sin, cos), (sin_chi, cos_chi)) = (psi.sin_cos(), chi.sin_cos());
    let (sin_wobble, half) = (wobble.sin_cos().0, (wobble * 0.5).sin_cos().0);
    let less = half * half * 2.0;
    let along = sin_chi * (S::one() - less * cos * cos) - sin_wobble * cos_chi * cos;
    let across = -sin * (sin_wobble * cos_chi + sin_chi * less * cos);
    across.atan2(along)
}

/// Azimuth (rad) about `L` from edge to edge of a pulse, Eq. (56) `[pulsewid]`.
fn azimuth_of_pulse<S: Real>(values: &[S; COUNT], tau: S, t: f64) -> Option<S> {
    let of = |parameter: TimingParameter| values[parameter as usize];
    let precession = precession(values);
    let (wobble, psi) = (precession.wobble_at(tau), precession.phase_at(tau));
    let ((sin, cos), (sin_psi, cos_psi), (sin_chi, cos_chi)) = (wobble.sin_cos(), psi.sin_cos(), of(Chi).sin_cos());
    // Components of the magnetic axis along L and perpendicular to it: towards the azimuth of n, and a quarter turn from
    // there.
    let along = cos * cos_chi + sin * sin_chi * cos_psi;
    let (towards, beside) = (sin * cos_chi - cos * sin_chi * cos_psi, sin_chi * sin_psi);
    let colatitude = (towards * towards + beside * beside).sqrt().atan2(along);
    match pulse_width(of(Rho), colatitude, of(Inclination) + of(InclinationRate) * t) {
        PulseWidth::Pulsed(azimuth) => Some(azimuth),
        PulseWidth::AlwaysOn | PulseWidth::NeverOn => None,
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::inference::Unknown;

    /// A pulsar of one turn per second that loses a tenth of its rotation in 1e9 s, and wobbles.
    fn slowing_down(more: &[(TimingParameter, f64)]) -> TimingModel {
        let star = [
            (Phase, 0.3),
            (F1, -1e-10),
            (Wobble, 0.2),
            (Chi, 1.1),
            (PrecessionPhase, 0.7),
            (PrecessionRate, 1.3e-5),
            (TorqueShare, 0.4),
            (Inclination, 1.2),
            (InclinationRate, 2e-10),
            (Rho, 0.4),
        ];
        TimingModel::new([1.0, 1e-18], &[&star, more].concat()).unwrap()
    }

    fn refused(parameters: &[(TimingParameter, f64)], name: &str, value: f64) {
        match TimingModel::new([10.0, 0.0], parameters) {
            Err(Error::Domain { quantity, value: told, .. }) => assert_eq!((quantity, told), (name, value)),
            other => panic!("{parameters:?}: {other:?}"),
        }
    }

    /// A time in two parts is their sum, whatever its parts.
    #[test]
    fn rates_of_the_phase_are_at_the_sum_of_both_parts() {
        let model = slowing_down(&[(F2, 3e-18)]);
        let rate = model.phase_rate([4e8, 0.0]).unwrap();
        assert_relative_eq!(model.phase_rate([1e8, 3e8]).unwrap(), rate, max_relative = 1e-14, epsilon = 0.0);
        assert!((model.phase_rate([1e8, 0.0]).unwrap() / rate - 1.0).abs() > 1e-3);
    }

    /// The rotation has 32 digits, however much it slows down. The rest has only the digits of the time as one double.
    #[test]
    fn rounding_of_the_phase_is_that_of_the_geometry() {
        let (t, rounding) = (4e8, |model: &TimingModel, t| model.rounding_at([t, 0.0]).unwrap());
        let even = TimingModel::new([100.0, 1e-16], &[(F1, -1e-8), (F2, 3e-18)]).unwrap();
        assert!(even.phase_rate([t, 0.0]).unwrap() < 97.0);
        assert_relative_eq!(rounding(&even, t), ROUNDING, max_relative = 1e-3, epsilon = 0.0);
        let cubic = TimingModel::new([100.0, 0.0], &[(F2, 6e-18)]).unwrap();
        for t in [t, -t] {
            let of_rest = f64::EPSILON * 3e-18 * t.abs().powi(3);
            assert_relative_eq!(rounding(&cubic, t), ROUNDING + of_rest, max_relative = 1e-6, epsilon = 0.0);
        }
    }

    #[test]
    fn defaults_are_right_angles() {
        let model = TimingModel::new([10.0, 0.0], &[]).unwrap();
        assert_eq!((model.value(Chi), model.value(Inclination), model.value(Wobble)), (PI / 2.0, PI / 2.0, 0.0));
    }

    #[test]
    fn parameters_have_ranges() {
        refused(&[(Wobble, -0.1)], "wobble (rad)", -0.1);
        refused(&[(Wobble, 1.6)], "wobble (rad)", 1.6);
        refused(&[(Inclination, -0.1)], "inclination (rad)", -0.1);
        refused(&[(Inclination, 3.2)], "inclination (rad)", 3.2);
        refused(&[(Rho, -0.2)], "rho (rad)", -0.2);
        refused(&[(Rho, PI)], "rho (rad)", PI);
        for (chi, wobble) in [(0.3, 0.29), (PI - 0.3, 0.29), (1.5, 1.4), (1.7, 1.4)] {
            assert!(TimingModel::new([10.0, 0.0], &[(Wobble, wobble), (Chi, chi)]).is_ok());
        }
        for (chi, wobble) in [(0.3, 0.31), (PI - 0.3, 0.31), (-0.3, 0.1), (3.3, 0.1), (0.0, 0.0), (PI, 0.0)] {
            refused(&[(Wobble, wobble), (Chi, chi)], "chi (rad)", chi);
        }
    }

    /// A fit stays where the model is valid: both ranges end at the same values, to a billionth.
    #[test]
    fn limits_of_fits_are_the_ranges_of_parameters() {
        let mut limited = 0;
        for parameter in TimingParameter::ALL {
            let is_taken = |value: f64| TimingModel::new([10.0, 0.0], &[(parameter, value)]).is_ok();
            let (least, most) = parameter.limits();
            let small = 1e-9;
            for (end, inwards) in least.map(|end| (end, small)).into_iter().chain(most.map(|end| (end, -small))) {
                // A wobble requires a larger chi, which is at most a right angle from both poles.
                assert!(is_taken(end + inwards) && !is_taken(end - inwards), "{parameter:?} {end}");
                limited += 1;
            }
        }
        assert_eq!(limited, 10);
        assert_eq!((Rho.unit(), F1.unit(), Rho.key()), ("rad", "Hz/s", "rho"));
    }

    #[test]
    fn a_pulse_arrives_when_the_phase_is_its_number() {
        let faster = slowing_down(&[(F1, 5e-11), (PrecessionRate, -4e-5)]);
        // The wobble was too large for the model at a time as long before the epoch as the last pulse is after it.
        let damped = slowing_down(&[(Wobble, 0.5), (Chi, 0.8), (PrecessionRate, 1e-4), (Damping, 1.5e-6)]);
        // A precession a third as fast as the rotation, with a large wobble.
        let fast = slowing_down(&[(F1, -1e-13), (PrecessionRate, 2.0), (Wobble, 0.6)]);
        let even = TimingModel::new([641.928_233_334_553_6, 3.1e-15], &[(Phase, -0.4)]).unwrap();
        for (model, numbers) in [
            (slowing_down(&[]), [-800_000_000_i64, -12_345, 0, 1, 700_000_001]),
            (faster, [-800_000_000, -12_345, 0, 1, 700_000_001]),
            (fast, [-31, -12, 0, 1, 24]),
            (damped, [-30_000, -7, 0, 1, 1_000_000]),
            (even, [-8_999_999_999_999_999, -7, 0, 5_000_000_000_000_001, 8_999_999_999_999_998]),
        ] {
            for number in numbers {
                let Turns { whole, fraction } = model.phase(model.arrival(number).unwrap()).unwrap();
                let off = (whole - number) as f64 + fraction;
                // The time has 32 digits; the phase rounds its geometry and its fraction.
                assert!(off.abs() < 3e-15, "{number}: {off:e}");
            }
        }
        // The phase jumps where the time, as a double, changes by its last digit, so that for some numbers no time has this phase. The jumps are
        // largest where the position angle swings by nearly half a turn, here once in 2,000 turns.
        let fast = slowing_down(&[(F1, -1e-13), (PrecessionRate, 2.0), (Wobble, 0.6)]);
        let swinging = [(F1, -1e-13), (PrecessionRate, -3e-3), (Wobble, 0.5), (Chi, 0.501)];
        let swinging = slowing_down(&swinging);
        for (model, numbers, allowed) in [
            (&fast, 0..1_000, 2e-13),
            (&fast, 10_000_000..10_000_200, 2e-9),
            (&swinging, 577_620_000..577_622_200, 1e-7),
        ] {
            for number in numbers {
                let Turns { whole, fraction } = model.phase(model.arrival(number).unwrap()).unwrap();
                let off = (whole - number) as f64 + fraction;
                assert!(off.abs() < allowed, "{number}: {off:e}");
            }
        }
        assert!(slowing_down(&[]).arrival(9_000_000_000_000_001).is_err());
        // A star whose phase goes backwards in part of each precession.
        let back_and_forth = slowing_down(&[(F1, -1e-13), (PrecessionRate, -60.0), (Wobble, 1.05)]);
        let found: Vec<_> = (0..100).map(|number| back_and_forth.arrival(number)).collect();
        for (number, time) in found.iter().enumerate() {
            if let Ok(time) = time {
                let Turns { whole, fraction } = back_and_forth.phase(*time).unwrap();
                assert!(((whole - number as i64) as f64 + fraction).abs() < 1e-13, "{number}");
            }
        }
        assert!(found.iter().any(|time| matches!(time, Err(Error::NotConverged { .. }))));
    }

    /// Compared with differences over a thousandth of a precession period, whose error is of the third order in it, with an F2 of its own.
    #[test]
    fn the_rate_of_the_phase_is_its_slope() {
        for model in [slowing_down(&[]), slowing_down(&[(F2, 4e-19), (Damping, 2e-9)])] {
            for t in [-6e8, 0.0, 3e8] {
                let step = 240.0;
                let [before, after] = [-step, step].map(|off| model.phase([t, off]).unwrap());
                let turns = (after.whole - before.whole) as f64 + (after.fraction - before.fraction);
                let rate = model.phase_rate([t, 0.0]).unwrap();
                assert_relative_eq!(rate, turns / (2.0 * step), max_relative = 1e-11);
                // Of which the geometry is a part.
                let mean = model.frequency()[0] * model.time.slowing(model.time.stretched_at([t, 0.0]).unwrap()[0]);
                assert!((rate - mean).abs() > 1e-8, "{t}: {rate} {mean}");
            }
        }
    }

    /// Eq. (56) for a magnetic axis at a constant angle to `L`, divided by the rotation rate at the time.
    #[test]
    fn widths_are_those_of_a_ring_in_the_beam() {
        let model = slowing_down(&[(Wobble, 0.0)]);
        for t in [-4e8, 0.0, 7e8] {
            let inclination = 1.2 + 2e-10 * t;
            let half =
                (0.4_f64.cos() - 1.1_f64.cos() * f64::cos(inclination)) / (1.1_f64.sin() * f64::sin(inclination));
            let width = model.width(t).unwrap();
            // F0 of the time, with the braking index 3: F0 / sqrt(1 - 2 F1 t / F0).
            let frequency = (1.0 + 2e-10 * t).sqrt().recip();
            assert_relative_eq!(width * frequency, half.acos() / PI, max_relative = 1e-12);
        }
        assert!(slowing_down(&[(Rho, 0.05)]).width(0.0).is_err());
    }

    /// Compared with central differences of models, with a wobble and a torque that varies with it.
    #[test]
    fn derivatives_of_widths_are_their_slopes() {
        let t = 3e8;
        let model = slowing_down(&[]);
        let (width, slopes) = model.width_and_derivatives(t).unwrap();
        for parameter in TimingParameter::ALL {
            // Steps that change the width by a ten-thousandth of itself or less; F2 does not change it.
            let step = match parameter {
                F1 => 1e-15,
                F2 => 1e-25,
                Damping => 1e-14,
                PrecessionRate | InclinationRate => 1e-12,
                _ => 1e-4,
            };
            let at = |change: f64| model.moved(&[(parameter, change)]).unwrap().width(t).unwrap();
            let slope = (at(step) - at(-step)) / (2.0 * step);
            let largest = slopes[parameter as usize].abs().max(1e-4 * width);
            assert!((slopes[parameter as usize] - slope).abs() < 1e-5 * largest, "{parameter:?}: {slope:e} {slopes:?}");
        }
        assert!(slopes[InclinationRate as usize].abs() > 1e6 && slopes[Wobble as usize].abs() > 1e-3, "{slopes:?}");
    }
}
