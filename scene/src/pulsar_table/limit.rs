//! Limits at a stated confidence: the contributions of the measured change, of the other numbers and of the unknown directions, and
//! the total.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use twofold::Error;
use twofold::units::DEGREE;

use super::{Eta, Figure, Pulsar, Quantity, Spread};

/// Confidence of the limits.
pub const CONFIDENCE: f64 = 0.95;

/// Limits on a quantity whose ratio to `eta` is bounded by Eq. (41), at the confidence [`CONFIDENCE`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Limit over `eta`, from the measured error of the change of width alone; `None` if that change is given as a limit.
    pub over_eta_by_change: Option<f64>,
    /// Limit over `eta`, from the uncertainties of all other numbers alone.
    pub over_eta_by_inputs: f64,
    /// Limit on `eta`: from the unknown directions alone, or as given.
    pub eta: f64,
    /// Limit from all of these together.
    pub all: f64,
}

impl Pulsar {
    /// The change of width with its measured error; `None` if it is given without an error and taken as a limit.
    pub fn measured_change(&self) -> Option<Quantity> {
        (self.width_change.spread == Spread::Given).then_some(self.width_change)
    }

    /// The unknown directions, for a spin axis at the angle `lambda` to the line of sight: all orientations of the axes of the tensor, or,
    /// if `beta_0` is given, those at that inclination. The tensor is assumed to be symmetric about Z; this case has the largest `eta` at
    /// 95 % if nothing is known of its axes. `None` if `eta` is given.
    pub fn directions(&self) -> Result<Option<Directions>, Error> {
        let inclination = match self.eta {
            Eta::Given(_) => return Ok(None),
            Eta::Unknown => None,
            Eta::Inclination(beta_0) => Some(beta_0.value * DEGREE),
        };
        Ok(Some(Directions { inclination, sine: sine_of_sight(self.lambda.value * DEGREE)? }))
    }

    /// Relative standard uncertainty of `eta`, from the number given for it or for `beta_0`: `eta ~ 1 / (sin b0 cos b0)`.
    fn relative_uncertainty_of_eta(&self) -> f64 {
        match self.eta {
            Eta::Given(eta) => eta.uncertainty / eta.value,
            Eta::Unknown => 0.0,
            Eta::Inclination(beta_0) => (2.0 * beta_0.uncertainty * DEGREE / (2.0 * beta_0.value * DEGREE).tan()).abs(),
        }
    }

    /// Limits on the quantity whose bound over `eta` is `figure`.
    ///
    /// The change of `lambda` is normal about its measured value with its error, and the effect of the other numbers is normal to
    /// first order. Directions, change and numbers are independent. [`Limit::all`] is the value that the bound times `eta` then does
    /// not exceed with the probability [`CONFIDENCE`]: for given directions it is the quantile of a posterior with a flat prior.
    pub fn limit(&self, figure: &Figure) -> Result<Limit, Error> {
        let inputs = figure.from_inputs.hypot(figure.value * self.relative_uncertainty_of_eta());
        let together = Normal { mean: figure.value, deviation: figure.from_change.unwrap_or(0.0).hypot(inputs) };
        let (eta, all) = match (self.directions()?, self.eta) {
            (Some(directions), _) => {
                let one = Normal { mean: 1.0, deviation: 0.0 };
                (directions.quantile_of_eta_times(one), directions.quantile_of_eta_times(together))
            }
            (None, Eta::Given(eta)) => (eta.value, eta.value * together.size_quantile(CONFIDENCE)),
            (None, Eta::Unknown | Eta::Inclination(_)) => unreachable!("only a given eta has no directions"),
        };
        let over_eta = |deviation| Normal { mean: figure.value, deviation }.size_quantile(CONFIDENCE);
        Ok(Limit {
            over_eta_by_change: figure.from_change.map(over_eta),
            over_eta_by_inputs: over_eta(inputs),
            eta,
            all,
        })
    }

