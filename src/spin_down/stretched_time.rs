//! The time in which a star that slows down moves like one that does not.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::{Precession, TorqueHarmonics};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::Real;

/// Largest fraction of its rotation that a star may lose, times `|n - 2|` for braking indices `n` above 3 or below 1: the series in it then has 32
/// digits after [`TERMS`] terms.
const MOST: f64 = 0.1;

/// Number of terms of the series of time in stretched time.
const TERMS: usize = 30;

/// Maximum number of Newton steps from the time to the stretched time. From an error of 10 % six reach rounding.
const STEPS: usize = 12;

/// Largest ratio of stretched time to time, and of `|ln u|` to `kappa tau`, for the largest loss or gain: 1.06, and a hundredth because of the
/// varying torque.
const MOST_STRETCHED: f64 = 1.1;

/// Largest fraction by which the varying torque may change the rotation within a precession: more would not be a small change of the rotation rate
/// given in the scene.
const MOST_VARYING: f64 = 0.01;

/// The braking law of a star: `d|L|/dt` proportional to `-|L|^n (k_0 + k_1 sin^2 theta_m)`, along `L`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Braking<S = f64> {
    /// `-F1 / F0` at the time zero, averaged over a precession (1 per unit of time).
    pub rate: S,
    /// Braking index `n = F0 F2 / F1^2`: 3 for a dipole.
    pub index: S,
    /// `k_1 / (k_0 + k_1)`, the fraction of the torque that is proportional to `sin^2 theta_m`: 1 for a dipole in vacuum, 1/2 for `k_0 = k_1`, as for
    /// a plasma-filled magnetosphere, 0 for a torque that does not depend on the magnetic axis.
    pub torque_share: S,
}

/// The map between the time `t` and the stretched time `tau` of a star that slows down, `d tau = a dt` with `a = |L| / |L'|`.
///
/// With `kappa` the mean braking rate and `u = (1 + (n - 2) kappa tau)^(1 / (n - 2))`, the secular `1 / a`:
///
/// ```text
/// t = integral of u dtau + Q(tau) - Q(0)
/// Q = -kappa g [u^(3 - n) (a_1 cos psi / w^2 + a_2 cos 2 psi / (4 w^2)) - (3 - n) kappa u^(5 - 2 n) (a_1 sin psi / w^3 + a_2 sin 2 psi / (8 w^3))]
///     + (3 - n) / 2 integral of (kappa P)^2 dtau,    P = g (a_1 sin psi / w + a_2 sin 2 psi / (2 w))
/// ```
///
/// with [`TorqueHarmonics`] `a_0, a_1, a_2`, `psi = psi_0 + w tau`, and `g = q / (1 - q + q a_0)` for the torque fraction `q`. `Q` is the timing
/// delay due to the torque modulation. The rotation in the time `tau`, of the star that does not slow down, is the mean one at the time zero. Exact
/// for `n = 3` without damping; with damping, of a [`Precession`], to second order in `gamma / w`; for another `n` to second order in `kappa`. See
/// [`truncation`](Self::truncation).
#[derive(Debug, Clone, PartialEq)]
pub struct StretchedTime {
    braking: Braking,
    precession: Precession,
    /// `g`.
    modulation: f64,
    /// Coefficients of `t - tau` in powers of `tau`, starting with the second.
    secular: Vec<DoubleDouble>,
}

impl StretchedTime {
    /// The time of a star that does not slow down.
    pub(crate) fn uniform() -> Self {
        let precession = Precession::new([0.0, FRAC_PI_2, 0.0], 0.0, 0.0);
        let braking = Braking { rate: 0.0, index: 3.0, torque_share: 0.0 };
        Self { braking, precession, modulation: 0.0, secular: Vec::new() }
    }

