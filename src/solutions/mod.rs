//! Solutions in closed form, exact and perturbative. Eqs. (26)-(34), (48), (57).

pub mod averaged;
pub mod free;
pub mod perturbation;
pub mod steady;
pub mod symmetric;
pub mod torus;
