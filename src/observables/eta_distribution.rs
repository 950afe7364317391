//! Distribution of `eta` of Eq. (41) `[est1]` over directions to the observer and over unknown orientations of the spin axis.
//!
//! ```
//! use twofold::observables::eta_distribution::{EtaDistribution, SpinAxis, root_mean_square_along_motion};
//!
//! // One speed: eta is uniform in 1/eta.
//! let one = EtaDistribution::from_speeds([(0.5, 1.0)])?;
//! assert!((one.probability_above(4.0) - 0.5).abs() < 1e-15 && (one.quantile(0.5)? - 4.0).abs() < 1e-12);
//! assert!(EtaDistribution::new(0.0, SpinAxis::Unknown)?.quantile(0.9)? > 10.0);
//! // Seen at a right angle to the spin axis: one azimuth in two is within 45 degrees of the motion.
//! let seen = one.clone().seen_at(core::f64::consts::FRAC_PI_2)?;
//! assert!((seen.quantile(0.5)? - 2.0 * 2.0_f64.sqrt()).abs() < 1e-12);
//! let beta = 0.7_f64;
//! assert!((root_mean_square_along_motion(0.0, beta) - 3.0_f64.sqrt() / (beta.sin() * beta.cos())).abs() < 1e-9);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use super::eta::{single_precession_start, squared_speed, squared_speed_along_motion};
use crate::error::Error;

/// Number of nodes of the averages over one variable.
const NODES: usize = 256;

/// Distribution of `eta = 1 / |n-hat . v|` over directions `n-hat` to the observer, for a spin axis that moves with one of
/// several mean velocities `v`, each with a weight; units as in [`eta`](super::eta).
///
/// Directions are isotropic, or with [`seen_at`](Self::seen_at) those at a known angle to the spin axis. The component of a
/// fixed vector in an isotropic direction is uniform, so that `P(eta > x) = sum of w min(1, 1 / (|v| x))`. Only a sum over the
/// speeds remains, and quantiles are exact for them. The tail falls as `1/x`: `eta` has no mean, and a bound at the confidence
/// `q` grows as `1 / (1 - q)`.
#[derive(Debug, Clone, PartialEq)]
pub struct EtaDistribution {
    /// `1 / |v|` in descending order with weights that sum to one.
    inverse_speeds: Vec<(f64, f64)>,
    directions: Directions,
}

/// The directions to the observer that are averaged over.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Directions {
    /// All directions, isotropic.
    Isotropic,
    /// Those at an angle to the spin axis, given by its sine; every azimuth is equally probable.
    OnCone { sine: f64 },
}

/// The known properties of the spin axis of a star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpinAxis {
    /// Its inclination `beta` (rad) to Z; the azimuth is random. Random azimuths correspond to random times as well, because the secular motion
    /// preserves areas on the sphere of directions.
    AtInclination(f64),
    /// The constant `beta_0` (rad) of a single precession by Eq. (34) `[integraltoinitial]` with a random constant `alpha_0` and `A = 0`. The
    /// inclination itself then differs from it; see [`single_precession_start`].
    AtConstant(f64),
    /// Nothing is known: every direction is equally probable.
    Unknown,
}

