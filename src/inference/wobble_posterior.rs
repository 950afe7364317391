//! The posterior probability of a wobble whose residuals are proportional to it.

use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};
use core::num::NonZeroUsize;

use libm::erf;
use nalgebra::{DMatrix, DVector, Vector2};

use crate::error::Error;
use crate::numerics::gauss::unit_rule;

/// Largest wobble (rad) for which residuals are taken as proportional to it; the neglected part has the relative size
/// `theta`.
const LARGEST: f64 = 0.1;

/// Standard deviations from the best wobble beyond which `exp(-x^2 / 2)` is below the smallest double.
const REACH: f64 = 38.7;

/// Number of standard deviations about the best wobble within which every quantile requested as a double lies.
const QUANTILES: f64 = 9.0;

/// Relative error of a probability.
const TOLERANCE: f64 = 1e-12;

/// Nodes of a panel.
const NODES: NonZeroUsize = NonZeroUsize::new(12).unwrap();

/// Constraints of data on a small wobble: the posterior of `x = theta (cos psi_0, sin psi_0)` where residuals are linear in it, with a flat prior for
/// the wobble `theta` and its phase `psi_0`.
#[derive(Debug, Clone)]
pub struct WobblePosterior {
    /// Standard deviations (rad) along the principal axes, the wider one first.
    widths: [f64; 2],
    /// The best `x` along these axes, in these standard deviations.
    offset: Vector2<f64>,
    /// The best `x` (rad).
    best: Vector2<f64>,
    /// Nodes and weights of Gaussian quadrature.
    rule: Vec<(f64, f64)>,
}

impl WobblePosterior {
    /// The posterior for the linear model `residuals + columns x`, in standard deviations. The columns are the derivatives with respect to the wobble
    /// at the phases 0 and a quarter of a turn, both after projecting out the other unknowns.
    ///
    /// # Errors
    /// [`Error::Domain`] for a number that is not finite.
    ///
    /// # Panics
    /// If there are not two columns, as long as the residuals.
    pub fn new(columns: DMatrix<f64>, residuals: &DVector<f64>) -> Result<Self, Error> {
        for number in columns.iter().chain(residuals) {
            Error::ensure(number.is_finite(), "residual or derivative", *number, "finite")?;
        }
        // Rows of zeros change nothing, and a matrix scaled to the size of one has finite squares.
        let (rows, scale) = (residuals.len().max(2), if columns.is_empty() { 0.0 } else { columns.amax() });
        let columns = columns.resize_vertically(rows, 0.0) / if scale > 0.0 { scale } else { 1.0 };
        let residuals = residuals.clone().resize_vertically(rows, 0.0);
        // Products of the columns would lose half of the digits of the wider axis.
        let svd = columns.svd(true, true);
        let (left, right) = (svd.u.expect("asked for"), svd.v_t.expect("asked for"));
        let widths = [1, 0].map(|axis: usize| (svd.singular_values[axis] * scale).recip());
        let offset = [1, 0].map(|axis: usize| -left.column(axis).dot(&residuals));
        let best = |k: usize| (0..2).map(|axis| right[(1 - axis, k)] * widths[axis] * offset[axis]).sum();
        let best = if widths[0].is_finite() { Vector2::new(best(0), best(1)) } else { Vector2::repeat(f64::NAN) };
        Ok(Self { widths, offset: offset.into(), best, rule: unit_rule(NODES) })
    }

    /// The wobble at the minimum of `chi^2`, as `theta (cos psi_0, sin psi_0)` (rad); NaN if one of the two components has no effect on the data.
    pub fn best(&self) -> [f64; 2] {
        self.best.into()
    }

    /// Reduction of `chi^2` at the best wobble relative to no wobble.
    pub fn gain(&self) -> f64 {
        if self.widths[0].is_finite() { self.offset.norm_squared() } else { 0.0 }
    }

