//! Times of a pulse with their derivatives with respect to parameters, from the implicit function theorem. Eq. (44).
//!
//! ```
//! use num_dual::Dual64;
//! use twofold::observables::pulsar::event_time::event_time;
//!
//! // The root of t^2 = p at p = 4, by p: dt/dp = 1/4.
//! let root = event_time(2.0, Dual64::from_re(4.0) - Dual64::new(4.0, 1.0), 4.0)?;
//! assert_eq!((root.re, root.eps), (2.0, 0.25));
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::error::Error;
use crate::numerics::scalar::Real;

/// The root `t` of `f(t, p) = 0` as a function of the parameters `p`, to first order:
///
/// ```text
/// dt/dp = -(df/dp) / (df/dt)
/// ```
///
/// `t` is a root to rounding, `value` is `f` at that fixed time with its derivatives with respect to `p`, and `rate` is `df/dt`
/// there. This is one step of Newton's method in numbers that carry derivatives; its real part corrects `t` for the remaining
/// rounding error.
///
/// With the [rates of the margin](super::Beam::margin_rates) `[f, f', f'', ..]` at `t`, an edge of a pulse, Eq. (44) `[ineq]`, is
/// `event_time(t, f, f'.re())`, and a closest approach `event_time(t, f', f''.re())`.
///
/// # Errors
/// [`Error::Domain`] for a rate of zero or one that is not finite: at a double root `t` is not a function of `p`.
pub fn event_time<S: Real>(t: f64, value: S, rate: f64) -> Result<S, Error> {
    Error::ensure(rate.abs() > 0.0 && rate.is_finite(), "rate at a root", rate, "finite and nonzero at a crossing")?;
    Ok(S::from_f64(t) - value / rate)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where `f` only touches zero its root is not a function of `p`.
    #[test]
    fn a_touch_has_no_derivative() {
        for rate in [0.0, f64::NAN, f64::INFINITY, -f64::INFINITY] {
            assert!(event_time(2.0, 1e-16, rate).is_err(), "{rate}");
        }
    }
}
