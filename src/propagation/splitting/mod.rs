//! Motion of `(n, L)` by splitting its Hamiltonian into an exact rotation of `n` about `L` and an exact kick of `L` at constant `n`.

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
pub use motion::{SPLITTING_STEP_LIMIT, SplittingMotion, propagate_by_splitting, propagate_orientation_by_splitting};
pub use scheme::{Ends, Scheme};
pub use schemes::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, KAHAN_LI_8, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SCHEMES,
    SRKN_6B, SRKN_14A, STRANG,
};
pub use stepping::Splitting;