impl EtaDistribution {
    /// From speeds and their weights, which need not sum to one.
    ///
    /// # Errors
    /// [`Error::Domain`] for a speed or weight that is negative or not finite, and for weights that sum to zero.
    pub fn from_speeds(speeds: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, Error> {
        let mut inverse_speeds = Vec::new();
        for (speed, weight) in speeds {
            let allowed = "finite and not negative";
            Error::ensure((0.0..f64::INFINITY).contains(&speed), "speed of the spin axis", speed, allowed)?;
            Error::ensure((0.0..f64::INFINITY).contains(&weight), "weight", weight, allowed)?;
            inverse_speeds.push((1.0 / speed, weight));
        }
        let total: f64 = inverse_speeds.iter().map(|(_, weight)| weight).sum();
        Error::ensure(total > 0.0 && total.is_finite(), "sum of the weights", total, "above zero")?;
        inverse_speeds.iter_mut().for_each(|(_, weight)| *weight /= total);
        inverse_speeds.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(Self { inverse_speeds, directions: Directions::Isotropic })
    }

    /// The distribution for the same spin axes if the direction to the observer is at the known angle `lambda` (rad) to the
    /// spin axis, or at `pi - lambda`; every azimuth of that direction about the spin axis is equally probable.
    ///
    /// The axis moves perpendicular to itself: with the azimuth `psi` counted from `v`, `n-hat . v = |v| sin(lambda) cos(psi)`, and
    ///
    /// ```text
    /// P(eta > x) = sum of w (2/pi) asin min(1, 1 / (|v| sin(lambda) x))
    /// ```
    ///
    /// # Errors
    /// [`Error::Domain`] for an angle whose sine is not above 2.2e-16: there the axis moves across the line of sight, and `cos lambda` does not change.
    pub fn seen_at(self, lambda: f64) -> Result<Self, Error> {
        let sine = lambda.sin();
        let allowed = "above 2.2e-16 in size; a motion across the line of sight cannot be seen";
        Error::ensure(sine.abs() > f64::EPSILON, "sine of the angle to the line of sight", sine, allowed)?;
        Ok(Self { directions: Directions::OnCone { sine: sine.abs() }, ..self })
    }

    /// The distribution for the known properties of the spin axis and the asymmetry ratio `r`.
    ///
    /// # Errors
    /// [`Error::Domain`] for numbers that are not finite, and where Eq. (34) gives an inclination outside `[0, pi]` for some `alpha_0`.
    pub fn new(asymmetry_ratio: f64, axis: SpinAxis) -> Result<Self, Error> {
        let speed = |alpha, beta| squared_speed(asymmetry_ratio, alpha, beta).sqrt();
        match axis {
            SpinAxis::AtInclination(beta) => {
                Self::from_speeds(quarter_turn().map(|(alpha, weight)| (speed(alpha, beta), weight)))
            }
            SpinAxis::AtConstant(beta_0) => {
                let allowed = "from 0 to pi; the perturbation solution does not describe such a motion";
                let mut speeds = Vec::with_capacity(NODES);
                for (alpha_0, weight) in quarter_turn() {
                    let (alpha, beta) = single_precession_start(asymmetry_ratio, alpha_0, beta_0);
                    let is_inclination = (0.0..=core::f64::consts::PI).contains(&beta);
                    Error::ensure(is_inclination, "inclination by Eq. (34)", beta, allowed)?;
                    speeds.push((speed(alpha, beta), weight));
                }
                Self::from_speeds(speeds)
            }
            SpinAxis::Unknown => {
                // More nodes near the equator and the pole, where the axis is slow. With an axis of symmetry all azimuths are equivalent and
                // do not smooth the corner of the probability at their speed.
                let (latitudes, count) = if asymmetry_ratio == 0.0 { (64 * NODES, 1) } else { (NODES, NODES) };
                Self::from_speeds(nodes(latitudes).flat_map(|(latitude, node_weight)| {
                    let (beta, band) = (FRAC_PI_2 - latitude, node_weight * latitude.cos());
                    // The probability has corners, across which other weights bring no improvement.
                    let azimuths = midpoints(NODES).map(|u| (FRAC_PI_2 * u * u * (3.0 - 2.0 * u), u * (1.0 - u)));
                    azimuths.take(count).map(move |(alpha, weight)| (speed(alpha, beta), weight * band))
                }))
            }
        }
    }

    /// `eta` for the root mean square of `d cos lambda / dt`. At one inclination and for isotropic directions it is
    /// [`root_mean_square_eta`](super::eta::root_mean_square_eta).
    pub fn root_mean_square(&self) -> f64 {
        let squared_speed: f64 = self.inverse_speeds.iter().map(|(inverse, weight)| weight / (inverse * inverse)).sum();
        // Mean of the squared component along the line of sight, divided by that of the speed: 1/3, or sin^2(lambda) / 2.
        match self.directions {
            Directions::Isotropic => (3.0 / squared_speed).sqrt(),
            Directions::OnCone { sine } => (2.0 / squared_speed).sqrt() / sine,
        }
    }

    /// Probability that `eta` is above `x > 0`.
    pub fn probability_above(&self, x: f64) -> f64 {
        let speeds = self.inverse_speeds.iter();
        match self.directions {
            Directions::Isotropic => speeds.map(|(inverse, weight)| weight * (inverse / x).min(1.0)).sum(),
            Directions::OnCone { sine } => {
                FRAC_2_PI * speeds.map(|(inverse, weight)| weight * (inverse / (sine * x)).min(1.0).asin()).sum::<f64>()
            }
        }
    }

    /// The value that `eta` does not exceed with the given probability. With it Eq. (41) is a bound at that confidence, as
    /// far as directions are concerned.
    ///
    /// # Errors
    /// [`Error::Domain`] for a probability outside (0, 1).
    pub fn quantile(&self, probability: f64) -> Result<f64, Error> {
        Error::ensure(0.0 < probability && probability < 1.0, "probability", probability, "above 0 and below 1")?;
        let isotropic = self.isotropic_quantile(probability);
        let Directions::OnCone { sine } = self.directions else { return Ok(isotropic) };
        // Since (2/pi) asin(u) <= u, eta sin(lambda) is at most the quantile of isotropic directions; it is never below 1 / (fastest speed).
        let (fastest, _) = self.inverse_speeds[self.inverse_speeds.len() - 1];
        let (mut low, mut high) = (fastest / sine, isotropic / sine);
        while high.is_finite() {
            let middle = (low + high) / 2.0;
            if middle <= low || middle >= high {
                break;
            }
            *(if self.probability_above(middle) > 1.0 - probability { &mut low } else { &mut high }) = middle;
        }
        Ok(high)
    }

    /// The quantile for isotropic directions, in closed form.
    fn isotropic_quantile(&self, probability: f64) -> f64 {
        // With the k slowest speeds below 1/x: 1 - q = (their weights) + (sum of w/|v| of the others) / x, solved for x. The
        // sums start at the fast end, where the terms are small.
        let mut others = vec![0.0; self.inverse_speeds.len() + 1];
        for (k, &(inverse, weight)) in self.inverse_speeds.iter().enumerate().rev() {
            others[k] = others[k + 1] + inverse * weight;
        }
        let mut slower = 0.0;
        for (&(inverse, weight), sum) in self.inverse_speeds.iter().zip(others) {
            let share = 1.0 - probability - slower;
            let eta = sum / share;
            if share > 0.0 && eta.is_finite() && eta >= inverse {
                return eta;
            }
            slower += weight;
        }
        // More than a fraction 1 - q of the speeds are zero.
        f64::INFINITY
    }
}

/// `eta` for the root mean square of `d cos lambda / dt` over isotropic directions, over the azimuth of the spin axis at the
/// inclination `beta` (rad), and over all later times of each such motion; asymmetry ratio `r`.
///
/// It differs from [`root_mean_square_eta`](super::eta::root_mean_square_eta) since the inclination changes along the motion. Error: some 1e-12,
/// also across the separatrix.
pub fn root_mean_square_along_motion(asymmetry_ratio: f64, beta: f64) -> f64 {
    let nodes = about(separatrix(asymmetry_ratio, beta))
        .map(|(alpha, weight)| (squared_speed_along_motion(asymmetry_ratio, alpha, beta), weight));
    let (sum, total) = nodes.fold((0.0, 0.0), |(sum, total), (v2, weight)| (sum + v2 * weight, total + weight));
    (3.0 * total / sum).sqrt()
}

/// The azimuth in the first quarter turn where `h = l.(s l)` equals the middle principal value, or the nearest end of the quarter turn.
/// It follows from `h`, which is linear in the squared sine of the azimuth.
fn separatrix(asymmetry_ratio: f64, beta: f64) -> f64 {
    let half = asymmetry_ratio / 2.0;
    let [_, middle, _] = {
        let mut values = [half, -half, 0.5];
        values.sort_by(f64::total_cmp);
        values
    };
    let (sin, cos) = beta.sin_cos();
    // `h` along Y and along X, with the middle value subtracted.
    let [along_y, along_x] = [-half, half].map(|value| (value - middle) * sin * sin + (0.5 - middle) * cos * cos);
    let squared_sine = along_y / (along_y - along_x);
    if squared_sine.is_nan() { 0.0 } else { squared_sine.clamp(0.0, 1.0).sqrt().asin() }
}

fn midpoints(nodes: usize) -> impl Iterator<Item = f64> {
    (0..nodes).map(move |i| (i as f64 + 0.5) / nodes as f64)
}

/// Angles with weights over a quarter turn, with more nodes at its ends, where an axis near the equator is slow. The weight has a double zero there,
/// so that smooth functions are averaged to the fourth order.
fn nodes(count: usize) -> impl Iterator<Item = (f64, f64)> {
    midpoints(count).map(|u| (FRAC_PI_2 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u), (u * (1.0 - u)).powi(2)))
}

