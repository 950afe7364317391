//! How `eta` of Eq. (41) `[est1]` is distributed over observers and over what is not known of the spin axis.
//!
//! # Example
//!
//! ```
//! use twofold::observables::eta_distribution::{EtaDistribution, root_mean_square_along_motion};
//!
//! // One speed: eta is uniform in 1/eta.
//! let one = EtaDistribution::from_speeds([(0.5, 1.0)])?;
//! assert!((one.probability_above(4.0) - 0.5).abs() < 1e-15 && (one.quantile(0.5)? - 4.0).abs() < 1e-12);
//! assert!(EtaDistribution::of_unknown_axis(0.0)?.quantile(0.9)? > 10.0);
//! let beta = 0.7_f64;
//! assert!((root_mean_square_along_motion(0.0, beta) - 3.0_f64.sqrt() / (beta.sin() * beta.cos())).abs() < 1e-9);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::FRAC_PI_2;

use super::eta::{single_precession_start, squared_speed, squared_speed_along_motion};
use crate::error::Error;

/// Nodes of the averages over one variable.
const NODES: usize = 256;

/// Distribution of `eta = 1 / |n-hat . v|` over isotropic directions `n-hat` to the observer, for a spin axis that moves with
/// one of several mean velocities `v`, each with a weight; units as in [`eta`](super::eta).
///
/// The component of a fixed vector in a random direction is uniform, so that
/// `P(eta > x) = sum of w min(1, 1 / (|v| x))`: a sum over the speeds is left, and quantiles are exact for them. The tail
/// falls as `1/x`: `eta` has no mean, and a bound at the confidence `q` grows as `1 / (1 - q)`.
#[derive(Debug, Clone, PartialEq)]
pub struct EtaDistribution {
    /// `1 / |v|` in descending order with weights that add up to one.
    inverse_speeds: Vec<(f64, f64)>,
}

