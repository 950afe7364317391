//! Numerics without physics: scalars, double-double arithmetic, rounding, elliptic functions, vector instructions.

pub(crate) mod arithmetic;
pub(crate) mod double_double;
pub mod elliptic;
#[cfg_attr(not(target_arch = "x86_64"), path = "unfused.rs")]
pub(crate) mod fused;
#[cfg(target_arch = "x86_64")]
pub(crate) mod registers;
pub(crate) mod rounding;
pub mod scalar;
