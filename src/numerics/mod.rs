//! Numerics without physics: scalars, sums, roots, elliptic functions, vector instructions.

pub mod angle;
pub(crate) mod arithmetic;
pub(crate) mod compensated;
pub(crate) mod double_double;
pub mod elliptic;
mod field_operators;
pub(crate) mod four_lanes;
#[cfg_attr(not(target_arch = "x86_64"), path = "unfused.rs")]
pub(crate) mod fused;
pub(crate) mod gauss;
pub(crate) mod hermite;
pub(crate) mod pairs;
pub(crate) mod polynomial;
#[cfg(target_arch = "x86_64")]
pub(crate) mod registers;
pub(crate) mod ring;
pub(crate) mod rounding;
pub mod scalar;
#[cfg(target_arch = "x86_64")]
pub(crate) mod side_by_side;
pub mod straight_line;