    /// Upper limit on the wobble (rad) at this probability, accurate to 1e-12 of probability (or to 1e-14 of the distance of the best wobble from
    /// zero in standard deviations, if that is more). The limit is infinite above 0.1 rad, where residuals are not linear, and for every
    /// probability where the wider standard deviation is above 0.1 rad: residuals are then not linear over the posterior.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `0 <= probability < 1`.
    pub fn limit(&self, probability: f64) -> Result<f64, Error> {
        Error::ensure((0.0..1.0).contains(&probability), "confidence", probability, "from 0 to below 1")?;
        let wide = self.widths[0];
        let best = self.best.norm() / wide;
        // NaN: an axis has no effect.
        if wide > LARGEST || best.is_nan() || (best - QUANTILES) * wide > LARGEST {
            return Ok(f64::INFINITY);
        }
        let all = self.below(f64::INFINITY, None);
        let wanted = probability * all;
        let mut ends = [(best - QUANTILES).max(0.0), best + QUANTILES];
        let mut excess = ends.map(|end| self.below(end, Some(all)) - wanted);
        // The Illinois method: a secant between two ends, halving the excess of an end that stays.
        let mut last = None;
        while ends[1] - ends[0] > TOLERANCE * ends[1] {
            let middle = (ends[0] * excess[1] - ends[1] * excess[0]) / (excess[1] - excess[0]);
            let of_middle = self.below(middle, Some(all)) - wanted;
            if of_middle.abs() <= TOLERANCE * wanted || middle <= ends[0] || middle >= ends[1] {
                ends = [middle; 2];
                continue;
            }
            let replaced = usize::from(of_middle > 0.0);
            (ends[replaced], excess[replaced]) = (middle, of_middle);
            if last == Some(replaced) {
                excess[1 - replaced] *= 0.5;
            }
            last = Some(replaced);
        }
        let limit = wide * ends[1];
        Ok(if limit <= LARGEST { limit } else { f64::INFINITY })
    }

