//! Motion of `(n, L)` by splitting its Hamiltonian into an exact rotation of `n` about `L` and an exact kick of `L` at constant `n`.
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! use twofold::propagation::splitting::{
//!     SRKN_14A, Splitting, propagate_by_best_splitting, propagate_by_splitting, propagate_orientation_by_best_splitting,
//!     propagate_orientation_by_splitting, splitting_forecast,
//! };
//! use twofold::propagation::{AxisMotion, AxisState, Motion};
//!
//! let (tensor, axis, span) = (s.tensor(), AxisState::from(&state), (0.0, 50.0));
//! let forecast = splitting_forecast(&star, &tensor, &axis, span, 1e-10)?;
//! let best = propagate_by_best_splitting(&star, &tensor, &axis, span, 1e-10)?;
//! assert_eq!(best.scheme().name, forecast.scheme.name);
//! let end = propagate_orientation_by_best_splitting(&star, &tensor, &state, span, 1e-10)?.state(50.0)?;
//! assert!((best.axis_state(50.0)?.axis - end.axis).amax() < 1e-8);
//!
//! // A scheme and a step of one's own choice, with or without e_x, and for ever.
//! let own = propagate_by_splitting(&star, &tensor, &axis, span, &SRKN_14A, 0.1)?;
//! let with_e_x = propagate_orientation_by_splitting(&star, &tensor, &state, span, &SRKN_14A, 0.1)?;
//! assert!((own.axis_state(50.0)?.axis - with_e_x.state(50.0)?.axis).amax() < 1e-12);
//! let mut steps = Splitting::new(&star, &tensor, &axis, &SRKN_14A, 0.1)?;
//! steps.advance(500);
//! assert!((steps.state().axis - end.axis).amax() < 1e-8);
//! # Ok::<(), twofold::Error>(())
//! ```

mod choice;
#[cfg(target_arch = "x86_64")]
pub(crate) mod derivatives;
mod error;
mod flows;
#[cfg(target_arch = "x86_64")]
pub(super) mod lanes;
mod motion;
mod one_motion;
pub(super) mod ring;
mod scheme;
mod schemes;
#[cfg(target_arch = "x86_64")]
mod side_by_side;
mod stepper;
mod stepping;
#[cfg(target_arch = "x86_64")]
mod tangents;

pub use choice::{
    SplittingForecast, propagate_by_best_splitting, propagate_orientation_by_best_splitting, splitting_forecast,
};
pub(crate) use choice::{TANGENTS_AT_ONCE, require_tangent_maps, splitting_forecast_with_derivatives};
pub use motion::{SPLITTING_STEP_LIMIT, SplittingMotion, propagate_by_splitting, propagate_orientation_by_splitting};
pub use scheme::{Ends, Scheme};
pub use schemes::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, KAHAN_LI_8, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SCHEMES,
    SRKN_6B, SRKN_14A, STRANG,
};
pub use stepping::Splitting;
