//! The input of every motion: a spheroid, optionally with a centrifugal bulge, the tensor `s^IJ` and the initial state.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, BodyState, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::ensure_symmetric;
use crate::numerics::scalar::{Real, Scalar, real_part};

/// A spheroid, the tensor `s^IJ` and the initial state, all in one arbitrary inertial frame.
///
/// ```
/// use twofold::dynamics::{Problem, RigidSpheroid};
/// use twofold::euler_angles::{EulerAngles, EulerRates};
/// use twofold::lorentz_violation::PrincipalCoefficients;
/// use twofold::propagation::Motion;
///
/// let star = RigidSpheroid::in_units_of_tc(1.1);
/// let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).tensor();
/// let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
/// let problem = Problem::from_angles(star, s, &angles, &EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 })?;
/// let motion = problem.motion((0.0, 100.0), 1e-12)?;
/// assert!((motion.state(100.0)?.axis.norm() - 1.0).abs() < 1e-12);
/// # Ok::<(), twofold::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem<S, X = BodyState<S>> {
    spheroid: RigidSpheroid<S>,
    coefficients: Matrix3<S>,
    bulge: S,
    initial: X,
}

impl<S: Scalar, X: RotationState<S>> Problem<S, X> {
    /// The body.
    pub fn spheroid(&self) -> &RigidSpheroid<S> {
        &self.spheroid
    }

    /// The tensor `s^IJ`.
    pub fn coefficients(&self) -> &Matrix3<S> {
        &self.coefficients
    }

    /// The coefficient `b` of the energy `b L.(s L)` of a centrifugal bulge ([`bulge`](crate::dynamics::bulge)); zero for a rigid spheroid.
    pub fn bulge(&self) -> S {
        self.bulge
    }

    /// The initial state.
    pub fn initial(&self) -> &X {
        &self.initial
    }

    /// The first `V` vectors of the initial state: `n`, `L` and, with `V = 3`, `e_x`.
    pub(crate) fn start<const V: usize>(&self) -> [Vector3<S>; V] {
        let vectors = self.initial.vectors();
        core::array::from_fn(|i| vectors[i])
    }

    /// The reduced problem: the motion of `n` and `L` alone. The rotation about the symmetry axis does not affect them here.
    pub fn reduced(&self) -> Problem<S, AxisState<S>> {
        self.carrying()
    }

    /// The same problem with the state converted to another type.
    pub(crate) fn carrying<Y: RotationState<S>>(&self) -> Problem<S, Y> {
        Problem {
            spheroid: self.spheroid,
            coefficients: self.coefficients,
            bulge: self.bulge,
            initial: Y::from_vectors(self.initial.vectors()),
        }
    }

    /// The same problem in another inertial frame: all vectors and `s^IJ` rotated by `other_from_this`.
    pub fn rotated(&self, other_from_this: &Matrix3<S>) -> Self {
        Self {
            coefficients: other_from_this * self.coefficients * other_from_this.transpose(),
            initial: self.initial.rotated(other_from_this),
            ..*self
        }
    }

    /// The same problem in another number type.
    pub fn map<T: Scalar>(&self, convert: impl Fn(S) -> T) -> Problem<T, X::In<T>> {
        Problem {
            spheroid: self.spheroid.map(&convert),
            coefficients: self.coefficients.map(&convert),
            bulge: convert(self.bulge),
            initial: X::In::<T>::from_vectors(self.initial.vectors().map(|vector| vector.map(&convert))),
        }
    }

    /// The problem of parts that have already been checked, or that are checked later by what is built from them.
    pub(crate) fn unchecked(spheroid: RigidSpheroid<S>, coefficients: Matrix3<S>, initial: X) -> Self {
        Self { spheroid, coefficients, bulge: S::zero(), initial }
    }
}

impl<S: Real, X: RotationState<S>> Problem<S, X> {
    /// The problem of a spheroid with the tensor `s^IJ` and the initial state `initial`.
    ///
    /// # Errors
    /// [`Error::Domain`] for a state or parameter that is not finite, an axis that is not a unit vector or not normal to `e_x` (to 1e-9),
    /// moments of inertia that are not positive, and a tensor that is not symmetric (to 1e-12).
    pub fn new(spheroid: RigidSpheroid<S>, coefficients: Matrix3<S>, initial: X) -> Result<Self, Error> {
        check(&spheroid, &coefficients, &initial)?;
        Ok(Self::unchecked(spheroid, coefficients, initial))
    }

