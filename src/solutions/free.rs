//! Rotation without Lorentz violation, exact at any time. Eq. (48).
//!
//! # Example
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::dynamics::{BodyState, RigidSpheroid};
//! use twofold::euler_angles::EulerAngles;
//! use twofold::solutions::free::{free_precession_rates, free_rotation, rotated_by};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! // L along Z: alpha and gamma advance steadily.
//! let rates = free_precession_rates(&star, 1.0, angles.beta)?;
//! let start = BodyState::from_angles(&star, &angles, &rates);
//! let later = free_rotation(&star, &start, 2.0);
//! assert!((later.angles()?.alpha - (angles.alpha + 2.0 * rates.alpha)).sin().abs() < 1e-14);
//! assert!((rotated_by(&Vector3::new(0.0, 0.0, 1.0), &Vector3::x()).y - 1.0_f64.sin()).abs() < 1e-15);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::Vector3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::euler_angles::EulerRates;
use crate::numerics::scalar::{Real, Scalar, length};

/// Euler rates of free precession about `Z`, Eq. (48) `[angfreqfre]`: `a' = I^zz Omega^z / (I^xx cos b)`, `b' = 0`,
/// `g' = -epsilon Omega^z`.
///
/// # Errors
/// [`Error::Domain`] where `|cos beta|` is not above 2.2e-16: with the axis normal to the angular momentum there is no spin
/// component to fix the rate.
pub fn free_precession_rates<S: Real>(spheroid: &RigidSpheroid<S>, spin: S, beta: S) -> Result<EulerRates<S>, Error> {
    let (_, cb) = beta.sin_cos();
    Error::ensure(
        cb.re().abs() > f64::EPSILON,
        "cosine of the inclination, cos beta",
        cb.re(),
        "above 2.2e-16 in size; Eq. (48) divides by it",
    )?;
    Ok(EulerRates {
        alpha: spheroid.free_precession_constant(spin) / cb,
        beta: S::zero(),
        gamma: -(spheroid.oblateness() * spin),
    })
}

/// The state after free motion over the time `t` from any state: `n` and `e_x` rotate about the constant `L` at the rate `|L| / I^xx`, and `e_x`
/// rotates about `n` at the rate `-epsilon Omega^z`. Regular for every orientation and for `L = 0`.
///
/// Error: a few ulp of one plus the rounding of the angle `|L| t / I^xx`, which must be below 1e150 rad.
pub fn free_rotation<S: Real>(spheroid: &RigidSpheroid<S>, initial: &BodyState<S>, t: S) -> BodyState<S> {
    let turned = normal_turned_about(
        &initial.axis,
        &initial.equatorial_axis,
        spheroid.rate_about_axis(&initial.axis, &initial.momentum) * t,
    );
    let turn = initial.momentum * (t / spheroid.inertia_xx);
    BodyState {
        axis: rotated_by(&turn, &initial.axis),
        momentum: initial.momentum,
        equatorial_axis: rotated_by(&turn, &turned),
    }
}

/// `normal`, a vector at a right angle to the unit vector `axis`, turned about it by `angle` (rad).
pub(crate) fn normal_turned_about<S: Scalar>(axis: &Vector3<S>, normal: &Vector3<S>, angle: S) -> Vector3<S> {
    let (sin, cos) = angle.sin_cos();
    normal * cos + axis.cross(normal) * sin
}

/// `v` rotated by the rotation vector `turn` (axis times angle, below 1e150 rad so that its square is finite). The zero vector gives the identity,
/// with correct derivatives.
pub fn rotated_by<S: Real>(turn: &Vector3<S>, v: &Vector3<S>) -> Vector3<S> {
    let angle_squared = turn.dot(turn);
    // Below this the series is exact to rounding and, unlike the square root, has derivatives at zero.
    let (sinc, half) = if angle_squared.re() < 1e-4 {
        let x = angle_squared;
        let one = S::one();
        (
            one - x / 6.0 * (one - x / 20.0 * (one - x / 42.0 * (one - x / 72.0))),
            (one - x / 12.0 * (one - x / 30.0 * (one - x / 56.0 * (one - x / 90.0)))) / 2.0,
        )
    } else {
        let angle = length(turn);
        let (sin, _) = angle.sin_cos();
        let (sin_half, _) = (angle / 2.0).sin_cos();
        (sin / angle, sin_half * sin_half * 2.0 / angle_squared)
    };
    let across = turn.cross(v);
    v + across * sinc + turn.cross(&across) * half
}

#[cfg(test)]
mod tests {
    use num_dual::{Dual3, Dual64};

    use super::*;

    type Fourth = Dual3<Dual64>;
    type Seventh = Dual3<Fourth>;
    type Tenth = Dual3<Seventh>;

    /// At angle zero only the last terms of both series, those of sine and cosine, determine these derivatives.
    #[test]
    fn a_rotation_by_nothing_has_ten_derivatives() {
        let inner = Fourth::from_re(Dual64::from(0.0).derivative()).derivative();
        let t = Tenth::from_re(Seventh::from_re(inner).derivative()).derivative();
        let constant = |v: [f64; 3]| Vector3::from(v.map(Tenth::from));
        let found = rotated_by(&(constant([0.0, 0.0, 1.0]) * t), &constant([1.0, 0.0, 0.0]));
        assert!((found.y.v3.v3.v3.re - 1.0).abs() < 1e-12, "{}", found.y.v3.v3.v3.re);
        assert!((found.x.v3.v3.v3.eps + 1.0).abs() < 1e-12, "{}", found.x.v3.v3.v3.eps);
    }
}