    /// The time of a star that slows down while it precesses.
    ///
    /// # Errors
    /// [`Error::Domain`] for a rate or an index that is not finite, a fraction outside 0 to 1, a torque that vanishes (`q = 1` with the magnetic axis
    /// and `n` along `L`), and one that changes the rotation by more than a hundredth within a precession. For a damping that is not finite, that is
    /// above a tenth of the rate of the precession, that applies to a wobble of a right angle (to 1e-3), or that comes with a braking rate and an
    /// index other than 3.
    pub fn new(braking: &Braking, precession: &Precession) -> Result<Self, Error> {
        let Braking { rate, index, torque_share } = *braking;
        Error::ensure(rate.is_finite(), "braking rate -F1 / F0", rate, "a finite number")?;
        Error::ensure(index.is_finite(), "braking index", index, "a finite number")?;
        let share = "share of the torque with sin^2 theta_m";
        Error::ensure((0.0..=1.0).contains(&torque_share), share, torque_share, "from 0 to 1")?;
        let mean = 1.0 - torque_share + torque_share * precession.torque.constant;
        Error::ensure(mean > 0.0, "mean braking torque", mean, "above zero; the magnetic axis must not stay along L")?;
        let modulation = modulation(torque_share, &precession.torque);
        precession.check()?;
        if precession.damping != 0.0 && rate != 0.0 {
            Error::ensure(index == 3.0, "braking index with a damped wobble", index, "3")?;
        }
        let Precession { torque, rate: w, .. } = *precession;
        if modulation * (torque.once.abs() + torque.twice.abs()) > 0.0 {
            let varying = (rate * modulation * (torque.once.abs() + torque.twice.abs() / 2.0) / w).abs();
            Error::ensure(
                varying <= MOST_VARYING,
                "change of the rotation by the varying torque within a precession",
                varying,
                "at most 0.01; use a shorter period of precession, a smaller F1, or a torque that does not vary",
            )?;
        }
        let mut term = DoubleDouble::from(1.0);
        let mut secular = Vec::new();
        for k in 1..TERMS {
            // c_(k + 1) / (k + 1)!, c_(k + 1) = kappa^k (1 - y)(1 - 2 y)...(1 - (k - 1) y), y = n - 2.
            let factor = DoubleDouble::from(1.0) - DoubleDouble::from(index - 2.0) * ((k - 1) as f64);
            term = term * factor * rate / ((k + 1) as f64);
            if term.high == 0.0 {
                break;
            }
            secular.push(term);
        }
        Ok(Self { braking: *braking, precession: *precession, modulation, secular })
    }

    /// The braking law.
    pub fn braking(&self) -> &Braking {
        &self.braking
    }

    /// The free precession.
    pub fn precession(&self) -> &Precession {
        &self.precession
    }

    /// Whether both times are identical.
    pub(crate) fn is_uniform(&self) -> bool {
        self.secular.is_empty()
    }

    /// The time at a stretched time; both are sums of two doubles.
    pub fn time_at(&self, stretched: [f64; 2]) -> [f64; 2] {
        self.time(stretched.into()).into()
    }

    /// The stretched time at a time given as the sum of two doubles, in any order.
    ///
    /// # Errors
    /// [`Error::Domain`] for times so long that the star loses or gains a tenth of its rotation; for braking indices above 3 or below 1, a tenth over
    /// `|n - 2|`. With damping, for times of more than two damping times, and for those at which the wobble has passed `chi` or `pi - chi`, or is
    /// damped by more than a tenth per radian of the precession.
    pub fn stretched_at(&self, time: [f64; 2]) -> Result<[f64; 2], Error> {
        let wanted = DoubleDouble::from(time);
        if self.is_uniform() {
            self.precession.check_time(wanted.high)?;
            return Ok(wanted.into());
        }
        // The wobble is that of the stretched time, which is at least so long.
        self.precession.check_time(wanted.high / MOST_STRETCHED)?;
        let lost = self.braking.rate * wanted.high * (self.braking.index - 2.0).abs().max(1.0);
        Error::ensure(
            lost.abs() <= MOST,
            "F1 t / F0, times |n - 2| of the braking index n where that is above 1",
            -lost,
            "at most 0.1 in size; the model holds while the rotation slows by at most a tenth",
        )?;
        let mut tau = wanted;
        for _ in 0..STEPS {
            let step = (wanted - self.time(tau)) * self.slowing(tau.high);
            tau += step;
            // Newton's method squares the remaining error.
            if step.high.abs() <= 1e-18 * tau.high.abs() {
                break;
            }
        }
        self.precession.check_time(tau.high)?;
        Ok(tau.into())
    }

