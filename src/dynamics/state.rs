//! States of rotation, with and without the angle about the symmetry axis.

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::BodyState;
use crate::numerics::scalar::{Real, Scalar, length};

/// State of the reduced motion of a spheroid in inertial components. Its potential energy, spin axis and gravitational wave
/// depend only on this; the rotation about the symmetry axis is left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisState<S> {
    /// Symmetry axis `n = e_z`, a unit vector.
    pub axis: Vector3<S>,
    /// Angular momentum `L`.
    pub momentum: Vector3<S>,
}

/// A state of rotation: [`AxisState`] or [`BodyState`]. The type of the state of a [`Problem`](super::Problem) decides whether its
/// motions follow the angle about the symmetry axis.
pub trait RotationState<S: Scalar>: Copy + Debug + PartialEq + 'static {
    /// Number of vectors: two or three.
    const VECTORS: usize;

    /// The same state in another number type.
    type In<T: Scalar>: RotationState<T>;

    /// `n`, `L` and `e_x`; `e_x` is zero if the state does not have it.
    fn vectors(&self) -> [Vector3<S>; 3];

    /// The state with the given `n`, `L` and `e_x`; `e_x` is ignored if the state does not have it.
    fn from_vectors(vectors: [Vector3<S>; 3]) -> Self;

    /// The same state in another inertial frame: every vector multiplied by the rotation `other_from_this`.
    #[inline]
    fn rotated(&self, other_from_this: &Matrix3<S>) -> Self {
        Self::from_vectors(self.vectors().map(|vector| other_from_this * vector))
    }

    /// The state with `n` and `e_x` made of length one and normal to each other again: errors of a numerical motion change both a little.
    fn orthonormal(&self) -> Self
    where
        S: Real,
    {
        let [axis, momentum, equatorial_axis] = self.vectors();
        let axis = axis / length(&axis);
        let across = equatorial_axis - axis * axis.dot(&equatorial_axis);
        let equatorial_axis = if Self::VECTORS == 3 { across / length(&across) } else { across };
        Self::from_vectors([axis, momentum, equatorial_axis])
    }

    /// `n` and `L`.
    #[inline]
    fn axis_state(&self) -> AxisState<S> {
        AxisState::from_vectors(self.vectors())
    }
}

impl<S: Scalar> RotationState<S> for AxisState<S> {
    const VECTORS: usize = 2;
    type In<T: Scalar> = AxisState<T>;

    #[inline]
    fn vectors(&self) -> [Vector3<S>; 3] {
        [self.axis, self.momentum, Vector3::zeros()]
    }

    #[inline]
    fn from_vectors([axis, momentum, _]: [Vector3<S>; 3]) -> Self {
        Self { axis, momentum }
    }
}

impl<S: Scalar> RotationState<S> for BodyState<S> {
    const VECTORS: usize = 3;
    type In<T: Scalar> = BodyState<T>;

    #[inline]
    fn vectors(&self) -> [Vector3<S>; 3] {
        [self.axis, self.momentum, self.equatorial_axis]
    }

    #[inline]
    fn from_vectors([axis, momentum, equatorial_axis]: [Vector3<S>; 3]) -> Self {
        Self { axis, momentum, equatorial_axis }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// `n` keeps its direction, and `e_x` its plane with `n`; a state without `e_x` has none afterwards either.
    #[test]
    fn a_state_is_made_orthonormal() {
        let (n, across) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.0, 1.0, 0.0));
        let momentum = Vector3::new(0.3, -0.7, 1.1);
        let off = BodyState { axis: n * 1.01, momentum, equatorial_axis: across * 0.98 + n * 0.03 };
        let BodyState { axis, momentum: kept, equatorial_axis } = off.orthonormal();
        assert_relative_eq!(axis, n, max_relative = 1e-15);
        assert_relative_eq!(equatorial_axis, across, epsilon = 1e-15);
        assert_eq!(kept, momentum);
        let reduced = off.axis_state().orthonormal();
        assert_eq!((reduced.axis, reduced.momentum), (axis, momentum));
    }
}
