//! Spectra: every line of a function of the state, with its frequency, amplitude, phase and name.
//!
//! A motion is a function on a torus of angles that grow in proportion to time ([`TorusSolution`](crate::solutions::torus::TorusSolution)), so a
//! function of its state is a Fourier series of these angles, and each term is a line:
//!
//! ```text
//! f(t) = sum_m c_m exp(i m.theta(t)),    theta(t) = w t:    2 |c_m| cos(m.w t + arg c_m)
//! ```
//!
//! No time series is computed, so arbitrarily close lines are resolved.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::observables::spectrum::QuasiPeriodicMotion;
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let motion = QuasiPeriodicMotion::new(&Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?)?;
//! let list = motion.lines(1e-6, |state| Ok::<_, twofold::Error>([state.axis.x, 1.0]))?;
//! // n_X at any time is the constant term and the sum of the lines.
//! let at = |t: f64| list.constant + list.lines.iter().map(|line| line.value(t)).sum::<f64>();
//! assert!((at(0.0) - 0.6).abs() < 1e-4);
//! assert_eq!(list.lines[0].combination.to_string(), "alpha'");
//! # Ok::<(), twofold::Error>(())
//! ```

mod combination;
mod fundamental_frequencies;
mod lines;
mod quasi_periodic;
mod transform;

pub use combination::Combination;
pub use fundamental_frequencies::{FundamentalFrequencies, FundamentalFrequency};
pub use lines::{LineList, SpectralLine};
pub use quasi_periodic::QuasiPeriodicMotion;