    /// Whether the uncertainties of the angles and of the width change `Delta lambda` by more than a third of itself, as near angles at which the width
    /// is stationary: limits, which are of first order in these uncertainties, may then cover less than [`CONFIDENCE`].
    pub fn is_rough(&self) -> Result<bool, String> {
        let unit = Self { width_change: Quantity::exact(1.0), ..self.clone() }.figure("lambda_change")?;
        Ok(unit.from_inputs > unit.value.abs() / 3.0)
    }

    /// The limit that a measured change of zero with the same error would give; `None` if the change has no error.
    pub fn sensitivity(&self, figure: &Figure) -> Result<Option<f64>, Error> {
        // Other uncertainties are relative to the change, so for a change of zero they add nothing.
        let unchanged = Figure { value: 0.0, from_inputs: 0.0, ..figure.clone() };
        figure.from_change.map(|_| Ok(self.limit(&unchanged)?.all)).transpose()
    }
}

/// The pulse of a table whose limit is recommended, and that limit. It is the pulse that would give the strongest limit for a
/// measured change of zero, or, if its change is given as a limit, for that limit. So the choice depends on the errors and not
/// on the measured values.
pub fn recommended(pulsars: &[Pulsar]) -> Result<(&Pulsar, Limit), String> {
    let mut best: Option<(f64, &Pulsar, Limit)> = None;
    for pulsar in pulsars {
        let figure = pulsar.figure("bound_over_eta_own")?;
        let limit = pulsar.limit(&figure)?;
        let strength = pulsar.sensitivity(&figure)?.unwrap_or(limit.all);
        if best.is_none_or(|(strongest, ..)| strength < strongest) {
            best = Some((strength, pulsar, limit));
        }
    }
    best.map(|(_, pulsar, limit)| (pulsar, limit)).ok_or_else(|| "a table without pulses".to_owned())
}

/// The value that `|x| eta` does not exceed with the probability [`CONFIDENCE`], for a normal `x` and a spin axis at an angle (rad) to the line of
/// sight, with an isotropic prior on the direction of the axis of a symmetric tensor. With `x` the bound over `eta` of Eq. (41) it is the limit on
/// `|2 s^ZZ - s^XX - s^YY|`.
///
/// # Errors
/// [`Error::Domain`] for a spin axis along the line of sight.
pub fn limit_over_directions(angle_to_sight: f64, mean: f64, deviation: f64) -> Result<f64, Error> {
    let directions = Directions { inclination: None, sine: sine_of_sight(angle_to_sight)? };
    Ok(directions.quantile_of_eta_times(Normal { mean, deviation }))
}

/// The sine of the angle of the spin axis to the line of sight.
fn sine_of_sight(angle: f64) -> Result<f64, Error> {
    let sine = angle.sin().abs();
    let allowed = "above 2.2e-16 in size; a motion across the line of sight cannot be seen";
    Error::ensure(sine > f64::EPSILON, "sine of the angle to the line of sight", sine, allowed)?;
    Ok(sine)
}

fn rule(nodes: usize) -> GaussLegendre {
    GaussLegendre::new(NonZeroUsize::new(nodes).expect("a rule with nodes"))
}

/// Unknown directions of the axes of a symmetric tensor, seen at a known angle to the spin axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directions {
    /// Angle (rad) of the spin axis to Z; `None` if it is unknown.
    inclination: Option<f64>,
    /// Sine of the angle between the spin axis and the line of sight.
    sine: f64,
}

