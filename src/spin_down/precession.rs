//! Free precession, with a wobble that internal friction damps.

use core::f64::consts::{PI, TAU};
use core::num::NonZeroUsize;
use std::sync::LazyLock;

use super::TorqueHarmonics;
use super::stretched_time::{exp_less_one, within};
use crate::error::Error;
use crate::numerics::gauss::unit_rule;
use crate::numerics::scalar::Real;

/// Largest damping per radian of the precession; the error is proportional to its third power.
const MOST_DAMPING: f64 = 0.1;

/// Largest damping since the time zero. The averages over that time are analytic up to a distance `i pi / 2`, so Gauss' formula with [`NODES`] nodes
/// is accurate to a fraction 3.4^(-32) = 1e-17 of them.
const MOST_DAMPED: f64 = 2.0;

/// Number of nodes of Gauss' formula.
const NODES: NonZeroUsize = NonZeroUsize::new(16).unwrap();

static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| unit_rule(NODES));

/// The free precession of a star, which modulates its torque.
///
/// Internal friction leaves `L` unchanged and reduces the wobble `theta`, `d theta / d tau = -gamma sin theta cos theta`:
///
/// ```text
/// tan theta = tan theta_0 exp(-gamma tau),    d psi / d tau = w cos theta / cos theta_0
/// ```
///
/// with the time `tau` in which the star does not slow down. For a prolate star friction increases the wobble, and `gamma` is
/// negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Precession<S = f64> {
    /// Wobble angle `theta_0` of the symmetry axis `n` to `L` at the time zero (rad).
    pub wobble: S,
    /// Angle `chi` of the magnetic axis to `n` (rad).
    pub chi: S,
    /// The angle `psi` about `n`, from the projection of the magnetic axis to the projection of `L`, both onto the plane
    /// normal to `n`, at the time zero (rad).
    pub phase: S,
    /// Its rate `w` at the time zero (rad per unit of stretched time): `epsilon Omega^z` without Lorentz violation.
    pub rate: S,
    /// Rate `gamma` at which friction damps the wobble (1 per unit of stretched time).
    pub damping: S,
    /// The torque over one precession with the wobble at the time zero.
    pub(super) torque: TorqueHarmonics<S>,
    /// `sin^2 theta_0` and `cos^2 theta_0`.
    squares: [S; 2],
}

/// Averages of a damped wobble since the time zero.
struct Averages<S> {
    /// Average of `cos theta / cos theta_0 - 1`.
    rate: S,
    /// Average of `sin^2 theta - sin^2 theta_0`.
    square: S,
    /// Average as for `square`, weighted with the remaining time; for a constant it is half of that.
    square_twice: S,
}

/// The effect of a slow damping on the oscillating torque.
pub(super) struct DampedTorque<S> {
    /// Factors of its first integral, relative to `a_1 sin psi / w`, `a_1 cos psi / w`, `a_2 sin 2 psi / (2 w)` and
    /// `a_2 cos 2 psi / (2 w)`.
    pub(super) once: [S; 4],
    /// Factors of its second, relative to `-a_1 cos psi / w^2`, `-a_1 sin psi / w^2`, `-a_2 cos 2 psi / (4 w^2)` and
    /// `-a_2 sin 2 psi / (4 w^2)`.
    pub(super) twice: [S; 4],
}

impl<S: Real> Precession<S> {
    /// The precession with its angles (rad) at the time zero, the rate of `psi`, and the damping rate.
    pub fn new([wobble, chi, phase]: [S; 3], rate: S, damping: S) -> Self {
        let (sin, cos) = wobble.sin_cos();
        Self {
            wobble,
            chi,
            phase,
            rate,
            damping,
            torque: TorqueHarmonics::new(wobble, chi),
            squares: [sin * sin, cos * cos],
        }
    }

    /// Whether the wobble is constant. The derivative of a dual number with respect to the damping is then added separately.
    pub(super) fn is_undamped(&self) -> bool {
        self.damping.re() == 0.0
    }

    /// The derivatives of a damping that is zero, times the slope with respect to it; zero for a real number.
    pub(super) fn slope(&self, slope: impl FnOnce(&Precession) -> f64) -> S {
        if !S::HAS_DERIVATIVES {
            return S::zero();
        }
        let [wobble, chi, phase, rate] = [self.wobble, self.chi, self.phase, self.rate].map(S::re);
        self.damping * slope(&Precession::new([wobble, chi, phase], rate, 0.0))
    }

