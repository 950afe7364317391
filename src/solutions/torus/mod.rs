//! Invariant tori of the motion: the exact motion at any time, its frequencies, and states with given first integrals.
//!
//! `(n, L)` has the commuting integrals `H` and `K` ([`clebsch`](crate::dynamics::first_integrals::FirstIntegrals::clebsch)), so it moves on
//! tori of two dimensions; the turn about `n`, moved by `L.n`, makes the third. `docs/exact-motion.md` derives the solution.
//!
//! # Example
//!
//! ```
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::dynamics::first_integrals::first_integrals;
//! use twofold::solutions::torus::{TorusSolution, separatrix_motion, states_with_integrals};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! let problem = Problem::new(star, s.tensor(), state)?;
//! // The state after 1e12 t_c: its integrals are those of the start.
//! let solution = TorusSolution::new(&problem, 1e-12, 1e12)?;
//! let late = first_integrals(&star, &s.tensor(), &solution.state([1e12, 0.0]));
//! assert!(solution.error_estimate(1e12) < 1e-12);
//! assert!((late.energy - first_integrals(&star, &s.tensor(), &state).energy).abs() < 1e-12);
//! // A state with the same integrals lies on the same torus.
//! let integrals = first_integrals(&star, &s.tensor(), &state);
//! let other = states_with_integrals(&star, &s, &integrals)?.states[0];
//! let rates = TorusSolution::new(&problem.starting_from(other)?, 1e-12, 1.0)?.rates();
//! assert!((rates[1].abs() / solution.rates()[1].abs() - 1.0).abs() < 1e-9);
//! let unstable = separatrix_motion(&star, &s, integrals.energy, integrals.spin)?;
//! assert!((first_integrals(&star, &s.tensor(), &unstable).energy - integrals.energy).abs() < 1e-9);
//! # Ok::<(), twofold::Error>(())
//! ```

mod angles;
mod derivative;
mod flow;
mod flow_series;
mod found;
mod fourier;
mod phase;
mod plane;
mod polynomial;
mod sampling;
mod separatrix;
mod solution;
mod states;
mod table;
mod walk;
mod ways;
mod wide;

pub use derivative::{TorusDerivative, error_of_derivatives};
pub use separatrix::separatrix_motion;
pub use solution::TorusSolution;
pub use states::{TorusStates, states_with_integrals};
