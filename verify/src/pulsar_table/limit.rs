//! Limits at a stated confidence: what the measured change, the other numbers and the unknown directions contribute, and all of it.

use std::f64::consts::PI;
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use twofold::Error;
use twofold::observables::eta_distribution::EtaDistribution;
use twofold::units::DEGREE;

use super::{Eta, Figure, Pulsar, Quantity, Spread};

/// Confidence of the limits.
pub const CONFIDENCE: f64 = 0.95;

/// Limits on a quantity of which Eq. (41) bounds the ratio to `eta`, at the confidence [`CONFIDENCE`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Over `eta`, by the measured error of the change of width alone; none if that change is given as a limit.
    pub over_eta_by_change: Option<f64>,
    /// Over `eta`, by the uncertainties of all other numbers alone.
    pub over_eta_by_inputs: f64,
    /// `eta`: by the unknown directions alone, or as given.
    pub eta: f64,
    /// By all of these together.
    pub all: f64,
}

impl Pulsar {
    /// The change of width with its measured error; none if it is a bare number, which is taken as a limit.
    pub fn measured_change(&self) -> Option<Quantity> {
        (self.width_change.spread == Spread::Given).then_some(self.width_change)
    }

    /// How `eta` is distributed over the directions that are not known, for a spin axis at the angle `lambda` to the line of sight:
    /// over all orientations of the axes of the tensor, or with `beta_0` over those at that inclination. The tensor is taken as symmetric about
    /// Z, which has the largest `eta` at 95 % if nothing is known of its axes. None if `eta` is given.
    ///
    /// # Errors
    /// None for the angles that a table may have.
    pub fn eta_distribution(&self) -> Result<Option<EtaDistribution>, Error> {
        let axes = match self.eta {
            Eta::Given(_) => return Ok(None),
            Eta::Unknown => EtaDistribution::of_unknown_axis(0.0)?,
            Eta::Inclination(beta_0) => EtaDistribution::at_inclination(0.0, beta_0.value * DEGREE)?,
        };
        Ok(Some(axes.seen_at(self.lambda.value * DEGREE)?))
    }

    /// Standard uncertainty of `eta`, relative to it, from the number given for it or for `beta_0`: `eta ~ 1 / (sin b0 cos b0)`.
    fn relative_uncertainty_of_eta(&self) -> f64 {
        match self.eta {
            Eta::Given(eta) => eta.uncertainty / eta.value,
            Eta::Unknown => 0.0,
            Eta::Inclination(beta_0) => (2.0 * beta_0.uncertainty * DEGREE / (2.0 * beta_0.value * DEGREE).tan()).abs(),
        }
    }

    /// Limits on the quantity whose bound over `eta` is `figure`.
    ///
    /// The change of `lambda` is normal about its measured value with its error, the effect of the other numbers normal to first
    /// order, and directions, change and numbers do not depend on each other. [`Limit::all`] is what the bound times `eta` then does
    /// not exceed with the probability [`CONFIDENCE`]: for given directions the quantile of a posterior with a flat prior.
    ///
    /// # Errors
    /// As for [`eta_distribution`](Self::eta_distribution).
    pub fn limit(&self, figure: &Figure) -> Result<Limit, Error> {
        let inputs = figure.from_inputs.hypot(figure.value * self.relative_uncertainty_of_eta());
        let together = Normal { mean: figure.value, deviation: figure.from_change.unwrap_or(0.0).hypot(inputs) };
        let (eta, all) = match (self.eta_distribution()?, self.eta) {
            (Some(eta), _) => (eta.quantile(CONFIDENCE)?, eta.times(together.sizes())?.quantile(CONFIDENCE)?),
            (None, Eta::Given(eta)) => (eta.value, eta.value * together.size_quantile(CONFIDENCE)),
            (None, Eta::Unknown | Eta::Inclination(_)) => unreachable!("only a given eta has no distribution"),
        };
        let over_eta = |deviation| Normal { mean: figure.value, deviation }.size_quantile(CONFIDENCE);
        Ok(Limit {
            over_eta_by_change: figure.from_change.map(over_eta),
            over_eta_by_inputs: over_eta(inputs),
            eta,
            all,
        })
    }

    /// The limit that a measured change of zero with the same error would give: how sensitive the pulse is, whatever was found.
    /// None if the change has no error.
    ///
    /// # Errors
    /// As for [`limit`](Self::limit).
    pub fn sensitivity(&self, figure: &Figure) -> Result<Option<f64>, Error> {
        // Other uncertainties are relative to a change: to none they add nothing.
        let unchanged = Figure { value: 0.0, from_inputs: 0.0, ..figure.clone() };
        figure.from_change.map(|_| Ok(self.limit(&unchanged)?.all)).transpose()
    }
}

/// The pulse of a table whose limit is recommended, and that limit: the pulse that would give the strongest one for a measured
/// change of zero, or, where its change is given as a limit, for that. So it is chosen by errors and not by what was found.
///
/// # Errors
/// For a table without pulses, and what [`Pulsar::limit`] reports.
pub fn recommended(pulsars: &[Pulsar]) -> Result<(&Pulsar, Limit), String> {
    let mut best: Option<(f64, &Pulsar, Limit)> = None;
    for pulsar in pulsars {
        let figure = pulsar.figure("bound_over_eta_own")?;
        let text = |error: Error| error.to_string();
        let limit = pulsar.limit(&figure).map_err(text)?;
        let strength = pulsar.sensitivity(&figure).map_err(text)?.unwrap_or(limit.all);
        if best.is_none_or(|(strongest, ..)| strength < strongest) {
            best = Some((strength, pulsar, limit));
        }
    }
    best.map(|(_, pulsar, limit)| (pulsar, limit)).ok_or_else(|| "a table without pulses".to_owned())
}

/// A normal distribution.
#[derive(Debug, Clone, Copy)]
struct Normal {
    mean: f64,
    deviation: f64,
}

impl Normal {
    /// Sizes `|x|` with weights: the midpoint rule over five standard deviations to each side, whose error for smooth functions
    /// is that of the 6e-7 beyond.
    fn sizes(self) -> Vec<(f64, f64)> {
        const NODES: u32 = 64;
        if self.deviation == 0.0 {
            return vec![(self.mean.abs(), 1.0)];
        }
        let node = |i| 5.0 * ((2.0 * f64::from(i) + 1.0) / f64::from(NODES) - 1.0);
        (0..NODES).map(node).map(|z| ((self.mean + self.deviation * z).abs(), (-0.5 * z * z).exp())).collect()
    }

    /// The number that the size `|x|` does not exceed with the given probability.
    fn size_quantile(self, probability: f64) -> f64 {
        let Self { mean, deviation } = self;
        if deviation == 0.0 {
            return mean.abs();
        }
        let rule = GaussLegendre::new(NonZeroUsize::new(60).expect("60 nodes"));
        // In standard deviations.
        let mean = mean.abs() / deviation;
        let density = |x: f64| (-0.5 * (x - mean) * (x - mean)).exp() / (2.0 * PI).sqrt();
        let below = |size: f64| rule.integrate((mean - 8.0).max(-size), size, density);
        let (mut low, mut high) = ((mean - 8.0).max(0.0), mean + 8.0);
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
            [(0.0, 2.0, 2.0 * 1.959964), (100.0, 1.0, 101.644854), (-1e9, 1.0, 1e9 + 1.644854), (3.0, 0.0, 3.0)]
        {
            let found = Normal { mean, deviation }.size_quantile(CONFIDENCE);
            assert!((found - expected).abs() < 1e-6 * deviation.max(1e-9), "{mean} +- {deviation}: {found}");
        }
    }
}