    /// Sets the centrifugal bulge with the energy `b L.(s L)`, replacing any earlier one; `b` has the unit of one over a moment of inertia and is
    /// `1 / (4 I^xx)` for a fluid. Only the averaged motion and, within its bound, the free one can follow a star with a bulge; the other methods
    /// refuse it.
    ///
    /// # Errors
    /// [`Error::Domain`] for a number that is not finite.
    pub fn with_bulge(self, b: S) -> Result<Self, Error> {
        Error::ensure(b.re().is_finite(), "coefficient b of the bulge", b.re(), "a finite number")?;
        Ok(Self { bulge: b, ..self })
    }

    /// Refuses a star with a bulge.
    pub(crate) fn require_rigid(&self) -> Result<(), Error> {
        if self.bulge.re() == 0.0 {
            return Ok(());
        }
        Err(Error::Unsupported {
            what: "a star with a centrifugal bulge",
            why: "only the method \"averaged\" can compute its motion",
        })
    }

    /// The same star with another initial state.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn starting_from(&self, initial: X) -> Result<Self, Error> {
        Self::new(self.spheroid, self.coefficients, initial)?.with_bulge(self.bulge)
    }

    /// The problem for a state with `e_x`, which is chosen arbitrarily if the state has none.
    pub(crate) fn with_equatorial_axis(&self) -> Problem<S> {
        let mut problem: Problem<S> = self.carrying();
        if X::VECTORS < 3 {
            let axis = problem.initial.axis;
            let across = axis.cross(&Vector3::ith(real_part(&axis).iamin(), S::one()));
            problem.initial.equatorial_axis = across / crate::numerics::scalar::length(&across);
        }
        problem
    }
}

impl<S: Real> Problem<S> {
    /// The problem of a star with given initial Euler angles and rates.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn from_angles(
        spheroid: RigidSpheroid<S>,
        coefficients: Matrix3<S>,
        angles: &EulerAngles<S>,
        rates: &EulerRates<S>,
    ) -> Result<Self, Error> {
        Self::new(spheroid, coefficients, BodyState::from_angles(&spheroid, angles, rates))
    }
}

/// Refuses values that are not finite, vectors that do not form a frame, and values out of range.
fn check<S: Real, X: RotationState<S>>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, state: &X) -> Result<(), Error> {
    for inertia in [spheroid.inertia_xx.re(), spheroid.inertia_zz.re()] {
        Error::ensure(inertia > 0.0 && inertia.is_finite(), "moment of inertia", inertia, "above zero and finite")?;
    }
    let c = spheroid.constant_c.re();
    Error::ensure(c.is_finite(), "constant C of the anisotropic self-energy", c, "a finite number")?;
    for entry in s.iter() {
        Error::ensure(entry.re().is_finite(), "entry of s^IJ", entry.re(), "a finite number")?;
    }
    ensure_symmetric(s)?;
    let [axis, momentum, equatorial_axis] = state.vectors().each_ref().map(real_part);
    for component in momentum.iter() {
        Error::ensure(component.is_finite(), "component of L", *component, "a finite number")?;
    }
    let unit = |vector: &Vector3<f64>, name| {
        let length = vector.norm();
        Error::ensure((length - 1.0).abs() < 1e-9, name, length, "1 to within 1e-9")
    };
    unit(&axis, "length of the axis n")?;
    if X::VECTORS == 3 {
        unit(&equatorial_axis, "length of the axis e_x")?;
        let overlap = axis.dot(&equatorial_axis);
        Error::ensure(overlap.abs() < 1e-9, "n . e_x", overlap, "zero to within 1e-9")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body frame has right angles: 60 degrees between n and e_x are refused, and so are 120.
    #[test]
    fn an_equatorial_axis_at_any_other_angle_is_refused() {
        let star = RigidSpheroid::in_units_of_tc(1.1);
        let at = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (equatorial_axis, momentum) = (Vector3::new(sin, 0.0, cos), Vector3::new(0.3, -0.7, 1.1));
            Problem::new(star, Matrix3::zeros(), BodyState { axis: Vector3::z(), momentum, equatorial_axis }).is_ok()
        };
        assert_eq!([0.0, 60.0, 90.0, 120.0, 180.0].map(at), [false, false, true, false, false]);
    }

    #[test]
    fn an_equatorial_axis_is_chosen_only_where_there_is_none() {
        let star = RigidSpheroid::in_units_of_tc(1.1);
        for axis in [Vector3::x(), Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.48, -0.64, 0.6)] {
            let state = AxisState { axis, momentum: Vector3::new(0.3, -0.7, 1.1) };
            let chosen = Problem::new(star, Matrix3::zeros(), state).unwrap().with_equatorial_axis();
            assert!(check(&star, chosen.coefficients(), chosen.initial()).is_ok());
            let other = BodyState { equatorial_axis: -chosen.initial().equatorial_axis, ..*chosen.initial() };
            assert_eq!(chosen.starting_from(other).unwrap().with_equatorial_axis().initial(), &other);
        }
    }
}
