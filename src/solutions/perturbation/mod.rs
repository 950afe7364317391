//! Perturbation solutions about free precession (twofold) and about a stationary spin (single). Eqs. (27)-(34), (57).
//!
//! Each has two forms, which must not be confused:
//!
//! * [`Form::Printed`] — the paper's Eqs. (30) `[sol2]`, (31) `[consdef]`, (33) `[sol3]` as printed. They define the paper's
//!   examples and curves. They are not correct to first order: Eq. (29) `[eleq1]` sets `beta` to `beta_0` and so omits a term
//!   in `beta1`, see [`linearised`].
//! * [`Form::Corrected`] — the solutions of the full first-order equations. Their error is of second order.
//!
//! The expansion is to first order in `s` and in the tilt of the angular momentum for twofold precession, and in the ratio
//! `(s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)` for single precession.
//!
//! # Example
//!
//! ```
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::solutions::perturbation::linearised::{FirstOrderMotion, ZerothOrder, full_residuals, printed_residuals};
//! use twofold::solutions::perturbation::{Constants, Form, Precession, Perturbation, constants_from_initial_values, shifted_rates};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! // tp-I: constants to initial values and back.
//! let constants = Constants { alpha_0: 0.3, beta_0: 0.7, amplitude: 0.01, phase: 0.5 };
//! let start = Perturbation::new(Form::Printed, Precession::Twofold, &star, &s, 1.0, &constants)?.at(0.0);
//! let back = constants_from_initial_values(Form::Printed, Precession::Twofold, &star, &s, 1.0, &start)?;
//! assert!((back.beta_0 - constants.beta_0).abs() < 1e-12);
//! let solution = Perturbation::new(Form::Corrected, Precession::Twofold, &star, &s, 1.0, &constants)?;
//! assert!(solution.at(1.0).alpha > start.alpha);
//! assert!((shifted_rates(&star, &s, 1.0, 0.7)?.alpha - solution.rate).abs() < 1e-12);
//!
//! // Eq. (29) lacks a term.
//! let zeroth = ZerothOrder { kind: Precession::Twofold, spin: 1.0, alpha: 0.3, beta: 0.7 };
//! let first =
//!     FirstOrderMotion { beta: 0.01, alpha_rate: 0.0, beta_rate: 0.0, alpha_acceleration: 0.0, beta_acceleration: 0.0 };
//! assert_ne!(printed_residuals(&star, &s, &zeroth, &first), full_residuals(&star, &s, &zeroth, &first));
//! # Ok::<(), twofold::Error>(())
//! ```

mod constants;
mod initial_values;
pub mod linearised;
mod solution;

pub use constants::{Constants, Form, Precession};
pub use initial_values::constants_from_initial_values;
pub use solution::{Perturbation, ShiftedRates, shifted_rates};
