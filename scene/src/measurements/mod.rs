//! Measurements of a scene: arguments, tables of data, simulated errors.

mod data_file;
mod errors;
mod measurement;
mod timing_data;

pub use data_file::DataFile;
pub use errors::{add_timing_noise, beside, with_noise};
pub use measurement::{LeftOut, Measurement, named};
pub use timing_data::{measured_twice, read_timing};

use twofold::Error;
use twofold::inference::{Noise, Observable};
use twofold::parameters::Parameters;

use crate::scene_file::Scene;

const POLE: &str =
    "above 1e-6; on a pole the angles cannot be parameters. Turn the start, s^IJ and the observer away from Z together";

/// The parameters of a scene in units `I^xx = C = 1`, time in `t_c`; `Omega^z` is held fixed when others change. A beam or an observer that the
/// scene lacks gets placeholder values: data that need them cannot be observed (see [`missing_section`]).
///
/// # Errors
/// A scene that starts at a pole or within 1e-6 rad of it, where its angles cannot serve as parameters.
pub fn parameters_of(scene: &Scene) -> Result<Parameters<f64>, Error> {
    let angles = scene.initial_angles;
    let sine = angles.beta.sin();
    Error::ensure(sine > 1e-6, "sin(beta) at the start", sine, POLE)?;
    let rates = scene.problem.initial().rates(scene.problem.spheroid())?;
    let mut parameters =
        Parameters::new(*scene.problem.spheroid(), *scene.problem.coefficients(), angles, rates).with_fixed_spin();
    parameters.bulge = scene.problem.bulge();
    if let Some(pulsar) = scene.pulsar {
        (parameters.chi, parameters.delta, parameters.rho) = (pulsar.chi, pulsar.delta, pulsar.rho);
    }
    if let Some(observer) = scene.observer {
        (parameters.theta_o, parameters.phi_o) = (observer.theta_o, observer.phi_o);
        parameters.strain_unit = scene.strain_unit();
    }
    Ok(parameters)
}

/// The section that the scene lacks for this kind of data, if any.
pub fn missing_section(scene: &Scene, observable: Observable) -> Option<&'static str> {
    if scene.observer.is_none() {
        return Some("observer");
    }
    (observable.is_of_pulses() && scene.pulsar.is_none()).then_some("pulsar")
}

/// Allowed standard deviations: the sums of squares of data in units of these neither overflow nor vanish.
const SIGMAS: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Parses `name:sigma,name:sigma`, in units of the scene's output; `strain` means both polarizations.
///
/// # Errors
/// An unknown or repeated name, or a standard deviation that is not from 1e-100 to 1e100; the error names the value and the allowed range.
pub fn parse_noise(text: &str, allowed: &[Observable], time_unit: f64) -> Result<Vec<Noise>, String> {
    let mut found: Vec<Noise> = Vec::new();
    for part in text.split(',') {
        let (name, sigma) = part.trim().split_once(':').ok_or_else(|| {
            format!(
                "`{part}` is not NAME:SIGMA; expected a name, a colon and a standard deviation, such as arrivals:1e-6"
            )
        })?;
        let kinds: Vec<Observable> = match name {
            "strain" => vec![Observable::StrainPlus, Observable::StrainCross],
            name => Observable::ALL.into_iter().filter(|kind| kind.key() == name).collect(),
        };
        if kinds.is_empty() || !kinds.iter().all(|kind| allowed.contains(kind)) {
            let mut names: Vec<_> = allowed.iter().map(|kind| kind.key()).collect();
            names.extend(allowed.contains(&Observable::StrainPlus).then_some("strain"));
            return Err(format!("`{name}`: must be one of {}", names.join(", ")));
        }
        let sigma: f64 = match sigma.parse() {
            Ok(sigma) if SIGMAS.contains(&sigma) => sigma,
            _ => {
                let (least, most) = (SIGMAS.start(), SIGMAS.end());
                return Err(format!(
                    "`{part}` has the standard deviation {sigma}: must be a number from {least:e} to {most:e}"
                ));
            }
        };
        for kind in kinds {
            if found.iter().any(|(other, _)| *other == kind) {
                return Err(format!("`{}` is given twice", kind.key()));
            }
            found.push((kind, if kind.is_of_pulses() { sigma / time_unit } else { sigma }));
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strain_is_one_of_the_kinds_where_its_polarizations_are() {
        let refused = |allowed| parse_noise("wind:1", allowed, 1.0).unwrap_err();
        assert!(refused(&Observable::ALL).ends_with(", strain"), "{}", refused(&Observable::ALL));
        assert_eq!(refused(&[Observable::Widths]), "`wind`: must be one of widths");
    }

    #[test]
    fn parameters_are_those_of_the_scene_off_the_poles() {
        let mut scene = Scene::named("b1828-11").unwrap();
        for (beta, is_taken) in [(1e-5, true), (1e-7, false), (std::f64::consts::FRAC_PI_2, true)] {
            scene.initial_angles.beta = beta;
            assert_eq!(parameters_of(&scene).is_ok(), is_taken, "{beta}");
        }
        // A fluid bulge is a quarter of 1 / I^xx.
        let found = parameters_of(&scene).unwrap();
        assert!((found.bulge * found.spheroid.inertia_xx - 0.25).abs() < 1e-16);
    }
}
