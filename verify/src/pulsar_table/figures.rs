//! The bounds from one pulse, with uncertainties by exact gradients.

use std::sync::OnceLock;

use nalgebra::Vector3;
use num_dual::Dual64;
use twofold::observables::bound::{SpinAxisDrift, fluid_inertia_over_c, lambda_change, preferred_frame_bound};
use twofold::observables::eta::root_mean_square_eta;
use twofold::observables::eta_distribution::EtaDistribution;
use twofold::star::estimates::inertia_over_c_estimate;
use twofold::units::geometrised::{GRAM_PER_CUBIC_CENTIMETRE, HERTZ, KILOMETRE};
use twofold::units::{DEGREE, JULIAN_YEAR};
use twofold::{Error, Real};

use super::{Eta, Inertia, Pulsar, SpinForm};
use crate::random::Random;

/// The paper's round `I^zz / C` (s^2).
pub const ROUND_INERTIA_OVER_C: f64 = 1e-5;

/// Confidence of the bounds that need no `eta`.
pub const CONFIDENCE: f64 = 0.95;

/// `eta` that is not exceeded with the probability [`CONFIDENCE`], for a tensor with one axis of symmetry (as that of alpha_2), a
/// spin axis and a direction to the observer of which nothing is known.
pub fn eta_at_confidence() -> f64 {
    static ETA: OnceLock<f64> = OnceLock::new();
    let quantile = || EtaDistribution::of_unknown_axis(0.0)?.quantile(CONFIDENCE);
    *ETA.get_or_init(|| quantile().expect("a symmetric tensor and a probability in (0, 1)"))
}

/// One number that follows, with its standard uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Key in the JSON output.
    pub key: &'static str,
    /// What it is, with its unit.
    pub label: String,
    /// The number.
    pub value: f64,
    /// Its standard uncertainty, by the gradient.
    pub uncertainty: f64,
}

/// A figure as it is computed, of any number type.
struct Computed<S> {
    key: &'static str,
    label: String,
    value: S,
}

impl Pulsar {
    /// What follows for this pulse: change of `lambda`, `I^zz / C`, the bounds on `|2 s^ZZ - s^XX - s^YY|` by Eq. (41) and, with
    /// a speed, on `|alpha_2|`.
    ///
    /// Uncertainties are linear, by automatic derivatives, for inputs that do not depend on each other.
    ///
    /// # Errors
    /// [`Error::Domain`] where the width is stationary, or for an inclination without `eta`.
    pub fn figures(&self) -> Result<Vec<Figure>, Error> {
        let values = computed(&self.map(|quantity| quantity.value))?;
        let mut variances = vec![0.0; values.len()];
        let mut count = 0;
        self.map(|_| count += 1);
        for seeded in 0..count {
            let (mut index, mut uncertainty) = (0, 0.0);
            let point = self.map(|quantity| {
                let derivative = f64::from(u8::from(index == seeded));
                uncertainty += derivative * quantity.uncertainty;
                index += 1;
                Dual64::new(quantity.value, derivative)
            });
            for (variance, figure) in variances.iter_mut().zip(computed(&point)?) {
                *variance += (figure.value.eps * uncertainty).powi(2);
            }
        }
        let figure = |(c, variance): (Computed<f64>, f64)| Figure {
            key: c.key,
            label: c.label,
            value: c.value,
            uncertainty: variance.sqrt(),
        };
        Ok(values.into_iter().zip(variances).map(figure).collect())
    }

    /// The figures of random inputs of the given distributions, in the order of [`figures`](Self::figures).
    ///
    /// # Errors
    /// As for [`figures`](Self::figures).
    pub fn random_figures(&self, random: &mut Random) -> Result<Vec<f64>, Error> {
        Ok(computed(&self.map(|quantity| quantity.draw(random)))?.into_iter().map(|c| c.value).collect())
    }

    /// Bound on `|2 s^ZZ - s^XX - s^YY| / eta` by Eq. (41) with a given `I^zz / C` (s^2).
    ///
    /// # Errors
    /// As for [`figures`](Self::figures).
    pub fn bound_over_eta(&self, inertia_over_c: f64) -> Result<f64, Error> {
        let values = self.map(|quantity| quantity.value);
        drift(&values, inertia_over_c)?.combination_bound(1.0)
    }

