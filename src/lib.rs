//! The rotation of spheroidal neutron stars under Lorentz violation: motions, observables, gradients of both, and fits.
//!
//! The model is that of Xu, Gao and Shao, *Precession of spheroids under Lorentz violation and observational consequences for neutron
//! stars* ([arXiv:2012.01320](https://arxiv.org/abs/2012.01320)). Every numbered equation except the action is a function, generic over the scalar type,
//! with its number and LaTeX label. Nothing here reads a file, prints or starts a thread.
//!
//! ```
//! use twofold::{Beam, EulerAngles, EulerRates, Observer, PrincipalCoefficients, Problem, RigidSpheroid, pulse_train};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1); // I^zz / I^xx = 1.1
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).tensor();
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.0 };
//! let rates = EulerRates { alpha: 1.5, beta: 0.1, gamma: -0.1 };
//! let motion = Problem::from_angles(star, s, &angles, &rates)?.motion((0.0, 200.0), 1e-13)?;
//! let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0)); // chi, delta, rho; theta_o, phi_o
//! let pulses = pulse_train(&motion, &beam, &observer.direction, (0.0, 200.0))?;
//! let (first, last) = (pulses.durations().next(), pulses.durations().last());
//! assert!(first.zip(last).is_some_and(|(first, last)| (first.value - last.value).abs() > 1e-3)); // the width changes
//! # Ok::<(), twofold::Error>(())
//! ```
//!
//! | to get | begin with |
//! |---|---|
//! | the motion of a star | [`Problem::motion`], [`Motion`], [`propagation`] |
//! | what is computed, how, and at what cost | [`Problem::plan`], [`plan`] |
//! | pulses, arrival times, position angles | [`pulse_train`], [`observables::pulsar`] |
//! | pulsars that slow down | [`spin_down`], [`observables::pulsar::PulsarClock::braked`] |
//! | phases of a pulsar for timing programs, with derivatives | [`observables::pulsar::timing_model`], [`inference::fit_timing`] |
//! | spectral lines and fundamental frequencies | [`observables::spectrum`] |
//! | gravitational waves | [`observables::gravitational_wave`] |
//! | bounds on `s^IJ` from pulsars | [`observables::bound`], [`observables::eta_distribution`] |
//! | gradients | [`plan::gradient`], or any function with [`num_dual`] numbers |
//! | fits to data, Fisher matrices, forecasts | [`inference`], [`parameters`] |
//! | solutions in closed form | [`solutions`] |
//! | the paper's equations one by one | [`dynamics`], [`euler_angles`], [`lorentz_violation`], [`curvature_coupling`] |
//! | moments of inertia and `C` of a star | [`star`] |
//!
//! Conventions: `G = c = 1`, in any consistent units; those of the paper have `I^xx = C = 1` and time in `t_c`
//! ([`units`] has SI, CGS and geometrised ones). Angles are in rad. `X, Y, Z` is the inertial frame in which
//! `s^IJ` is given, its principal one in the paper; `x, y, z` is fixed in the body, with `z` the symmetry axis.

pub mod curvature_coupling;
pub mod dynamics;
pub mod epoch;
pub mod error;
pub mod euler_angles;
pub mod inference;
pub mod lorentz_violation;
pub mod numerics;
pub mod observables;
pub mod parameters;
pub mod plan;
pub mod propagation;
pub mod solutions;
pub mod spin_down;
pub mod star;
pub mod units;

pub use dynamics::{AxisState, BodyState, Problem, RigidSpheroid};
pub use error::Error;
pub use euler_angles::{EulerAngles, EulerRates};
pub use lorentz_violation::PrincipalCoefficients;
pub use numerics::scalar::{Real, Scalar};
pub use observables::Observer;
pub use observables::pulsar::{Beam, PulseTrain, arrivals, pulse_train};
pub use propagation::Motion;
pub use star::uniform_spheroid::UniformSpheroid;
pub use {nalgebra, num_dual};
