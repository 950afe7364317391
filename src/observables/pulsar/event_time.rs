//! Times of a pulse as functions of what they depend on: the implicit function theorem. Eq. (44).
//!
//! # Example
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use num_dual::Dual64;
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::observables::Observer;
//! use twofold::observables::pulsar::event_time::{closest_approach_time, edge_time, event_time};
//! use twofold::observables::pulsar::{Beam, pulse_train};
//! use twofold::propagation::Motion;
//!
//! // The root of t^2 = p at p = 4, by p: dt/dp = 1/4.
//! let root = event_time(2.0, Dual64::from_re(4.0) - Dual64::new(4.0, 1.0), 4.0)?;
//! assert_eq!((root.re, root.eps), (2.0, 0.25));
//! // The edge of a pulse by itself, where nothing carries a derivative.
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let motion = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?.taylor((0.0, 20.0), 1e-13)?;
//! let (beam, sight) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0).direction);
//! let pulse = pulse_train(&motion, &beam, &sight, (0.0, 20.0))?.pulses[1];
//! let (place, near) = ((motion.spheroid(), &s), pulse.midpoint());
//! let edge = edge_time(pulse.start, &beam, &sight, place, &motion.state(pulse.start)?)?;
//! assert!((edge - pulse.start).abs() < 1e-12);
//! assert!((closest_approach_time(near, &beam, &sight, place, &motion.state(near)?)? - near).abs() < 0.1);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use super::Beam;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::numerics::scalar::Real;

/// The root `t` of `f(t, p) = 0` as a function of the parameters `p`, to first order:
///
/// ```text
/// dt/dp = -(df/dp) / (df/dt)
/// ```
///
/// `t` is a root to rounding, `value` is `f` at that fixed time with its derivatives by `p`, and `rate` is `df/dt` there. This is
/// one step of Newton's method in numbers that carry derivatives; its real part moves `t` by what rounding had left.
///
/// # Errors
/// [`Error::Domain`] for a rate of zero or one that is not finite: the root is a touch, and no function of `p`.
pub fn event_time<S: Real>(t: f64, value: S, rate: f64) -> Result<S, Error> {
    Error::ensure(rate.abs() > 0.0 && rate.is_finite(), "rate at a root", rate, "finite and not zero: no touch")?;
    Ok(S::from_f64(t) - value / rate)
}

/// Time at which the line of sight (unit vector `n`) crosses the edge of a beam, `m.n = cos(rho)`, Eq. (44) `[ineq]`, with its first
/// derivatives.
///
/// `t` is that time and `state` the state at the fixed time `t`, with derivatives, as are body, tensor, beam and line of sight.
///
/// # Errors
/// [`Error::Domain`] where the line of sight only touches the edge.
pub fn edge_time<S: Real>(
    t: f64,
    beam: &Beam<S>,
    line_of_sight: &Vector3<S>,
    (spheroid, s): (&RigidSpheroid<S>, &Matrix3<S>),
    state: &BodyState<S>,
) -> Result<S, Error> {
    let [margin, rate, ..] = beam.margin_rates(spheroid, s, state, line_of_sight);
    event_time(t, margin, rate.re())
}

/// Time at which the magnetic axis is nearest to the line of sight, `d(m.n)/dt = 0`, with its first derivatives. Arguments as for
/// [`edge_time`].
///
/// # Errors
/// [`Error::Domain`] where the second derivative of `m.n` vanishes.
pub fn closest_approach_time<S: Real>(
    t: f64,
    beam: &Beam<S>,
    line_of_sight: &Vector3<S>,
    (spheroid, s): (&RigidSpheroid<S>, &Matrix3<S>),
    state: &BodyState<S>,
) -> Result<S, Error> {
    let [_, rate, second, _] = beam.margin_rates(spheroid, s, state, line_of_sight);
    event_time(t, rate, second.re())
}

#[cfg(test)]
mod tests {
    use num_dual::Dual64;

    use super::*;
    use crate::numerics::scalar::Scalar;

    /// `cos(p t) = 0` at `t = pi / (2 p)`.
    #[test]
    fn root_of_a_cosine_moves_as_the_inverse_of_its_rate() {
        let (p, t) = (1.7, core::f64::consts::FRAC_PI_2 / 1.7);
        let (_, value) = (Dual64::new(p, 1.0) * t).sin_cos();
        let time = event_time(t, value, -p * (p * t).sin()).unwrap();
        assert!((time.re - t).abs() < 1e-15);
        assert!((time.eps + t / p).abs() < 1e-15);
        for rate in [0.0, f64::NAN, f64::INFINITY] {
            assert!(event_time(t, value, rate).is_err());
        }
    }
}