    /// A number proportional to the probability of a wobble below `largest`, in standard deviations of the wider axis.
    ///
    /// In standard deviations `x / widths = R (sin phi, cos phi)` the posterior is round and `theta = R g`,
    /// `g^2 = sin^2 phi + (fine / wide)^2 cos^2 phi`; `d theta d psi_0` is proportional to `dR d phi / g`. Over `R` of both signs the integral is a
    /// sum of error functions. The integrand over `phi`, half a circle, has three sharp features: the finer axis, where `1 / g` has a peak as narrow
    /// as the ratio of the widths; the direction of the best wobble; and the place where `largest` and the best `R` meet. Panels end at the first
    /// two, and are halved until they resolve all three.
    ///
    /// `all` is the value for a wobble of any size. The error is of the order of [`TOLERANCE`] times `all` or, if `all` is not given, times the result.
    fn below(&self, largest: f64, all: Option<f64>) -> f64 {
        let (ratio, best) = (self.widths[1] / self.widths[0], self.offset.norm());
        let towards = if self.offset.y == 0.0 { FRAC_PI_2 } else { (self.offset.x / self.offset.y).atan() };
        let density = |phi: f64| {
            let g = phi.sin().hypot(ratio * phi.cos());
            let (across, along) = ((phi - towards).sin() * best, (phi - towards).cos() * best);
            let radii = [largest / g - along, largest / g + along].map(|end| erf(FRAC_1_SQRT_2 * end));
            (-0.5 * across * across).exp() * (radii[0] + radii[1]) / g
        };
        let integral = |from: f64, to: f64| {
            let part = |(place, weight): &(f64, f64)| weight * density(from + (to - from) * place);
            (from, to, (to - from) * self.rule.iter().map(part).sum::<f64>())
        };
        // Elsewhere the density is zero.
        let reach = if best > REACH { (REACH / best).asin() } else { FRAC_PI_2 };
        let mut panels = Vec::new();
        for turn in [-PI, 0.0, PI] {
            let inside = |phi: f64| phi.clamp(-FRAC_PI_2, FRAC_PI_2);
            let (from, to) = (inside(towards - reach + turn), inside(towards + reach + turn));
            let mut ends = [from, 0.0_f64.clamp(from, to), towards.clamp(from, to), to];
            ends.sort_by(f64::total_cmp);
            panels.extend(ends.windows(2).filter(|ends| ends[0] < ends[1]).map(|ends| integral(ends[0], ends[1])));
        }
        // A direction is known to 1e-16, which changes the density by `REACH` times `best` as much.
        let tolerance = TOLERANCE.max(1e-14 * best) * all.unwrap_or_else(|| panels.iter().map(|panel| panel.2).sum());
        let mut total = 0.0;
        while let Some((from, to, whole)) = panels.pop() {
            let middle = 0.5 * (from + to);
            let halves = [integral(from, middle), integral(middle, to)];
            let sum = halves[0].2 + halves[1].2;
            if (sum - whole).abs() <= tolerance || !(from < middle && middle < to) {
                total += sum;
            } else {
                panels.extend(halves);
            }
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A posterior with given widths and a best wobble in units of these along their axes, which are rotated.
    fn posterior(widths: [f64; 2], offset: [f64; 2], turn: f64) -> WobblePosterior {
        let (sin, cos) = turn.sin_cos();
        let columns =
            DMatrix::from_row_slice(2, 2, &[cos / widths[0], sin / widths[0], -sin / widths[1], cos / widths[1]]);
        WobblePosterior::new(columns, &DVector::from_vec(vec![-offset[0], -offset[1]])).expect("numbers")
    }

    fn limit(widths: [f64; 2], offset: [f64; 2], probability: f64) -> f64 {
        posterior(widths, offset, 0.3).limit(probability).expect("a probability")
    }

    /// With the best wobble at zero and equal widths the wobble has half a normal distribution; far from zero a normal one.
    #[test]
    fn limits_of_known_distributions() {
        let quantiles =
            [(0.0, 0.0), (0.5, 0.674489750196082), (0.95, 1.959963984540054), (1.0 - 1e-6, 4.89163847569859)];
        for (probability, quantile) in quantiles {
            let found = limit([1e-6; 2], [0.0; 2], probability);
            assert!(
                (found - 1e-6 * quantile).abs() < 1e-6 * if quantile < 4.0 { 2e-11 } else { 1e-6 },
                "{probability} {found:e}"
            );
        }
        let far = posterior([1e-6; 2], [1e3, 2e3], 0.0);
        // The prior is flat in theta, not over the plane: the density has an extra factor theta^(-1/2), which shifts it by
        // 2.2e-10.
        let expected = 5.0_f64.sqrt() * 1e-3 + 1.644853626951472e-6 - 0.5e-12 / (5.0_f64.sqrt() * 1e-3);
        assert!((far.limit(0.95).unwrap() - expected).abs() < 1e-12, "{far:?} {expected:e}");
        assert!((far.best()[1] / 2e-3 - 1.0).abs() < 1e-14 && (far.gain() / 5e6 - 1.0).abs() < 1e-14, "{far:?}");
        // The same at 1e5 standard deviations. The probability is accurate to 1e-14 of that, 1e-9: over a density of 0.1 that is 1e-8 of a standard
        // deviation.
        let farther = limit([1e-9; 2], [0.0, 1e5], 0.95) / 1e-9;
        assert!((farther - (1e5 + 1.644853626951472 - 0.5e-5)).abs() < 1e-8, "{farther}");
        assert_eq!(limit([1e-6; 2], [0.0; 2], 0.0), 0.0);
        // Far above the range where residuals are proportional to it; and with one axis unconstrained.
        assert_eq!(limit([1e-12; 2], [1e17, 0.0], 0.95), f64::INFINITY);
        let blind = posterior([f64::INFINITY, 1e-6], [0.0; 2], 0.0);
        assert_eq!((blind.limit(0.95).unwrap(), blind.gain()), (f64::INFINITY, 0.0));
        assert!(far.limit(1.0).is_err() && blind.limit(-0.1).is_err());
    }

    /// The best wobble in the plane, and the reduction of `chi^2`; NaN for an axis without effect.
    #[test]
    fn the_best_wobble_is_that_of_least_squares() {
        for turn in [0.0_f64, 0.3, 2.0] {
            let (sin, cos) = turn.sin_cos();
            let [x, y] = posterior([1e-3, 1e-4], [2.0, -7.0], turn).best();
            assert!(
                (x - (cos * 2e-3 + sin * 7e-4)).abs() < 1e-15 && (y - (sin * 2e-3 - cos * 7e-4)).abs() < 1e-15,
                "{x} {y}"
            );
        }
        assert!((posterior([1e-3, 1e-4], [2.0, -7.0], 0.3).gain() - 53.0).abs() < 1e-12);
        for pull in [0.0, 2.0] {
            let blind = posterior([f64::INFINITY, 1e-6], [pull, 3.0], 0.0);
            assert!(blind.gain() == 0.0 && blind.best().iter().all(|x| x.is_nan()), "{blind:?}");
        }
        // Derivatives whose squares overflow.
        let tiny = posterior([1e200, 1e199], [2.0, -7.0], 0.0);
        assert!((tiny.gain() - 53.0).abs() < 1e-12 && (tiny.best()[0] / 2e200 - 1.0).abs() < 1e-14, "{tiny:?}");
        // One datum does not constrain two numbers.
        let one =
            WobblePosterior::new(DMatrix::from_row_slice(1, 2, &[1e3, 3e2]), &DVector::from_element(1, 5.0)).unwrap();
        assert!(one.gain() == 0.0 && one.limit(0.95).unwrap() == f64::INFINITY, "{one:?}");
    }

    /// A small probability to all digits; a wide posterior whose requested quantile is below 0.1 rad, and those that are too wide for any.
    #[test]
    fn limits_at_the_ends_of_their_range() {
        // Half a normal distribution: probability times sqrt(pi / 2), to its square.
        let found = limit([1e-6; 2], [0.0; 2], 1e-9);
        assert!((found / (1e-15 * (PI / 2.0).sqrt()) - 1.0).abs() < 1e-9, "{found:e}");
        assert_eq!(limit([0.5; 2], [0.0; 2], 0.01), f64::INFINITY);
        assert!((limit([0.05; 2], [0.0; 2], 0.5) / (0.05 * 0.674489750196082) - 1.0).abs() < 1e-10);
        // A normal distribution about 0.105 rad, minus its shift by the factor theta^(-1/2).
        let found = limit([0.01; 2], [0.0, 10.5], 0.1);
        assert!((found - (0.105 - 0.012815515655446)).abs() < 1e-3 && found < 0.1, "{found}");
        assert_eq!(limit([0.01; 2], [0.0, 10.5], 0.5), f64::INFINITY);
    }

    /// The density of `theta` from its own sum over the phase in equal steps: exact to rounding once the steps are finer than the
    /// narrow width.
    fn by_sums(ratio: f64, offset: [f64; 2], probability: f64) -> f64 {
        let reach = offset[0].hypot(offset[1] * ratio) + 9.0;
        let phases = (10.0 * reach / ratio).max(100.0) as usize;
        let density = |theta: f64| -> f64 {
            let term = |k: usize| {
                let (sin, cos) = (PI * (2 * k) as f64 / phases as f64).sin_cos();
                let [x, y] = [theta * cos - offset[0], theta * sin / ratio - offset[1]];
                (-0.5 * (x * x + y * y)).exp()
            };
            (0..phases).map(term).sum()
        };
        // Gauss' formula in panels that are narrow where the density is narrow: near zero because of the narrow axis.
        let mut ends: Vec<f64> = (0..=70).map(|k| reach * 0.85_f64.powi(70 - k)).collect();
        ends.insert(0, 0.0);
        let rule = unit_rule(NonZeroUsize::new(16).unwrap());
        let integral = |from: f64, to: f64| -> f64 {
            (to - from) * rule.iter().map(|(place, weight)| weight * density(from + (to - from) * place)).sum::<f64>()
        };
        let parts: Vec<f64> = ends.windows(2).map(|ends| integral(ends[0], ends[1])).collect();
        let mut left = probability * parts.iter().sum::<f64>();
        let panel = parts
            .iter()
            .take_while(|part| {
                if left > **part {
                    left -= **part;
                    true
                } else {
                    false
                }
            })
            .count();
        let (mut low, mut high) = (ends[panel], ends[panel + 1]);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if integral(ends[panel], middle) < left { low = middle } else { high = middle }
        }
        low
    }

    #[test]
    fn limits_are_quantiles_of_sums_over_phase_and_wobble() {
        let cases = [
            (1.0, [0.3, 1.2]),
            (0.3, [0.0, 0.0]),
            (0.1, [2.0, 1.0]),
            (0.1, [0.5, -30.0]),
            (0.05, [-4.0, 3.0]),
            (0.03, [0.0, 5.0]),
        ];
        for (ratio, offset) in cases {
            for probability in [0.1, 0.95] {
                let [found, expected] =
                    [limit([1e-6, 1e-6 * ratio], offset, probability) / 1e-6, by_sums(ratio, offset, probability)];
                assert!((found - expected).abs() < 1e-9, "{ratio} {offset:?} {probability}: {found} {expected}");
            }
        }
    }

    #[test]
    fn data_of_any_number_and_size_have_a_limit_or_none() {
        for rows in 0..3 {
            for size in [0.0, 1e-300, 1e-160, 1.0, 1e160, 1e300] {
                for residual in [0.0, 1e-300, 1.0, 1e300] {
                    let columns =
                        DMatrix::from_fn(rows, 2, |row, column| if row == column { size } else { 0.3 * size });
                    let posterior = WobblePosterior::new(columns, &DVector::repeat(rows, residual)).unwrap();
                    let limit = posterior.limit(0.95).unwrap();
                    // Two rows that are not alike, with widths from 1.5 / size down, constrain both axes.
                    let seen = rows == 2 && size > 100.0 && residual < 1e-2 * size;
                    assert_eq!(limit.is_finite(), seen, "{rows} {size:e} {residual:e}: {limit:e}");
                }
            }
        }
    }

    /// With the best wobble at zero the density of `theta` is `exp(-theta^2 / 2) exp(-z) I_0(z)`, `z = theta^2 (wide^2 / fine^2 - 1) / 4`. The
    /// quantiles are from SciPy (`ive`, Gauss' formula in `ln theta`).
    #[test]
    fn limits_of_needles_are_quantiles_of_bessel_functions() {
        let quantiles =
            [(0.3, 1.3658992369052), (1e-3, 0.8162023014232781), (1e-6, 0.5303587799702), (1e-9, 0.3623213120841894)];
        for (ratio, quantile) in quantiles {
            let found = posterior([1e-3, 1e-3 * ratio], [0.0; 2], 0.0).limit(0.95).unwrap() / 1e-3;
            assert!((found - quantile).abs() < 1e-10, "{ratio} {found} {quantile}");
        }
    }

    #[test]
    fn limits_of_needles_do_not_depend_on_where_they_point() {
        for ratio in [1e-3, 1e-6, 1e-9] {
            let of = |turn: f64, offset: [f64; 2]| posterior([1e-3, 1e-3 * ratio], offset, turn).limit(0.95).unwrap();
            for offset in [[0.0, 0.0], [3.0, 0.0], [0.0, 50.0], [20.0, 1e3]] {
                let limits = [0.0, 0.3, 1.234, PI / 2.0].map(|turn| of(turn, offset));
                let off = |limit: &f64| (limit / limits[0] - 1.0).abs();
                // The rotated axes are known to 1e-16 of the finer width; of the wider one to that over the ratio.
                assert!(limits.iter().all(|limit| off(limit) < 1e-10 + 1e-14 / ratio), "{ratio} {offset:?} {limits:?}");
            }
        }
    }
}