    /// The wobble angle at a stretched time (rad), of a wobble from 0 to pi that is no right angle.
    pub fn wobble_at(&self, tau: S) -> S {
        let (sin, cos) = self.wobble.sin_cos();
        if self.is_undamped() {
            return self.wobble - self.damping * (tau * sin * cos).re();
        }
        let x = self.damping * tau;
        (sin * (-x).exp()).atan2(cos)
    }

    /// The angle `psi` at a stretched time, without whole turns of `w tau` (rad).
    pub(crate) fn phase_at(&self, tau: S) -> S {
        self.phase + self.swept(tau, TAU)
    }

    /// The growth of `psi`, without whole multiples of `turn` in `w tau` (rad).
    pub(super) fn swept(&self, tau: S, turn: f64) -> S {
        within(self.rate * tau, turn) + self.ahead(tau)
    }

    /// Phase advance of `psi` due to damping (rad): a smaller wobble precesses faster. The result is accurate to rounding within two damping times
    /// of the time zero, for a wobble from 0 to pi that is no right angle.
    pub fn ahead(&self, tau: S) -> S {
        if self.is_undamped() {
            let [rate, tau, sine] = [self.rate.re(), tau.re(), self.squares[0].re()];
            return self.damping * (0.5 * rate * tau * tau * sine);
        }
        self.rate * tau * self.averages(tau).rate
    }

    /// Integral of the change of the mean torque, `a_0(theta) - a_0(theta_0)`, and the integral of that integral.
    pub(super) fn mean_torque(&self, tau: S) -> [S; 2] {
        let slope = self.slope_of_mean_torque();
        let Averages { square, square_twice, .. } = self.averages(tau);
        [slope * square * tau, slope * square_twice * tau * tau]
    }

    /// Slope of `a_0` with respect to `sin^2 theta`.
    fn slope_of_mean_torque(&self) -> S {
        let (sin, cos) = self.chi.sin_cos();
        cos * cos - sin * sin * 0.5
    }

    fn averages(&self, tau: S) -> Averages<S> {
        let [sin, cos] = self.squares;
        let x = self.damping * tau;
        let tangent = sin / cos;
        let secant = (S::one() + tangent).sqrt();
        let mut sum = Averages { rate: S::zero(), square: S::zero(), square_twice: S::zero() };
        for &(part, weight) in RULE.iter() {
            // Change of tan^2 theta.
            let change = tangent * exp_less_one(-x * (2.0 * part));
            let over = S::one() + tangent + change;
            let here = over.sqrt();
            let square = change * cos / over;
            sum.rate += -change / ((secant + here) * here) * weight;
            sum.square += square * weight;
            sum.square_twice += square * (weight * (1.0 - part));
        }
        sum
    }

    /// The effect of damping on the oscillating torque, by partial integration to second order in the damping over the rate.
    pub(super) fn damped_torque(&self, tau: S) -> DampedTorque<S> {
        let number = S::from_f64;
        let (x, [sin, cos]) = (self.damping * tau, self.squares);
        let slow = self.damping / self.rate;
        let fallen = (-x).exp();
        let twice = fallen * fallen;
        // cos^2 theta and cos theta / cos theta_0.
        let u = cos / (cos + sin * twice);
        let faster = (u / cos).sqrt();
        let y = slow / faster;
        DampedTorque {
            once: [
                fallen * faster * (number(1.0) + y * y * u * (number(1.0) - u * 2.0)),
                -fallen * slow * u,
                twice * faster * (number(1.0) - y * y * (number(1.0) + u * u) * 0.5),
                -twice * slow * (number(1.0) + u) * 0.5,
            ],
            twice: [
                fallen * (number(1.0) - y * y * (number(2.0) - u * 2.0 + u * u * 3.0)),
                fallen * y * (number(1.0) + u),
                twice * (number(1.0) - y * y * (number(11.0) - u * 2.0 + u * u * 3.0) * 0.25),
                twice * y * (number(3.0) + u) * 0.5,
            ],
        }
    }
}

impl Precession {
    /// Slope of the varying part of the first integral of the torque, times `w`, with respect to the damping at zero damping and
    /// fixed `psi`.
    pub(super) fn slope_of_first(&self, tau: f64) -> f64 {
        let (w, psi, [sin, cos]) = (self.rate, self.phase_at(tau), self.squares);
        let TorqueHarmonics { once, twice, .. } = self.torque;
        -once * cos * (tau * psi.sin() + psi.cos() / w)
            - twice * (1.0 + cos) * 0.5 * (tau * (2.0 * psi).sin() + (2.0 * psi).cos() / (2.0 * w))
            - self.slope_of_mean_torque() * tau * tau * sin * cos * w
    }