impl Directions {
    /// The value that `|x| eta` does not exceed with the probability [`CONFIDENCE`], for a normal `x` that is independent of
    /// the directions.
    fn quantile_of_eta_times(self, x: Normal) -> f64 {
        let sizes = x.sizes();
        let rule = rule(60);
        let beyond = |limit: f64| -> f64 {
            sizes.iter().map(|(size, weight)| weight * self.is_slower_than(size / limit, &rule)).sum()
        };
        let largest = sizes.iter().fold(0.0, |largest: f64, (size, _)| largest.max(*size));
        let (mut low, mut high) = (0.0, largest);
        while beyond(high) > 1.0 - CONFIDENCE {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..50 {
            let middle = (low + high) / 2.0;
            *(if beyond(middle) > 1.0 - CONFIDENCE { &mut low } else { &mut high }) = middle;
        }
        high
    }

    /// Probability of `1 / eta < rate`. With the azimuth `psi` of the line of sight about the spin axis `l`, counted from the motion, `1 / eta`
    /// is `sin(lambda) |l.Z| |(l x Z)| |cos psi|`. For an isotropic Z this is `sin(lambda)` times the product of two of its components,
    /// `(1 - mu^2) |sin 2 phi| / 2` about the third axis: the mean over `mu` is known analytically, and the integral over `t = 2 phi` remains.
    fn is_slower_than(self, rate: f64, rule: &GaussLegendre) -> f64 {
        let rate = rate / self.sine;
        if let Some(beta) = self.inclination {
            return FRAC_2_PI * (rate / (beta.sin() * beta.cos()).abs()).min(1.0).asin();
        }
        if rate >= 0.5 {
            return 1.0;
        }
        let first = (2.0 * rate).asin();
        if first == 0.0 {
            return 0.0;
        }
        // In the variable `y`, `t = first cosh(y)`, the square root at the first end is smooth.
        let faster = |y: f64| (1.0 - 2.0 * rate / (first * y.cosh()).sin()).max(0.0).sqrt() * first * y.sinh();
        1.0 - FRAC_2_PI * rule.integrate(0.0, (FRAC_PI_2 / first).acosh(), faster)
    }
}

/// A normal distribution.
#[derive(Debug, Clone, Copy)]
struct Normal {
    mean: f64,
    deviation: f64,
}

impl Normal {
    /// Sizes `|x|` with weights that sum to one, so that the mean of a function of the size is a sum: a Gauss-Legendre rule in a
    /// variable in which the ends are smooth, eight standard deviations to each side.
    fn sizes(self) -> Vec<(f64, f64)> {
        let Self { mean, deviation } = self;
        if deviation == 0.0 {
            return vec![(mean.abs(), 1.0)];
        }
        let mean = mean.abs() / deviation;
        let (low, high) = ((mean - 8.0).max(0.0), mean + 8.0);
        let density = |x: f64| [x - mean, x + mean].map(|off| (-0.5 * off * off).exp()).iter().sum::<f64>();
        let size = |&(node, weight): &(f64, f64)| {
            let u = (1.0 + node) / 2.0;
            let x = low + (high - low) * u * u;
            (x * deviation, weight * (high - low) * u * density(x) / (2.0 * PI).sqrt())
        };
        rule(100).iter().map(size).collect()
    }

    /// The value that the size `|x|` does not exceed with the given probability.
    fn size_quantile(self, probability: f64) -> f64 {
        let Self { mean, deviation } = self;
        if deviation == 0.0 {
            return mean.abs();
        }
        let rule = rule(60);
        // In standard deviations.
        let mean = mean.abs() / deviation;
        let density = |x: f64| (-0.5 * (x - mean) * (x - mean)).exp() / (2.0 * PI).sqrt();
        let below = |size: f64| rule.integrate((mean - 8.0).max(-size), size, density);
        let (mut low, mut high) = (0.0, mean + 8.0);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            *(if below(middle) < probability { &mut low } else { &mut high }) = middle;
        }
        high * deviation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_normal_numbers_have_the_quantiles_of_tables() {
        // 1.959964 and 1.644854 standard deviations: both sides of zero, and one side far from zero.
        for (mean, deviation, expected) in
            [(0.0, 2.0, 2.0 * 1.959964), (100.0, 1.0, 101.644854), (-1e9, 1.0, 1e9 + 1.644854), (-3.0, 0.0, 3.0)]
        {
            let found = Normal { mean, deviation }.size_quantile(CONFIDENCE);
            assert!((found - expected).abs() < 1e-6 * deviation.max(1e-9), "{mean} +- {deviation}: {found}");
        }
        // Half of all are within 0.674490 standard deviations.
        assert!((Normal { mean: 0.0, deviation: 2.0 }.size_quantile(0.5) - 2.0 * 0.674490).abs() < 2e-6);
        assert_eq!(Normal { mean: -3.0, deviation: 0.0 }.sizes(), [(3.0, 1.0)]);
    }

