//! Observables for a distant observer. Eqs. (37)-(42), (44)-(56), (59), (69)-(71).

pub mod bound;
pub mod eta;
pub mod eta_distribution;
pub mod gravitational_wave;
pub mod observer;
pub mod pulsar;
pub mod spectrum;
pub mod spin_axis;
pub mod wave_harmonics;

pub use observer::Observer;

use crate::numerics::scalar::Scalar;

/// Sine and cosine of `a + b` from those of `a` and `b`, in a form that holds in an exact field.
fn sin_cos_of_sum<S: Scalar>(a: S, b: S) -> (S, S) {
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
    (sa * cb + ca * sb, ca * cb - sa * sb)
}