    fn time(&self, tau: DoubleDouble) -> DoubleDouble {
        if self.is_uniform() {
            return tau;
        }
        let series = self.secular.iter().rev().fold(DoubleDouble::from(0.0), |sum, term| (sum + *term) * tau);
        tau + series * tau + self.delay(tau.high).into()
    }

    /// Timing delay due to the torque modulation since the time zero, `Q(tau) - Q(0)`.
    pub fn delay(&self, tau: f64) -> f64 {
        torque_delay(&self.braking, &self.precession, tau)
    }

    /// `a = |L| / |L'| = d tau / dt` at a stretched time, from the braking law.
    pub fn slowing(&self, tau: f64) -> f64 {
        slowing(&self.braking, &self.precession, tau)
    }

    /// Spin-down rate `d ln a / dt` relative to that of the mean torque at the time zero: `a^(n - 1) (1 + g (a_1 cos psi + a_2 cos 2 psi))`.
    pub fn braking_over_mean(&self, tau: f64) -> f64 {
        let torque = TorqueHarmonics::new(self.precession.wobble_at(tau), self.precession.chi);
        let psi = self.precession.phase_at(tau);
        let mean = torque.constant - self.precession.torque.constant;
        let varying = self.modulation * (mean + torque.once * psi.cos() + torque.twice * (2.0 * psi).cos());
        self.slowing(tau).powf(self.braking.index - 1.0) * (1.0 + varying)
    }

    /// The effect of errors in the angles of the wobble and of its phase on the timing delay: three times the relative error, which is `error` for a
    /// wobble of a radian and inversely proportional to a smaller wobble, because `a_1` is proportional to the wobble and `a_2` to its square.
    pub(crate) fn error_by_angles(&self, error: f64) -> f64 {
        if self.precession.rate == 0.0 {
            return 0.0;
        }
        3.0 * error * (self.braking.rate * self.modulation / self.precession.rate.powi(2)).abs()
    }

    /// A bound on the error of the map at a time.
    ///
    /// With `y = n - 2` and `s = 1 + y kappa tau` the law is `dt/dtau = (s + y kappa P)^(1 / y)`, and `Q` contains its first two orders in `kappa P`.
    /// It neglects three terms, all proportional to `(1 - y)(1 - 2 y) kappa^3`: the third order, `P^3 / 6`; in the second, the change of `u` since
    /// the time zero, `tau P^2 / 2`; in the first, the integral that remains after two integrations by parts, of a sine over `w^3` times a monotonic
    /// function, below twice its largest value over `w`. With damping, the error of [`Precession`] is added.
    pub fn truncation(&self, t: f64) -> f64 {
        let Braking { rate, index, .. } = self.braking;
        let Precession { torque, rate: w, .. } = self.precession;
        if w == 0.0 {
            return 0.0;
        }
        let (y, tau) = (index - 2.0, MOST_STRETCHED * t.abs());
        let [once, twice] = [torque.once, torque.twice].map(|harmonic| (self.modulation * harmonic / w).abs());
        let largest = once + twice / 2.0;
        // Powers of s + y kappa P along the way.
        let power = (1.0 - 2.0 * y).abs().max((1.0 - 3.0 * y).abs());
        let most = (power * MOST_STRETCHED * rate.abs() * (tau + largest)).exp();
        let left = 2.0 * (once + twice / 16.0) / w.abs().powi(3)
            + largest.powi(2) * tau * (0.25 * MOST_STRETCHED * tau + largest / 6.0);
        let third = ((1.0 - y) * (1.0 - 2.0 * y) * rate.powi(3)).abs() * most * left;
        third + (rate * self.modulation).abs() * self.precession.truncation(MOST_STRETCHED * t)
    }
}