    /// Slope of the second integral of the torque with respect to the damping at zero damping and fixed `psi`.
    pub(super) fn slope_of_second(&self, tau: f64) -> f64 {
        let (w, psi, [sin, cos]) = (self.rate, self.phase_at(tau), self.squares);
        let TorqueHarmonics { once, twice, .. } = self.torque;
        let change = |multiple: f64| (multiple * psi).sin() - (multiple * self.phase).sin();
        once / (w * w) * (tau * psi.cos() - (1.0 + cos) / w * change(1.0))
            + twice / (4.0 * w * w) * (2.0 * tau * (2.0 * psi).cos() - (3.0 + cos) / (2.0 * w) * change(2.0))
            - self.slope_of_mean_torque() * tau.powi(3) * sin * cos / 3.0
    }

    /// # Errors
    /// [`Error::Domain`] for a damping that is not finite, that is above a tenth of the rate of the precession, or that applies to a wobble of a
    /// right angle.
    pub(super) fn check(&self) -> Result<(), Error> {
        let Self { wobble, rate, damping, .. } = *self;
        Error::ensure(damping.is_finite(), "rate of damping of the wobble", damping, "a finite number")?;
        if damping == 0.0 {
            return Ok(());
        }
        let ratio = (damping / rate).abs();
        let allowed = "at most 0.1; a wobble that is damped in a few turns is not a precession";
        Error::ensure(ratio <= MOST_DAMPING, "rate of damping over that of the precession", ratio, allowed)?;
        Error::ensure(
            wobble.cos().abs() > 1e-3,
            "wobble (rad) with damping",
            wobble,
            "other than a right angle; friction has no effect there",
        )
    }

    /// # Errors
    /// [`Error::Domain`] for times of more than two damping times, if the wobble has become so large that it is damped in a few turns, and if it
    /// reaches the angle of the magnetic axis to `n`: on one side of this value the magnetic axis circles `L`, on the other `n`.
    pub(super) fn check_time(&self, tau: f64) -> Result<(), Error> {
        if self.damping == 0.0 {
            return Ok(());
        }
        let damped = self.damping * tau;
        let allowed =
            "at most 2 in size; the model holds while the tangent of the wobble changes by at most a factor e^2";
        Error::ensure(damped.abs() <= MOST_DAMPED, "time times the rate of damping of the wobble", damped, allowed)?;
        let wobble = self.wobble_at(tau);
        let ratio = (self.damping * self.wobble.cos() / (self.rate * wobble.cos())).abs();
        let allowed = "at most 0.1 at all times; the precession is slower where the wobble is larger";
        Error::ensure(ratio <= MOST_DAMPING, "rate of damping over that of the precession", ratio, allowed)?;
        let goes_round = |wobble: f64| [self.chi, PI - self.chi].map(|angle| wobble < angle);
        let allowed =
            "on one side of chi and of pi - chi at all times; at these angles the magnetic axis comes along L";
        Error::ensure(goes_round(wobble) == goes_round(self.wobble), "damped wobble (rad)", wobble, allowed)
    }

    /// A bound on the error of the timing delay over `kappa g` for the damped torque, from the time zero to a stretched time.
    ///
    /// The next terms of the partial integration have coefficients of `y^3` that are polynomials in `u`: at most 1 and 1/2 in the first integral of
    /// `a_1 cos psi` and `a_2 cos 2 psi`, 6 and 1.6 in the second. Those of `y^4` are at most four times as large, and `y` is at most 0.1. The first
    /// integral is exact at the time zero, so that its third order there adds a constant to the rotation.
    pub(super) fn truncation(&self, tau: f64) -> f64 {
        let Self { wobble, chi, rate: w, damping, torque, .. } = *self;
        if damping == 0.0 {
            return 0.0;
        }
        let end = self.wobble_at(tau);
        let largest = if end.sin() > wobble.sin() { end } else { wobble };
        let slowest = w.abs() * (largest.cos() / wobble.cos()).min(1.0);
        let constant = (torque.once.abs() + torque.twice.abs() / 2.0) / w.abs() * (damping / w).abs().powi(3);
        let [once, twice] = [(2.0 * chi).sin().abs() * largest.sin(), (chi.sin() * largest.sin()).powi(2) / 2.0];
        let ends = 2.0 * (6.0 * once + 1.6 * twice) / slowest.powi(2) * (damping / slowest).abs().powi(3);
        1.5 * (constant * tau.abs() + ends)
    }
}
