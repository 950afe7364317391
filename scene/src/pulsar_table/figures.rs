//! The bounds from one pulse, with uncertainties from exact gradients.

use nalgebra::Vector3;
use num_dual::Dual64;
use twofold::observables::bound::{SpinAxisDrift, fluid_inertia_over_c, lambda_change, preferred_frame_bound};
use twofold::star::estimates::inertia_over_c_estimate;
use twofold::units::geometrised::{GRAM_PER_CUBIC_CENTIMETRE, HERTZ, KILOMETRE};
use twofold::units::{DEGREE, JULIAN_YEAR};
use twofold::{Error, Real};

use super::{Inertia, Pulsar, Quantity, SpinForm};
use crate::random::Random;

/// The paper's rounded `I^zz / C` (s^2).
pub const ROUND_INERTIA_OVER_C: f64 = 1e-5;

/// The value that the paper takes for `eta` in its conservative bounds.
pub const CONSERVATIVE_ETA: f64 = 10.0;

/// The quantity that is bounded.
pub const COMBINATION: &str = "|2 s^ZZ - s^XX - s^YY|";

/// A value that follows from a pulse, linear in small changes of the input.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Key in the JSON output.
    pub key: &'static str,
    /// Description, with the unit.
    pub label: String,
    /// The value.
    pub value: f64,
    /// Its standard uncertainty from the measured error of the change of width; `None` if that change is given as a limit.
    pub from_change: Option<f64>,
    /// Its standard uncertainty from all other numbers: from their last digits, or from their stated uncertainties.
    pub from_inputs: f64,
}

/// A computed value, in any number type.
struct Computed<S> {
    key: &'static str,
    label: String,
    value: S,
}

impl Pulsar {
    /// The results for this pulse: the change of `lambda`; the bounds on `|2 s^ZZ - s^XX - s^YY|` by Eq. (41), over `eta`, (a) with
    /// `I^zz / C` from Eq. (43) if it is given in that form, and (b) with the `I^zz / C` of the star's own deformation; and, if a
    /// speed is given, the bound on `|alpha_2|`.
    ///
    /// The change of width is used as given, as in the paper; the effect of its error is included in a
    /// [`Limit`](super::Limit). Uncertainties are linear, from automatic derivatives, for independent inputs.
    pub fn figures(&self) -> Result<Vec<Figure>, Error> {
        let values = computed(&self.map(|quantity| quantity.value))?;
        let measured = self.measured_change();
        let exact = |quantity: Quantity| Quantity::exact(quantity.value);
        let from_change =
            measured.map(|change| Self { width_change: change, ..self.map(exact) }.deviations()).transpose()?;
        let width_change = measured.map_or(self.width_change, exact);
        let from_inputs = Self { width_change, ..self.clone() }.deviations()?;
        let figure = |(i, c): (usize, Computed<f64>)| Figure {
            key: c.key,
            label: c.label,
            value: c.value,
            from_change: from_change.as_ref().map(|deviations| deviations[i]),
            from_inputs: from_inputs[i],
        };
        Ok(values.into_iter().enumerate().map(figure).collect())
    }

    /// The value with this key.
    pub fn figure(&self, key: &str) -> Result<Figure, String> {
        let figures = self.figures()?;
        figures
            .into_iter()
            .find(|figure| figure.key == key)
            .ok_or_else(|| format!("{}: there is no figure {key}", self.name))
    }

    /// Standard deviations of the values, from all uncertainties.
    fn deviations(&self) -> Result<Vec<f64>, Error> {
        let mut count = 0;
        self.map(|_| count += 1);
        let mut variances = Vec::new();
        for seeded in 0..count {
            let (mut index, mut uncertainty) = (0, 0.0);
            let point = self.map(|quantity| {
                let derivative = f64::from(u8::from(index == seeded));
                uncertainty += derivative * quantity.uncertainty;
                index += 1;
                Dual64::new(quantity.value, derivative)
            });
            let figures = computed(&point)?;
            variances.resize(figures.len(), 0.0);
            for (variance, figure) in variances.iter_mut().zip(figures) {
                *variance += (figure.value.eps * uncertainty).powi(2);
            }
        }
        Ok(variances.into_iter().map(f64::sqrt).collect())
    }

    /// The values for random inputs from the given distributions, in the order of [`figures`](Self::figures).
    pub fn random_figures(&self, random: &mut Random) -> Result<Vec<f64>, Error> {
        Ok(computed(&self.map(|quantity| quantity.draw(random)))?.into_iter().map(|c| c.value).collect())
    }

    /// Bound on `|2 s^ZZ - s^XX - s^YY| / eta` by Eq. (41) with a given `I^zz / C` (s^2).
    pub fn bound_over_eta(&self, inertia_over_c: f64) -> Result<f64, Error> {
        let values = self.map(|quantity| quantity.value);
        drift(&values, inertia_over_c)?.combination_bound(1.0)
    }

    /// Change of `lambda` (deg) by Eq. (42).
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
    let figure = |key, label: String, value| Computed { key, label, value };
    let mut figures = vec![figure("lambda_change", "Delta lambda [1e-3 deg]".to_owned(), change_of_lambda(p)? * 1e3)];
    if let Inertia::Uniform { density, oblateness } = p.inertia {
        let stated = inertia_over_c_estimate(density * GRAM_PER_CUBIC_CENTIMETRE, oblateness);
        let over_eta = drift(p, stated)?.combination_bound(S::one())?;
        figures.push(figure("inertia_over_c_stated", "(a) I^zz/C [s^2], stated: Eq. (43)".to_owned(), stated));
        figures.push(figure("bound_over_eta_stated", "(a) bound / eta".to_owned(), over_eta));
    }
    let (own, origin) = match p.inertia {
        Inertia::Given(given) => (given, "given"),
        Inertia::Uniform { .. } | Inertia::Fluid => (fluid_inertia_over_c(spin(p)), "own deformation: 4/Omega^2"),
    };
    let over_eta = drift(p, own)?.combination_bound(S::one())?;
    figures.push(figure("inertia_over_c_own", format!("(b) I^zz/C [s^2], {origin}"), own));
    figures.push(figure("bound_over_eta_own", "(b) bound / eta".to_owned(), over_eta));
    if let Some(speed) = p.speed {
        // The bound depends only on the length of w.
        let w = Vector3::new(S::zero(), S::zero(), speed * KILOMETRE);
        let alpha_2 = preferred_frame_bound(over_eta, &w)?;
        figures.push(figure("alpha_2_over_eta_own", "(b) |alpha_2| / eta".to_owned(), alpha_2));
    }
    Ok(figures)
}
