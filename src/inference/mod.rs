//! Parameter estimation: constraints on [`Parameters`](crate::parameters::Parameters), and so on s, from pulse times, widths and
//! strain.
//!
//! ```text
//! Parameters -> Signal (one motion) -> values of Data, and their Jacobian by exact derivatives
//!            -> Fisher: uncertainties, degenerate Directions, named        -> forecasts
//!            -> fit: least squares from a start, covariance by the Jacobian at the minimum
//! ```
//!
//! The formulas, the guarantees and the coverage of the error bars are in `docs/inference.md`.
//!
//! # Example
//!
//! ```
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::inference::{Fisher, Observable, Signal, data_of, fit, forecast, nonlinearity, scaling};
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::parameters::{Parameter, Parameters};
//!
//! let (star, s) = (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new([0.02, 0.01, -0.04]).tensor());
//! let (angles, rates) = (EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 }, EulerRates { alpha: 1.0, beta: 0.1, gamma: 0.2 });
//! let truth = Parameters { chi: 0.8, theta_o: 1.0, ..Parameters::new(star, s, angles, rates).with_fixed_spin() };
//! let signal = Signal::new(&truth, 60.0)?;
//! let (events, noise) = (signal.events()?, [(Observable::Arrivals, 1e-6)]);
//! let data = data_of(&signal, &events[1..], &[], &noise)?;
//! let unknowns = [Parameter::Spin, Parameter::SAxial];
//! let found = fit(&truth.moved(&unknowns, &[1e-4, -1e-4]), &data, &unknowns, 60.0)?;
//! assert!((found.fisher.values()[1] + 0.11).abs() < 0.01 * found.fisher.sigmas()[1]);
//! // Error bars hold where chi^2 is a parabola over them.
//! assert!(nonlinearity(&found.fisher, &data, 60.0)? < 0.1);
//! // Of the azimuth of the beam and that of the body such data determine only the sum of the two azimuths.
//! let fisher = Fisher::of(&truth, &events, &data, &[Parameter::Gamma, Parameter::Delta])?;
//! assert!(fisher.degenerate[0].to_string().starts_with("gamma against delta: only gamma + delta"));
//! // The uncertainty of the spin falls with the span.
//! let spans = [100.0, 200.0, 400.0];
//! let [by_span, _] = scaling(&forecast(&truth, &noise, &unknowns, Parameter::Spin, &spans, &[20])?);
//! assert!(by_span.is_some_and(|slope| slope.value < -0.8));
//! # Ok::<(), twofold::inference::InferenceError>(())
//! ```

mod degenerate;
mod error;
mod fisher;
mod fit;
mod forecast;
#[cfg(test)]
mod functions;
mod jacobian;
mod least_squares;
mod long_span;
mod model;
mod observables;
mod scaled_jacobian;
mod signal;
#[cfg(test)]
mod stars;
mod symmetry;
mod timing;
mod wobble_limit;
mod wobble_posterior;

pub use degenerate::Direction;
pub use error::InferenceError;
pub use fisher::Fisher;
pub use fit::{fit, nonlinearity};
pub use forecast::{ALLOWED_IN_FORECASTS, Forecast, forecast, scaling};
pub use jacobian::{Jacobian, jacobian};
pub use least_squares::{Fit, Residuals};
pub use long_span::{check_span, is_long};
pub use model::{Model, Unknown};
pub use observables::{Datum, Noise, Observable, Place, data_of};
pub use signal::{Event, Signal, time_for_a_pulse};
pub use symmetry::Symmetry;
pub use timing::{MeasuredArrival, MeasuredWidth, Prior, TimingData, fit_timing, timing_fisher, timing_nonlinearity};
pub use wobble_limit::{WobbleLimit, wobble_limits};
pub use wobble_posterior::WobblePosterior;
