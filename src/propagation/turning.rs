//! The law by which the body of a motion rotates.

use nalgebra::Vector3;

use crate::error::Error;

/// The source of the angular velocity `Omega` (inertial components) of a [`Motion`](super::Motion) and of its time derivatives. A
/// search for pulses computes the derivatives of `m.n` from them.
///
/// Example: a star that is spun up and down by another torque, `Omega = (2 + 0.3 sin t) Z`:
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use twofold::Error;
/// use twofold::dynamics::{BodyState, RigidSpheroid};
/// use twofold::observables::pulsar::{Beam, pulse_train};
/// use twofold::propagation::{Motion, Turning};
///
/// struct Driven(RigidSpheroid<f64>, Matrix3<f64>);
///
/// impl Motion<f64> for Driven {
///     type State = BodyState<f64>;
///     fn spheroid(&self) -> &RigidSpheroid<f64> { &self.0 }
///     fn coefficients(&self) -> &Matrix3<f64> { &self.1 }
///     fn span(&self) -> (f64, f64) { (0.0, 100.0) }
///     fn error_estimate(&self, _t: f64) -> f64 { 1e-14 }
///
///     fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
///         let (sin, cos) = (2.0 * t + 0.3 * (1.0 - t.cos())).sin_cos();
///         let momentum = Vector3::z() * (self.0.inertia_zz * (2.0 + 0.3 * t.sin()));
///         Ok(BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::new(cos, sin, 0.0) })
///     }
///
///     fn turning(&self) -> Turning<'_> {
///         let rates = |t: f64| Ok([2.0 + 0.3 * t.sin(), 0.3 * t.cos(), -0.3 * t.sin()].map(|rate| Vector3::z() * rate));
///         Turning::Given { rates: Box::new(rates), bounds: [2.3, 0.3, 0.3, 0.3, 0.3, 0.3] }
///     }
/// }
///
/// let star = Driven(RigidSpheroid::in_units_of_tc(1.1), Matrix3::zeros());
/// let train = pulse_train(&star, &Beam::new(0.5, 0.0, 0.3), &Vector3::new(0.5_f64.sin(), 0.0, 0.5_f64.cos()), (0.0, 100.0))?;
/// // 200.04 rad are 31 whole turns and five sixths of one; the first pulse is cut by the start.
/// assert_eq!(train.pulses.len(), 32);
/// # Ok::<(), twofold::Error>(())
/// ```
pub enum Turning<'m> {
    /// The equations of motion of this package, [`body_state_rates`](crate::dynamics::equations_of_motion::body_state_rates), with the
    /// spheroid, the tensor and the states of the motion.
    Equations {
        /// Coefficient of a [`bulge`](crate::dynamics::bulge), whose terms are added.
        bulge: f64,
    },
    /// Another law, for example for a star with a torque of its own.
    Given {
        /// `Omega`, `Omega'` and `Omega''` at a time of the span. The body axes `u` of the states change by
        /// `u' = Omega x u`.
        rates: GivenRates<'m>,
        /// Bounds on `|Omega|`, `|Omega'|` and so on to the fifth derivative, valid at all times of the span.
        bounds: [f64; 6],
    },
}

/// `Omega`, `Omega'` and `Omega''` as functions of time.
pub type GivenRates<'m> = Box<dyn Fn(f64) -> Result<[Vector3<f64>; 3], Error> + 'm>;