/// Azimuths with weights; speeds are the same in the other quarter turns.
fn quarter_turn() -> impl Iterator<Item = (f64, f64)> {
    nodes(NODES)
}

/// As `quarter_turn`, for a function with an inverse-logarithmic singularity at `edge`: on both sides the nodes approach it double-exponentially.
fn about(edge: f64) -> impl Iterator<Item = (f64, f64)> {
    // Beyond this the weights are below 1e-16 of the largest.
    const LAST: f64 = 3.2;
    [0.0, FRAC_PI_2].into_iter().flat_map(move |end| {
        midpoints(NODES).map(move |u| {
            let x = LAST * (2.0 * u - 1.0);
            let [near, far] = [1.0, -1.0].map(|sign| 1.0 / (1.0 + (sign * PI * x.sinh()).exp()));
            (edge + (end - edge) * near, (end - edge).abs() * near * far * x.cosh())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_speed_has_the_quantiles_of_a_uniform_component() {
        let one = EtaDistribution::from_speeds([(0.5, 1.0)]).unwrap();
        for (probability, eta) in [(0.5, 4.0), (0.84, 12.5), (0.975, 80.0)] {
            assert!((one.quantile(probability).unwrap() / eta - 1.0).abs() < 1e-14);
            assert!((one.probability_above(eta) - (1.0 - probability)).abs() < 1e-15);
        }
        assert!((one.root_mean_square() - 12f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn an_axis_at_rest_bounds_nothing() {
        let half = EtaDistribution::from_speeds([(0.0, 1.0), (1.0, 1.0)]).unwrap();
        assert!((half.quantile(0.25).unwrap() - 2.0).abs() < 1e-14);
        assert_eq!(half.quantile(0.6).unwrap(), f64::INFINITY);
        assert_eq!(EtaDistribution::from_speeds([(0.0, 1.0)]).unwrap().quantile(0.5).unwrap(), f64::INFINITY);
    }

    /// `eta |v| sin(lambda) = 1 / |cos psi|` with a uniform `psi`: the quantile `1 / cos(q pi/2)` follows by inversion.
    #[test]
    fn at_a_known_angle_the_azimuth_alone_is_random() {
        for lambda in [0.3_f64, 1.7, -0.3, 4.0] {
            let sine = lambda.sin().abs();
            let one = EtaDistribution::from_speeds([(0.5, 1.0)]).unwrap().seen_at(lambda).unwrap();
            for probability in [0.05, 0.5, 0.95] {
                let expected = 2.0 / (sine * ((1.0 - probability) * FRAC_PI_2).sin());
                assert!((one.quantile(probability).unwrap() / expected - 1.0).abs() < 1e-13, "{lambda} {probability}");
            }
            assert!((one.root_mean_square() * 0.5 * sine - 2f64.sqrt()).abs() < 1e-14);
        }
    }

    /// Reference values from ball arithmetic (`verify/oracles/certified/eta.py`): cases without an azimuth on the separatrix, with some,
    /// and with one at the end of the quarter turn.
    #[test]
    fn the_mean_along_the_motion_is_right_across_the_separatrix() {
        for (ratio, beta, expected) in [
            (-1.0 / 11.0, 0.7, 3.52497006940196),
            (-1.0 / 11.0, 1.5, 8.92169934077),
            (-1.0 / 11.0, FRAC_PI_2, 9.16710397024),
            (-1.0 / 3.0, 1.1, 3.79513904504),
        ] {
            let found = root_mean_square_along_motion(ratio, beta);
            assert!((found / expected - 1.0).abs() < 1e-10, "{ratio} {beta}: {found}");
            // X and Y interchanged.
            assert!((root_mean_square_along_motion(-ratio, beta) / found - 1.0).abs() < 1e-12, "{ratio} {beta}");
        }
    }

    #[test]
    fn what_is_out_of_domain_is_refused() {
        assert!(EtaDistribution::from_speeds([]).is_err());
        assert!(EtaDistribution::from_speeds([(f64::NAN, 1.0)]).is_err());
        assert!(EtaDistribution::from_speeds([(1.0, -1.0)]).is_err());
        assert!(EtaDistribution::new(f64::INFINITY, SpinAxis::AtInclination(1.0)).is_err());
        assert!(EtaDistribution::new(-1.0 / 11.0, SpinAxis::AtConstant(1.56)).is_err());
        let some = EtaDistribution::new(0.0, SpinAxis::Unknown).unwrap();
        assert!(some.clone().seen_at(0.0).is_err() && some.clone().seen_at(f64::NAN).is_err());
        for probability in [0.0, 1.0, f64::NAN] {
            assert!(some.quantile(probability).is_err());
        }
    }
}