    /// Change of `lambda` (deg) by Eq. (42).
    ///
    /// # Errors
    /// As for [`figures`](Self::figures).
    pub fn lambda_change(&self) -> Result<f64, Error> {
        change_of_lambda(&self.map(|quantity| quantity.value))
    }
}

fn change_of_lambda<S: Real>(p: &Pulsar<S>) -> Result<S, Error> {
    lambda_change(p.lambda * DEGREE, p.chi * DEGREE, p.width * DEGREE, p.width_change)
}

/// `Omega^z` in rad/s.
fn spin<S: Real>(p: &Pulsar<S>) -> S {
    match p.spin_form {
        SpinForm::Frequency => p.spin * HERTZ,
        SpinForm::Period => S::from_f64(HERTZ) / p.spin,
    }
}

fn drift<S: Real>(p: &Pulsar<S>, polar_inertia_over_c: S) -> Result<SpinAxisDrift<S>, Error> {
    let (sine, _) = (p.lambda * DEGREE).sin_cos();
    Ok(SpinAxisDrift {
        polar_inertia_over_c,
        spin: spin(p),
        interval: p.years * JULIAN_YEAR,
        cos_lambda_change: -sine * change_of_lambda(p)? * DEGREE,
    })
}

fn computed<S: Real>(p: &Pulsar<S>) -> Result<Vec<Computed<S>>, Error> {
    let fluid = fluid_inertia_over_c(spin(p));
    let (inertia, inertia_origin) = match p.inertia {
        Inertia::Given(given) => (given, "given"),
        Inertia::Uniform { density, oblateness } => {
            (inertia_over_c_estimate(density * GRAM_PER_CUBIC_CENTIMETRE, oblateness), "Eq. (43)")
        }
        Inertia::Fluid => (fluid, "fluid, 4/Omega^2"),
    };
    let (eta, eta_name) = match p.eta {
        Eta::Given(eta) => (eta, "eta as given".to_owned()),
        Eta::Inclination(beta_0) => {
            let eta = root_mean_square_eta(S::zero(), beta_0 * DEGREE)?;
            (eta, format!("eta = {:.3} by beta_0", eta.re()))
        }
        Eta::Conservative => (S::from_f64(10.0), "eta = 10".to_owned()),
    };
    let confident = eta_at_confidence();
    let confidence = format!("{:.0} %, eta = {confident:.0}", CONFIDENCE * 100.0);
    let combination = "|2 s^ZZ - s^XX - s^YY|";

    let over_eta = drift(p, inertia)?.combination_bound(S::one())?;
    let round_over_eta = drift(p, S::from_f64(ROUND_INERTIA_OVER_C))?.combination_bound(S::one())?;
    let fluid_over_eta = drift(p, fluid)?.combination_bound(S::one())?;
    let figure = |key, label, value| Computed { key, label, value };
    let mut figures = vec![
        figure("lambda_change", "Delta lambda [1e-3 deg]".to_owned(), change_of_lambda(p)? * 1e3),
        figure("inertia_over_c", format!("I^zz/C [s^2], {inertia_origin}"), inertia),
        figure("bound_over_eta", format!("{combination} / eta"), over_eta),
        figure("bound_over_eta_round", format!("{combination} / eta, I^zz/C = 1e-5 s^2"), round_over_eta),
        figure("bound_over_eta_fluid", format!("{combination} / eta, fluid star"), fluid_over_eta),
        figure("bound", format!("{combination}, {eta_name}"), over_eta * eta),
        figure("bound_confident", format!("{combination}, {confidence}"), over_eta * confident),
    ];
    if let Some(speed) = p.speed {
        // The bound depends on the length of w alone.
        let w = Vector3::new(S::zero(), S::zero(), speed * KILOMETRE);
        for (key, label, bound) in [
            ("alpha_2_over_eta", "|alpha_2| / eta".to_owned(), over_eta),
            ("alpha_2_over_eta_fluid", "|alpha_2| / eta, fluid star".to_owned(), fluid_over_eta),
            ("alpha_2_confident_fluid", format!("|alpha_2|, fluid star, {confidence}"), fluid_over_eta * confident),
        ] {
            figures.push(figure(key, label, preferred_frame_bound(bound, &w)?));
        }
    }
    Ok(figures)
}
