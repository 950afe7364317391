//! The averaged motion in closed form: its derivation, its errors and its derivatives.

pub(super) mod averaging;
pub(super) mod decades;
pub(super) mod derivatives;
pub(super) mod estimates;
pub(in crate::checks) mod orders;
mod scenes;
pub(super) mod top;