    /// The mean square is that of the normal distribution, `mean^2 + deviation^2`, and the weights sum to one: to the roundings of a hundred terms.
    #[test]
    fn sizes_have_the_moments_of_their_distribution() {
        for (mean, deviation) in [(0.0, 2.0), (-1.5, 1.0), (30.0, 2.0)] {
            let sizes = Normal { mean, deviation }.sizes();
            let weight: f64 = sizes.iter().map(|(_, weight)| weight).sum();
            let square: f64 = sizes.iter().map(|(size, weight)| weight * size * size).sum();
            assert!((weight - 1.0).abs() < 1e-13, "{weight}");
            assert!((square / (mean * mean + deviation * deviation) - 1.0).abs() < 1e-13, "{square}");
        }
    }

    /// The fraction of all directions Z for which `|l.Z| |l x Z| |cos psi|`, with `l` and the motion along two axes the product of two components of
    /// Z, is below a rate. It is computed on a grid, whose cells at the edge are some 0.002 of all. The rate is never above 1/2.
    #[test]
    fn slow_motions_are_as_frequent_as_directions_of_them_on_a_grid() {
        const CELLS: u32 = 1000;
        let directions = Directions { inclination: None, sine: 0.5 };
        let middles = |length: f64| (0..CELLS).map(move |i| (f64::from(i) + 0.5) / f64::from(CELLS) * length);
        for rate in [0.02, 0.2, 0.45] {
            let mut count = 0;
            for mu in middles(1.0) {
                count += middles(FRAC_PI_2).filter(|phi| (1.0 - mu * mu) * phi.sin() * phi.cos() < rate).count();
            }
            let share = count as f64 / f64::from(CELLS * CELLS);
            let found = directions.is_slower_than(0.5 * rate, &rule(60));
            assert!((found - share).abs() < 2e-3, "{rate}: {found} and {share}");
        }
        for (rate, share) in [(0.0, 0.0), (0.25, 1.0), (3.0, 1.0)] {
            assert_eq!(directions.is_slower_than(rate, &rule(60)), share);
        }
    }

    /// `eta` is proportional to `1 / sin(2 b0)`: its uncertainty is half of its change from one end of the error of `b0` to the other. The next term
    /// of the series is some 1e-6 of it.
    #[test]
    fn the_uncertainty_of_eta_is_that_of_the_inclination() {
        for (beta_0, error) in [(30.0, 0.05), (60.0, 0.05), (150.0, 0.05)] {
            let text = format!(
                "[[pulsar]]\nname = \"x\"\nspin_period = 4e-3\nlambda = 95\nchi = 51\nwidth = 13\nwidth_change = 0.02\nyears = 15\nbeta_0 = [{beta_0}, {error}]\n"
            );
            let pulsar = crate::pulsar_table::pulsars("table", &text).unwrap().remove(0);
            let eta = |degrees: f64| 1.0 / (2.0 * degrees * DEGREE).sin().abs();
            let expected = (eta(beta_0 + error) - eta(beta_0 - error)).abs() / 2.0 / eta(beta_0);
            let found = pulsar.relative_uncertainty_of_eta();
            assert!((found / expected - 1.0).abs() < 1e-5, "{beta_0}: {found} and {expected}");
        }
    }