impl EtaDistribution {
    /// From speeds and their weights, which need not add up to one.
    ///
    /// # Errors
    /// [`Error::Domain`] for a speed or weight that is negative or not finite, and for weights that add up to zero.
    pub fn from_speeds(speeds: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, Error> {
        let mut inverse_speeds = Vec::new();
        for (speed, weight) in speeds {
            for (value, quantity) in [(speed, "speed of the spin axis"), (weight, "weight of a speed")] {
                Error::unless((0.0..f64::INFINITY).contains(&value), quantity, value, "finite and not negative")?;
            }
            inverse_speeds.push((1.0 / speed, weight));
        }
        let total: f64 = inverse_speeds.iter().map(|(_, weight)| weight).sum();
        Error::unless(total > 0.0 && total.is_finite(), "sum of the weights", total, "above zero")?;
        inverse_speeds.iter_mut().for_each(|(_, weight)| *weight /= total);
        inverse_speeds.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(Self { inverse_speeds })
    }

    /// For a spin axis at the inclination `beta` (rad) to Z and a random azimuth, asymmetry ratio `r`.
    ///
    /// Random azimuths are those of a random time too: the secular motion keeps areas on the sphere of directions.
    ///
    /// # Errors
    /// [`Error::Domain`] for arguments that are not finite.
    pub fn at_inclination(asymmetry_ratio: f64, beta: f64) -> Result<Self, Error> {
        Self::from_speeds(
            quarter_turn().map(|(alpha, weight)| (squared_speed(asymmetry_ratio, alpha, beta).sqrt(), weight)),
        )
    }

    /// For the start of a single precession with the constant `beta_0` (rad) of Eq. (34) `[integraltoinitial]`, a random
    /// constant `alpha_0` and `A = 0`: the inclination itself is then another,
    /// [`single_precession_start`].
    ///
    /// # Errors
    /// [`Error::Domain`] where Eq. (34) gives an inclination outside `[0, pi]` for some `alpha_0`.
    pub fn at_constant(asymmetry_ratio: f64, beta_0: f64) -> Result<Self, Error> {
        let allowed = "from 0 to pi: the perturbation solution does not describe such a motion";
        let mut speeds = Vec::with_capacity(NODES);
        for (alpha_0, weight) in quarter_turn() {
            let (alpha, beta) = single_precession_start(asymmetry_ratio, alpha_0, beta_0);
            Error::unless((0.0..=core::f64::consts::PI).contains(&beta), "inclination by Eq. (34)", beta, allowed)?;
            speeds.push((squared_speed(asymmetry_ratio, alpha, beta).sqrt(), weight));
        }
        Self::from_speeds(speeds)
    }

    /// For a spin axis of which nothing is known: every direction is as probable.
    ///
    /// # Errors
    /// [`Error::Domain`] for a ratio that is not finite.
    pub fn of_unknown_axis(asymmetry_ratio: f64) -> Result<Self, Error> {
        // More nodes near the equator, where the axis is slow.
        let latitudes = midpoints().map(|u| (FRAC_PI_2 * u * u * u, u * u));
        Self::from_speeds(latitudes.flat_map(|(latitude, node_weight)| {
            let (beta, band) = (FRAC_PI_2 - latitude, node_weight * latitude.cos());
            quarter_turn()
                .map(move |(alpha, weight)| (squared_speed(asymmetry_ratio, alpha, beta).sqrt(), weight * band))
        }))
    }

    /// `eta` for the root mean square of `d cos lambda / dt`. At one inclination it is
    /// [`root_mean_square_eta`](super::eta::root_mean_square_eta).
    pub fn root_mean_square(&self) -> f64 {
        let squared_rate: f64 = self.inverse_speeds.iter().map(|(inverse, weight)| weight / (inverse * inverse)).sum();
        (3.0 / squared_rate).sqrt()
    }

    /// Probability that `eta` is above `x > 0`.
    pub fn probability_above(&self, x: f64) -> f64 {
        self.inverse_speeds.iter().map(|(inverse, weight)| weight * (inverse / x).min(1.0)).sum()
    }

    /// The number that `eta` does not exceed with the given probability: with it Eq. (41) is a bound at that confidence, as
    /// far as directions go.
    ///
    /// # Errors
    /// [`Error::Domain`] for a probability outside (0, 1).
    pub fn quantile(&self, probability: f64) -> Result<f64, Error> {
        Error::unless(0.0 < probability && probability < 1.0, "probability", probability, "in (0, 1)")?;
        // With the k slowest speeds below 1/x: 1 - q = (their weights) + (sum of w/|v| of the others) / x, solved for x. The
        // sums start from the fast end, where the terms are small.
        let mut others = vec![0.0; self.inverse_speeds.len() + 1];
        for (k, &(inverse, weight)) in self.inverse_speeds.iter().enumerate().rev() {
            others[k] = others[k + 1] + inverse * weight;
        }
        let mut slower = 0.0;
        for (&(inverse, weight), sum) in self.inverse_speeds.iter().zip(others) {
            let eta = sum / (1.0 - probability - slower);
            if eta.is_finite() && eta >= inverse {
                return Ok(eta);
            }
            slower += weight;
        }
        // More than a share of 1 - q of the speeds are zero.
        Ok(f64::INFINITY)
    }
}

/// `eta` for the root mean square of `d cos lambda / dt` over isotropic directions, over the azimuth of the spin axis at the
/// inclination `beta` (rad), and over all later times of each such motion; asymmetry ratio `r`.
///
/// It differs from [`root_mean_square_eta`](super::eta::root_mean_square_eta) since the inclination changes along the motion.
pub fn root_mean_square_along_motion(asymmetry_ratio: f64, beta: f64) -> f64 {
    let nodes =
        quarter_turn().map(|(alpha, weight)| (squared_speed_along_motion(asymmetry_ratio, alpha, beta), weight));
    let (sum, total) = nodes.fold((0.0, 0.0), |(sum, total), (v2, weight)| (sum + v2 * weight, total + weight));
    (3.0 * total / sum).sqrt()
}

fn midpoints() -> impl Iterator<Item = f64> {
    (0..NODES).map(|i| (i as f64 + 0.5) / NODES as f64)
}

/// Azimuths with weights over a quarter turn; speeds are the same in the others. More nodes at its ends, where an axis near the
/// equator is slow.
fn quarter_turn() -> impl Iterator<Item = (f64, f64)> {
    midpoints().map(|u| (FRAC_PI_2 * u * u * (3.0 - 2.0 * u), u * (1.0 - u)))
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

    #[test]
    fn what_is_out_of_domain_is_refused() {
        assert!(EtaDistribution::from_speeds([]).is_err());
        assert!(EtaDistribution::from_speeds([(f64::NAN, 1.0)]).is_err());
        assert!(EtaDistribution::from_speeds([(1.0, -1.0)]).is_err());
        assert!(EtaDistribution::at_inclination(f64::INFINITY, 1.0).is_err());
        assert!(EtaDistribution::at_constant(-1.0 / 11.0, 1.56).is_err());
        let some = EtaDistribution::of_unknown_axis(0.0).unwrap();
        for probability in [0.0, 1.0, f64::NAN] {
            assert!(some.quantile(probability).is_err());
        }
    }
}