/// `1 / u` at the stretched time, plus the contribution of the varying torque: `a` of [`StretchedTime`].
pub(crate) fn slowing<S: Real>(braking: &Braking<S>, precession: &Precession<S>, tau: S) -> S {
    let Precession { torque, rate: w, .. } = *precession;
    if braking.torque_share.re() == 0.0 && !S::HAS_DERIVATIVES || w.re() == 0.0 {
        return (-ln_slowness(braking, tau)).exp();
    }
    let psi = precession.phase_at(tau);
    let ((sin, cos), (sin_2, cos_2)) = (psi.sin_cos(), (psi * 2.0).sin_cos());
    let varying = if precession.is_undamped() {
        torque.once * sin + torque.twice * sin_2 / 2.0 + precession.slope(|real| real.slope_of_first(tau.re()))
    } else {
        let [a, b, c, d] = precession.damped_torque(tau).once;
        torque.once * (a * sin + b * cos)
            + torque.twice * (c * sin_2 + d * cos_2) / 2.0
            + precession.mean_torque(tau)[0] * w
    };
    (-ln_slowness(braking, tau + modulation(braking.torque_share, &torque) * varying / w)).exp()
}

/// `g = k_1 / (k_0 + k_1 a_0)`.
fn modulation<S: Real>(share: S, torque: &TorqueHarmonics<S>) -> S {
    share / (S::one() - share + share * torque.constant)
}

/// `Q(tau) - Q(0)` of [`StretchedTime`], from differences, so that the rounding is that of the result. At the index 3 it has no derivative with
/// respect to the index.
pub(crate) fn torque_delay<S: Real>(braking: &Braking<S>, precession: &Precession<S>, tau: S) -> S {
    let Braking { rate, index, torque_share } = *braking;
    let Precession { torque, rate: w, phase, .. } = *precession;
    let modulation = modulation(torque_share, &torque);
    if torque_share.re() == 0.0 && !S::HAS_DERIVATIVES || w.re() == 0.0 {
        return S::zero();
    }
    let three_less = S::from_f64(3.0) - index;
    let half = precession.swept(tau, 2.0 * TAU) * 0.5;
    // cos a - cos b = -2 sin((a + b) / 2) sin((a - b) / 2), sin a - sin b = 2 cos((a + b) / 2) sin((a - b) / 2).
    let differences = |multiple: f64| {
        let ((sin, cos), (across, _)) = (((phase + half) * multiple).sin_cos(), (half * multiple).sin_cos());
        [-sin * across * 2.0, cos * across * 2.0]
    };
    let [[cos, sin], [cos_2, sin_2]] = [differences(1.0), differences(2.0)];
    let sum = |once: S, twice: S, divisor: f64| torque.once * once + torque.twice * twice / divisor;
    if index.re() == 3.0 {
        if precession.is_undamped() {
            let by_damping = precession.slope(|real| real.slope_of_second(tau.re()));
            return rate * modulation * (by_damping - sum(cos, cos_2, 4.0) / (w * w));
        }
        // E cos psi - E_0 cos psi_0 = E (cos psi - cos psi_0) + (E - E_0) cos psi_0.
        let [to, from] = [tau, S::zero()].map(|tau| precession.damped_torque(tau).twice);
        let [a, b, c, d] = core::array::from_fn(|i| to[i] - from[i]);
        let ((sin_start, cos_start), (sin_2_start, cos_2_start)) = (phase.sin_cos(), (phase * 2.0).sin_cos());
        let once = to[0] * cos + a * cos_start + to[1] * sin + b * sin_start;
        let twice = to[2] * cos_2 + c * cos_2_start + to[3] * sin_2 + d * sin_2_start;
        return rate * modulation * (precession.mean_torque(tau)[1] - sum(once, twice, 4.0) / (w * w));
    }
    let psi = precession.phase_at(tau);
    let ((sin_psi, cos_psi), (sin_2_psi, cos_2_psi)) = (psi.sin_cos(), (psi * 2.0).sin_cos());
    let ln_u = ln_slowness(braking, tau);
    let fallen = |power: S| exp_less_one(power * ln_u);
    let first = sum(cos, cos_2, 4.0) + fallen(three_less) * sum(cos_psi, cos_2_psi, 4.0);
    let power = S::from_f64(5.0) - index * 2.0;
    let second = sum(sin, sin_2, 8.0) + fallen(power) * sum(sin_psi, sin_2_psi, 8.0);
    // The integral of P^2, with the square of A sin psi + B sin 2 psi as a sum of cosines.
    let [a, b] = [torque.once, torque.twice / 2.0].map(|harmonic| rate * modulation * harmonic / w);
    let [sin_3, sin_4] = [3.0, 4.0].map(|multiple| differences(multiple)[1]);
    let squares =
        (a * a + b * b) * tau * 0.5 + (a * b * (sin - sin_3 / 3.0) - a * a * sin_2 / 4.0 - b * b * sin_4 / 8.0) / w;
    -rate * modulation / (w * w) * (first - three_less * rate / w * second) + three_less * squares * 0.5
}