    /// With one uncertain angle `Delta lambda` changes in proportion to its uncertainty.
    #[test]
    fn a_limit_is_rough_where_inputs_change_it_by_a_third() {
        let text = "[[pulsar]]\nname = \"x\"\nspin_period = 4e-3\nlambda = 95\nchi = 51\nwidth = 13\nwidth_change = 0.02\nyears = 15\n";
        let pulsar = crate::pulsar_table::pulsars("table", text).unwrap().remove(0);
        let [chi, width] = [&pulsar.chi, &pulsar.width].map(|quantity| Quantity::exact(quantity.value));
        let exact = Pulsar { chi, width, width_change: Quantity::exact(1.0), ..pulsar };
        let with =
            |uncertainty: f64| Pulsar { lambda: Quantity { uncertainty, ..Quantity::exact(95.0) }, ..exact.clone() };
        let figure = with(0.01).figure("lambda_change").unwrap();
        let relative = figure.from_inputs / figure.value.abs() / 0.01;
        for (part, is_rough) in [(0.26, false), (0.33, false), (0.34, true)] {
            assert_eq!(with(part / relative).is_rough(), Ok(is_rough), "{part}");
        }
    }

    /// A change of 0.3 deg with an error of 0.02 deg is measured better than one of 0.001 deg with an error of 0.05 deg, although the first gives the
    /// weaker limit: had both changes been zero, it would give the stronger one.
    #[test]
    fn the_pulse_that_is_measured_best_is_recommended_whatever_was_measured() {
        let pulse = |name: &str, change: &str| {
            format!(
                "[[pulsar]]\nname = \"{name}\"\nspin_period = 4e-3\nlambda = 95\nchi = 51\nwidth = 13\nwidth_change = {change}\nyears = 15\n"
            )
        };
        let text = pulse("steady", "[0.001, 0.05]") + &pulse("changed", "[0.3, 0.02]");
        let pulsars = crate::pulsar_table::pulsars("table", &text).unwrap();
        let [steady, changed] = [0, 1].map(|i| {
            let figure = pulsars[i].figure("bound_over_eta_own").unwrap();
            (pulsars[i].limit(&figure).unwrap().all, pulsars[i].sensitivity(&figure).unwrap().expect("an error"))
        });
        // Both are one number times the error.
        assert!(changed.0 > steady.0 && (steady.1 / changed.1 - 2.5).abs() < 1e-9, "{steady:?} {changed:?}");
        assert_eq!(recommended(&pulsars).unwrap().0.name, "changed");
    }

    #[test]
    fn an_angle_to_the_line_of_sight_of_either_sign_has_one_limit() {
        assert_eq!(limit_over_directions(-0.7, 1.0, 0.5), limit_over_directions(0.7, 1.0, 0.5));
    }

    /// Compared with adaptive quadratures of another program (`verify/oracles/second_program/bounds.py`), which random draws confirm to
    /// 1e-3.
    #[test]
    fn limits_over_directions_are_the_quantiles_of_integrals_done_another_way() {
        for (lambda, inclination, mean, deviation, expected) in [
            (100.0, None, 1.0, 0.0, 88.635_652_034_956_15),
            (100.0, None, 1.0, 1.1, 103.199_948_360_082_8),
            (40.0, None, 0.0, 1.0, 103.082_788_623_988_7),
            (40.0, None, -30.0, 1.0, 4_073.544_488_652_147),
            (75.0, Some(35.0), 1.0, 0.0, 28.083_879_615_124_71),
            // An axis of the tensor has two ends: 35 degrees from one is 145 from the other.
            (75.0, Some(145.0), 1.0, 0.4, 28.142_660_688_733_76),
            (75.0, Some(80.0), 0.0, 2.0, 123.404_499_675_616_7),
        ] {
            let directions =
                Directions { inclination: inclination.map(f64::to_radians), sine: f64::to_radians(lambda).sin() };
            let found = directions.quantile_of_eta_times(Normal { mean, deviation });
            assert!((found / expected - 1.0).abs() < 1e-9, "{lambda} {inclination:?} {mean} {deviation}: {found}");
        }
    }
}
