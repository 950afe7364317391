//! What a distant observer measures. Eqs. (37)-(42), (44)-(56), (59), (69)-(71).

pub mod bound;
pub mod eta;
pub mod eta_distribution;
pub mod fundamental_frequencies;
pub mod gravitational_wave;
pub mod observer;
pub mod pulsar;
pub mod spectrum;
pub mod spin_axis;
pub mod wave_harmonics;

pub use observer::Observer;

use crate::numerics::scalar::Scalar;

/// Sine and cosine of `a + b` from those of each, as they are known in an exact field.
fn sin_cos_of_sum<S: Scalar>(a: S, b: S) -> (S, S) {
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
    (sa * cb + ca * sb, ca * cb - sa * sb)
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use crate::dynamics::{BodyState, RigidSpheroid};
    use crate::error::Error;
    use crate::propagation::Motion;

    /// A motion by a formula, whether a star could move so or not.
    pub(super) struct Made<F> {
        pub(super) spheroid: RigidSpheroid<f64>,
        pub(super) coefficients: Matrix3<f64>,
        pub(super) span: (f64, f64),
        pub(super) error: f64,
        pub(super) state: F,
    }

    impl<F> Made<F> {
        /// Of a spheroid in units of `t_c`, without violation or error.
        pub(super) fn new(span: (f64, f64), state: F) -> Self {
            let (spheroid, coefficients) = (RigidSpheroid::in_units_of_tc(1.1), Matrix3::zeros());
            Self { spheroid, coefficients, span, error: 0.0, state }
        }
    }

    impl<F: Fn(f64) -> Result<BodyState<f64>, Error>> Motion<f64> for Made<F> {
        type State = BodyState<f64>;

        fn spheroid(&self) -> &RigidSpheroid<f64> {
            &self.spheroid
        }

        fn coefficients(&self) -> &Matrix3<f64> {
            &self.coefficients
        }

        fn span(&self) -> (f64, f64) {
            self.span
        }

        fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
            let (from, to) = self.span;
            Error::ensure((from.min(to)..=from.max(to)).contains(&t), "time t", t, "in the span")?;
            (self.state)(t)
        }

        fn error_estimate(&self, _t: f64) -> f64 {
            self.error
        }
    }
}