/// `integral of u dtau - tau`: the secular part of `t - tau`.
pub(crate) fn secular_delay<S: Real>(braking: &Braking<S>, tau: S) -> S {
    let y = braking.index - S::from_f64(2.0);
    let (mut term, mut sum) = (tau, S::zero());
    for k in 1..TERMS {
        term = term * (S::one() - y * (k - 1) as f64) * braking.rate * tau / (k + 1) as f64;
        sum += term;
        if term.re().abs() <= 1e-18 * sum.re().abs() {
            break;
        }
    }
    sum
}

/// `ln u = ln(1 + y kappa tau) / y`, `y = n - 2`, from a series that is also valid for `y = 0`.
fn ln_slowness<S: Real>(braking: &Braking<S>, tau: S) -> S {
    let x = braking.rate * tau;
    let small = x * (braking.index - S::from_f64(2.0));
    x * (1..=terms(small.re(), 18)).rev().fold(S::zero(), |sum, k| S::from_f64(1.0 / k as f64) - small * sum)
}

/// `exp(x) - 1`, accurate to rounding.
pub(super) fn exp_less_one<S: Real>(x: S) -> S {
    if x.re().abs() > 0.5 {
        return x.exp() - S::one();
    }
    (1..=terms(x.re(), 15)).rev().fold(S::zero(), |sum, k| (S::one() + sum) * x / k as f64)
}

/// Number of terms of a power series without large coefficients down to 1e-18 of the first, plus one for its derivatives, up to a maximum.
fn terms(x: f64, most: usize) -> usize {
    let bits = -x.abs().log2();
    if bits > 60.0 { 2 } else { ((60.0 / bits.max(1.0)) as usize + 2).min(most) }
}

/// An angle minus integer multiples of `turn` (rad).
pub(super) fn within<S: Real>(angle: S, turn: f64) -> S {
    let value = angle.re();
    angle - S::from_f64(value - value % turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wobbling(index: f64, rate: f64, share: f64) -> StretchedTime {
        let precession = Precession::new([0.2, 1.3, 0.7], 0.013, 0.0);
        StretchedTime::new(&Braking { rate, index, torque_share: share }, &precession).unwrap()
    }

    #[test]
    fn both_ways_lead_back() {
        for (index, rate, share) in
            [(3.0, 1e-6, 1.0), (2.0, -3e-7, 0.5), (16.0, 1e-8, 1.0), (1.0, 1e-6, 0.0), (2.5, 1e-6, 0.3)]
        {
            let stretched = wobbling(index, rate, share);
            for t in [-9e4, -11.0, 0.0, 3.0, 4.7e4, 9.9e4] {
                let tau = stretched.stretched_at([t, 1e-17 * t]).unwrap();
                let back = DoubleDouble::from(stretched.time_at(tau)) - DoubleDouble::from([t, 1e-17 * t]);
                // The varying part is known to the rounding of a double of its size.
                assert!(back.high.abs() < 1e-16, "{index} {t}: {back:?}");
            }
        }
    }

    /// The slowing is compared with differences of the map, and the law of its rate with a quadrature of the torque.
    #[test]
    fn the_slowing_is_the_rate_of_the_map() {
        for (index, share) in [(3.0, 1.0), (2.0, 0.5), (5.0, 1.0), (1.0, 0.4)] {
            let stretched = wobbling(index, 1e-7, share);
            for tau in [-3e5, 0.0, 20.0, 2.7e5] {
                let h = 1e-3;
                let rate = DoubleDouble::from(stretched.time_at([tau, h])) - stretched.time_at([tau, -h]).into();
                let expected = 2.0 * h / stretched.slowing(tau);
                // The error terms are of relative size (kappa / w)^2 of the varying part, where kappa / w is 1e-5.
                assert!(
                    (rate.high / expected - 1.0).abs() < 3e-14 + 1e-13 * (3.0 - index).abs(),
                    "{index} {tau}: {:e}",
                    rate.high / expected - 1.0
                );
                let torque = |tau: f64| stretched.braking_over_mean(tau);
                let change = (stretched.slowing(tau + 1.0) / stretched.slowing(tau - 1.0)).ln();
                // d ln a / dtau = (d ln a / dt) / a.
                let law = -2.0 * 1e-7 * torque(tau) / stretched.slowing(tau);
                assert!((change / law - 1.0).abs() < 1e-4, "{index} {tau}: {change:e} {law:e}");
            }
        }
    }

    /// As above, for a wobble that is damped or excited, which changes the mean of the torque too.
    #[test]
    fn the_slowing_of_a_damped_star_follows_its_torque() {
        for damping in [1e-6, -1e-6] {
            let precession = Precession::new([0.4, 1.3, 0.7], 0.013, damping);
            let braking = Braking { rate: 1e-7, index: 3.0, torque_share: 0.7 };
            let stretched = StretchedTime::new(&braking, &precession).unwrap();
            for tau in [-3e5, 20.0, 2.7e5] {
                let change = (stretched.slowing(tau + 1.0) / stretched.slowing(tau - 1.0)).ln();
                let law = -2.0 * 1e-7 * stretched.braking_over_mean(tau) / stretched.slowing(tau);
                assert!((change / law - 1.0).abs() < 1e-4, "{damping:e} {tau}: {change:e} {law:e}");
                // The mean of the torque alone changes it by more.
                let mean = TorqueHarmonics::new(precession.wobble_at(tau), 1.3).constant;
                assert!(tau == 20.0 || (mean - precession.torque.constant).abs() > 1e-3, "{mean}");
            }
        }
    }

    /// Reference values from another program, with rates of either sign.
    #[test]
    fn what_is_left_out() {
        let star = |index: f64, wobble: f64, rate: f64, damping: f64| {
            let precession = Precession::new([wobble, 1.3, 0.7], rate, damping);
            StretchedTime::new(&Braking { rate: -1e-6, index, torque_share: 0.6 }, &precession).unwrap()
        };
        let close =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-11, "{found:e} {expected:e}");
        close(star(4.5, 0.4, -0.013, 0.0).truncation(-2e3), 1.041904500874e-09);
        close(star(2.2, 0.4, -0.013, 0.0).truncation(-2e3), 8.216483130107e-11);
        close(star(3.0, 0.4, -0.013, -2e-4).truncation(-2e3), 1.87931794971e-07);
        close(star(3.0, 0.4, -0.013, -2e-4).truncation(2e3), 2.637947462964e-07);
        // The bound is proportional to a time squared: with all rates halved it is four times as large.
        for sign in [1.0, -1.0] {
            let bound = |damping: f64| {
                Precession::new([0.4, 1.3, 0.7], 100.0 * damping, sign * damping).truncation(0.3 / damping)
            };
            close(bound(0.5), 4.0 * bound(1.0));
        }
        close(star(4.5, 0.4, -0.013, 0.0).error_by_angles(0.25), 2.890057624900e-3);
        // A star that does not precess.
        let still = star(4.5, 0.0, 0.0, 0.0);
        assert_eq!([still.truncation(1e4), still.error_by_angles(0.25)], [0.0; 2]);
    }

    /// A wobble that friction raises close to a right angle, where the precession becomes slow, is refused from then on.
    #[test]
    fn a_wobble_that_is_damped_in_a_few_turns_at_a_later_time_is_refused_there() {
        let precession = Precession::new([1.4, 0.2, 0.7], 0.013, -3e-4);
        let raised = StretchedTime::new(&Braking { rate: 0.0, index: 3.0, torque_share: 0.0 }, &precession).unwrap();
        assert!(raised.stretched_at([3000.0, 0.0]).is_ok());
        let Err(Error::Domain { quantity, value, .. }) = raised.stretched_at([5000.0, 0.0]) else { panic!("taken") };
        // tan theta is e^1.5 times as large.
        let expected = 3e-4 / 0.013 * 1.4_f64.cos() * (1.4_f64.tan() * 1.5_f64.exp()).hypot(1.0);
        assert!(quantity.contains("damping over") && (value / expected - 1.0).abs() < 1e-12, "{quantity} {value}");
    }

    /// `((1 + y kappa tau)^(1 + 1 / y) - 1) / (kappa (1 + y)) - tau`, `y = n - 2`.
    #[test]
    fn the_secular_part_is_an_integral() {
        for (rate, index) in [(1e-6_f64, 2.5), (-1e-6, 2.5), (1e-6, 5.0), (-1e-6, 1.0)] {
            let (y, tau) = (index - 2.0, 9e4);
            let expected = ((1.0 + y * rate * tau).powf(1.0 + 1.0 / y) - 1.0) / (rate * (1.0 + y)) - tau;
            let expected = if y == -1.0 { -(1.0 - rate * tau).ln() / rate - tau } else { expected };
            for unit in [1.0, 1e12, 1e-12] {
                let braking = Braking { rate: rate / unit, index, torque_share: 0.0 };
                let found = secular_delay(&braking, tau * unit) / unit;
                assert!((found / expected - 1.0).abs() < 1e-13, "{rate} {index} {unit:e}: {found:e} {expected:e}");
            }
        }
    }

    /// `t = tau + kappa tau^2 / 2` for a dipole, and the exponential for the index 2.
    #[test]
    fn known_series() {
        let dipole = wobbling(3.0, 1e-6, 0.0);
        assert_eq!(dipole.secular.len(), 1);
        assert_eq!(dipole.time_at([8e4, 0.0])[0], 8e4 + 0.5e-6 * 8e4 * 8e4);
        let exponential = wobbling(2.0, 1e-6, 0.0);
        assert!((exponential.time_at([8e4, 0.0])[0] / (0.08_f64.exp_m1() * 1e6) - 1.0).abs() < 1e-15);
        // Frequency and its derivatives: F2 = n F1^2 / F0.
        let found = wobbling(4.5, 1e-6, 0.0);
        let nu = |t: f64| found.slowing(found.stretched_at([t, 0.0]).unwrap()[0]);
        let second = (nu(300.0) - 2.0 * nu(0.0) + nu(-300.0)) / 9e4;
        assert!((second / 4.5e-12 - 1.0).abs() < 1e-3, "{second:e}");
    }

    /// Over a small part of a slow precession the timing delay is `kappa g` times half the square of time and the difference of the torque from its
    /// mean, minus the advance of the rotation at the start; computed from the Taylor series.
    #[test]
    fn a_short_time_has_a_small_delay() {
        let torque = TorqueHarmonics::new(0.2, 1.3);
        let (phase, w, kappa) = (0.7_f64, 1e-6, 1e-12);
        let braking = Braking { rate: kappa, index: 3.0, torque_share: 1.0 };
        let precession = |rate: f64| Precession::new([0.2, 1.3, phase], rate, 0.0);
        let stretched = StretchedTime::new(&braking, &precession(w)).unwrap();
        let g = 1.0 / torque.constant;
        let rate = kappa * g * (torque.once * phase.sin() + torque.twice * (2.0 * phase).sin() / 2.0) / w;
        let second = kappa * g * (torque.once * phase.cos() + torque.twice * (2.0 * phase).cos());
        for tau in [1e-3, 1.0, 1e2] {
            let expected = tau * (rate + 0.5 * second * tau);
            assert!((stretched.delay(tau) / expected - 1.0).abs() < 1e-8, "{tau}");
        }
        assert!(StretchedTime::new(&braking, &precession(1e-13)).is_err());
    }

    /// A star may lose a tenth of its rotation, with a braking index about 2 as with any other up to 3.
    #[test]
    fn a_tenth_of_the_rotation_is_the_most_for_every_index() {
        for index in [1.5, 2.0, 2.1, 3.0] {
            let is_taken = |t: f64| wobbling(index, 1e-6, 0.0).stretched_at([t, 0.0]).is_ok();
            assert_eq!(
                [9.9e4, -9.9e4, 1.01e5, -1.01e5, 3e5].map(is_taken),
                [true, true, false, false, false],
                "{index}"
            );
        }
    }

    /// A wobble of 75 degrees falls to 70 after ln(tan 75 / tan 70) = ln(3.7321 / 2.7475) = 0.3063 damping times, to 65 after 0.5540. A magnetic
    /// axis at 110 degrees from n has its other end at 70, which comes along L as well.
    #[test]
    fn a_wobble_that_passes_the_magnetic_axis_at_either_end_is_refused() {
        for (chi, limit) in [(70.0_f64, 0.306_3), (110.0, 0.306_3), (65.0, 0.554_0), (115.0, 0.554_0)] {
            let precession = Precession::new([75f64.to_radians(), chi.to_radians(), 0.7], 0.013, 1e-5);
            let braking = Braking { rate: 0.0, index: 3.0, torque_share: 0.0 };
            let damped = StretchedTime::new(&braking, &precession).unwrap();
            let is_taken = |part: f64| damped.stretched_at([part * limit * 1e5, 0.0]).is_ok();
            assert_eq!([0.0, 0.99, 1.01].map(is_taken), [true, true, false], "{chi}");
        }
    }

    /// A wobble is followed for two damping times of the stretched time, `t = tau + kappa tau^2 / 2`. For a star that slows down this is a longer
    /// time `t`, for one that spins up a shorter one.
    #[test]
    fn two_damping_times_are_of_the_stretched_time() {
        let precession = Precession::new([0.2, 1.3, 0.7], 0.013, 1e-5);
        for rate in [4e-7, -4e-7] {
            let star = StretchedTime::new(&Braking { rate, index: 3.0, torque_share: 0.0 }, &precession).unwrap();
            let limit = 2e5 + rate * 2e10;
            assert_eq!([0.999, 1.001].map(|part| star.stretched_at([part * limit, 0.0]).is_ok()), [true, false]);
        }
    }

    /// The delay grows in proportion to a small share of the torque: its derivative at a share of zero is that proportion.
    #[test]
    fn the_delay_has_a_derivative_by_the_share_where_that_is_zero() {
        use num_dual::Dual64;
        for index in [3.0, 2.5] {
            let constant = Dual64::from_re;
            let precession = Precession::new([0.2, 1.3, 0.7].map(constant), constant(0.013), constant(0.0));
            let share = Dual64::new(0.0, 1.0);
            let braking = Braking { rate: constant(1e-6), index: constant(index), torque_share: share };
            let slope = torque_delay(&braking, &precession, constant(100.0)).eps;
            let precession = Precession::new([0.2, 1.3, 0.7], 0.013, 0.0);
            let braking = Braking { rate: 1e-6, index, torque_share: 1e-6 };
            let expected = torque_delay(&braking, &precession, 100.0) / 1e-6;
            assert!(expected.abs() > 1e-6 && (slope / expected - 1.0).abs() < 1e-4, "{index}: {slope:e} {expected:e}");
        }
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let precession = Precession::new([0.0; 3], 1.0, 0.0);
        let braking = Braking { rate: 1e-6, index: 3.0, torque_share: 1.0 };
        let refused = |braking: Braking| StretchedTime::new(&braking, &precession).is_err();
        assert!(refused(braking) && !refused(Braking { torque_share: 0.9, ..braking }));
        for wrong in [f64::NAN, -0.1, 1.1] {
            assert!(refused(Braking { torque_share: wrong, ..braking }));
        }
        assert!(refused(Braking { rate: f64::NAN, torque_share: 0.0, ..braking }));
        assert!(refused(Braking { index: f64::INFINITY, torque_share: 0.0, ..braking }));
        let stretched = wobbling(3.0, 1e-6, 1.0);
        assert!(stretched.stretched_at([1.01e5, 0.0]).is_err() && stretched.stretched_at([0.99e5, 0.0]).is_ok());
    }
}
