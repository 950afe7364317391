//! Coefficients for Lorentz violation `s^IJ`: principal values, principal frame, PPN replacement. Eqs. (5), (36).
//!
//! ```
//! use nalgebra::Vector3;
//! use num_dual::Dual64;
//! use twofold::lorentz_violation::{
//!     PrincipalCoefficients, SymmetryOfTensor, coefficients_from_preferred_frame, preferred_frame_parameter, principal_frame,
//!     principal_frame_along, principal_frame_with_derivatives,
//! };
//!
//! // Eq. (5): a preferred frame that the star moves through at w.
//! let w = Vector3::new(0.0, 0.0, 1.2e-3);
//! let s = coefficients_from_preferred_frame(0.1_f64, &w);
//! assert!((preferred_frame_parameter(&s, &w)? - 0.1).abs() < 1e-12);
//! assert!(SymmetryOfTensor::of(&s)?.asymmetry.norm() < 1e-20);
//! // Descending values, and the axes they belong to.
//! let given = PrincipalCoefficients::new([-0.04, 0.02, 0.01]).tensor();
//! let frame = principal_frame(&given)?;
//! assert_eq!(frame.coefficients, PrincipalCoefficients::new([0.02, 0.01, -0.04]));
//! let (coefficients, _) = principal_frame_with_derivatives(&given)?;
//! assert_eq!(coefficients, frame.coefficients);
//! let moving = given.map(Dual64::from_re) * Dual64::new(1.0, 1.0);
//! let (scaled, _) = principal_frame_along(&moving)?;
//! assert!((scaled.zz.eps + 0.04).abs() < 1e-15);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use num_dual::Dual64;

use crate::error::Error;
use crate::euler_angles::permuted_from_inertial;
use crate::numerics::scalar::{Real, Scalar};

/// Eigenvalues of `s^IJ` (dimensionless) along the axes X, Y, Z of its principal frame, the inertial frame of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalCoefficients<S> {
    /// `s^XX`.
    pub xx: S,
    /// `s^YY`.
    pub yy: S,
    /// `s^ZZ`.
    pub zz: S,
}

impl<S: Scalar> PrincipalCoefficients<S> {
    /// Principal values from the array `[s^XX, s^YY, s^ZZ]`.
    pub fn new([xx, yy, zz]: [S; 3]) -> Self {
        Self { xx, yy, zz }
    }

    /// The diagonal tensor `s^IJ` in the principal frame.
    pub fn tensor(&self) -> Matrix3<S> {
        Matrix3::from_diagonal(&Vector3::new(self.xx, self.yy, self.zz))
    }

    /// The combination `2 s^ZZ - s^XX - s^YY` that pulsars bound, Eqs. (31) `[consdef]` and (40) `[est]`.
    pub fn combination(&self) -> S {
        self.zz * 2.0 - self.xx - self.yy
    }

    /// The asymmetry `s^XX - s^YY` about Z, Eq. (31) `[consdef]`.
    pub fn asymmetry(&self) -> S {
        self.xx - self.yy
    }

    /// The same values in another number type.
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> PrincipalCoefficients<T> {
        PrincipalCoefficients { xx: convert(self.xx), yy: convert(self.yy), zz: convert(self.zz) }
    }

    /// The same tensor in the frame Y-Z-X, Eq. (36): `Z -> X, X -> Y, Y -> Z`. Applied three times it is the identity.
    pub fn permuted(&self) -> Self {
        Self { xx: self.yy, yy: self.zz, zz: self.xx }
    }

    /// All three multiplied by `factor`.
    pub fn scaled(&self, factor: S) -> Self {
        self.map(|value| value * factor)
    }
}

/// A symmetric tensor diagonalised to its principal axes, with the rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalFrame {
    /// Eigenvalues in descending order, `s^XX >= s^YY >= s^ZZ` (the order of the paper's examples).
    pub coefficients: PrincipalCoefficients<f64>,
    /// Proper rotation `Q` from components in the given frame to components in the principal frame: rows are the
    /// principal axes. `Q s Q^T` is diagonal.
    pub principal_from_given: Matrix3<f64>,
}

/// Principal axes of a symmetric tensor `s^IJ` given in any inertial frame.
///
/// The eigenvalues are accurate to a few ulp of the largest one. The axes of two eigenvalues `s1`, `s2` are determined to
/// about `2e-16 |s| / |s1 - s2|`; for equal ones any pair of axes in their plane is valid, and one is returned.
///
/// # Errors
/// [`Error::Domain`] for an entry that is not finite or above 1e300 in size, and for an asymmetry above `1e-12` of the largest entry.
pub fn principal_frame(tensor: &Matrix3<f64>) -> Result<PrincipalFrame, Error> {
    for &entry in tensor.iter() {
        Error::ensure(entry.abs() <= 1e300, "entry of s^IJ", entry, "a finite number of at most 1e300 in size")?;
    }
    ensure_symmetric(tensor)?;
    let eigen = SymmetricEigen::new((tensor + tensor.transpose()) * 0.5);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let axes = order.map(|i| eigen.eigenvectors.column(i).into_owned());
    // The sign of each axis is free: the larger component is positive for X and Y, and Z makes the frame right-handed.
    let x = positive_along_largest(axes[0]);
    let y = positive_along_largest(axes[1]);
    let z = x.cross(&y);
    Ok(PrincipalFrame {
        coefficients: PrincipalCoefficients::new(order.map(|i| eigen.eigenvalues[i])),
        principal_from_given: Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]),
    })
}

/// Refuses an asymmetry above 1e-12 of the largest entry.
pub(crate) fn ensure_symmetric<S: Real>(tensor: &Matrix3<S>) -> Result<(), Error> {
    let asymmetry = (tensor - tensor.transpose()).map(S::re).amax();
    Error::ensure(
        asymmetry <= 1e-12 * tensor.map(S::re).amax(),
        "largest |s^IJ - s^JI|",
        asymmetry,
        "at most 1e-12 of the largest entry; s^IJ must be symmetric",
    )
}

/// The tensor without its isotropic part, which exerts no torque.
pub(crate) fn traceless<S: Scalar>(tensor: &Matrix3<S>) -> Matrix3<S> {
    tensor - Matrix3::from_diagonal_element(tensor.trace() / 3.0)
}

/// Eigenvalues in descending order and the proper rotation to the principal frame, with their derivatives: the real parts are those of
/// [`principal_frame`], and infinitesimal rotations remove the off-diagonal derivatives.
///
/// # Errors
/// As for [`principal_frame`]; with derivatives also [`Error::Domain`] where two eigenvalues are equal (to 1e-12 of the largest): there an
/// infinitesimal change of the tensor can turn their axes by any angle.
pub fn principal_frame_with_derivatives<S: Real>(
    tensor: &Matrix3<S>,
) -> Result<(PrincipalCoefficients<S>, Matrix3<S>), Error> {
    let frame = principal_frame(&tensor.map(S::re))?;
    let mut rotation = frame.principal_from_given.map(S::from_f64);
    if !S::HAS_DERIVATIVES {
        return Ok((frame.coefficients.map(S::from_f64), rotation));
    }
    let PrincipalCoefficients { xx, yy, zz } = frame.coefficients;
    let size = xx.max(-zz);
    // Each pass doubles the order to which the derivatives are correct.
    for _ in 0..3 {
        let turned = rotation * tensor * rotation.transpose();
        let mut turn = Vector3::zeros();
        for (axis, i, j, gap) in [(0, 1, 2, yy - zz), (1, 2, 0, zz - xx), (2, 0, 1, xx - yy)] {
            let off = (turned[(i, j)] + turned[(j, i)]) / 2.0;
            let off = off - S::from_f64(off.re());
            Error::ensure(
                gap.abs() > 1e-12 * size,
                "difference of two eigenvalues of s^IJ",
                gap,
                "above 1e-12 of the largest, for derivatives",
            )?;
            turn[axis] = off / (turned[(i, i)] - turned[(j, j)]);
        }
        // Cayley's form of the rotation by the vector `turn`: regular where that is zero.
        let half = turn / S::from_f64(2.0);
        let scale = S::one() + half.dot(&half);
        let zero = S::zero();
        let cross = Matrix3::new(zero, -half.z, half.y, half.z, zero, -half.x, -half.y, half.x, zero);
        let small = Matrix3::identity() - (cross - cross * cross) * S::from_f64(2.0) / scale;
        rotation = small * rotation;
    }
    let values = (rotation * tensor * rotation.transpose()).diagonal();
    Ok((PrincipalCoefficients { xx: values.x, yy: values.y, zz: values.z }, rotation))
}

/// Derivatives treat two eigenvalues as equal if their difference is below this fraction of the spread of all eigenvalues. This changes the tensor by
/// the same fraction. The axes of two eigenvalues that are not treated as equal turn at a rate whose relative error is rounding divided by their
/// difference. Both errors are 1e-8 here.
const TAKEN_FOR_EQUAL: f64 = 1e-8;

/// Eigenvalues in descending order and the proper rotation to the principal frame, with their derivatives with respect to one
/// parameter, also where two eigenvalues are equal: perturbation theory with a degenerate pair.
///
/// Axes of distinct eigenvalues turn at the rate `s'_ij / (s_i - s_j)`. In the plane of two equal ones (to 1e-8 of the spread; both become their
/// mean) any axes are principal. Those in which the derivative `s'` is diagonal are chosen: they remain principal as the eigenvalues separate, and do
/// not turn to first order. The choice therefore depends on the parameter, and there is none for two parameters at once.
///
/// # Errors
/// As for [`principal_frame`], and [`Error::Domain`] where all three eigenvalues are equal (to 1e-12 of the largest).
pub fn principal_frame_along(
    tensor: &Matrix3<Dual64>,
) -> Result<(PrincipalCoefficients<Dual64>, Matrix3<Dual64>), Error> {
    let PrincipalFrame { coefficients, principal_from_given: mut frame } =
        principal_frame(&tensor.map(|entry| entry.re))?;
    let PrincipalCoefficients { xx, yy, zz } = coefficients;
    Error::ensure(
        xx - zz > 1e-12 * xx.max(-zz),
        "difference of two eigenvalues of s^IJ",
        xx - zz,
        "above 1e-12 of the largest, for derivatives",
    )?;
    let slope = tensor.map(|entry| entry.eps);
    let slope_in = |frame: &Matrix3<f64>| frame * (slope + slope.transpose()) * 0.5 * frame.transpose();
    let mut values = Vector3::new(xx, yy, zz);
    let pair = [(0, 1), (1, 2)].into_iter().find(|&(i, j)| values[i] - values[j] <= TAKEN_FOR_EQUAL * (xx - zz));
    if let Some((i, j)) = pair {
        let slope = slope_in(&frame);
        let (sin, cos) = (0.5 * (2.0 * slope[(i, j)]).atan2(slope[(i, i)] - slope[(j, j)])).sin_cos();
        let (first, second) = (frame.row(i).into_owned(), frame.row(j).into_owned());
        frame.set_row(i, &(first * cos + second * sin));
        frame.set_row(j, &(second * cos - first * sin));
        let mean = (values[i] + values[j]) / 2.0;
        (values[i], values[j]) = (mean, mean);
    }
    let slope = slope_in(&frame);
    let turn = |i: usize, j: usize| if Some((i, j)) == pair { 0.0 } else { slope[(i, j)] / (values[i] - values[j]) };
    let rates = -(Vector3::new(turn(1, 2), -turn(0, 2), turn(0, 1)).cross_matrix() * frame);
    let value = |i: usize| Dual64::new(values[i], slope[(i, i)]);
    Ok((PrincipalCoefficients::new([0, 1, 2].map(value)), frame.zip_map(&rates, Dual64::new)))
}

/// Relative error of the derivatives from [`principal_frame_along`], due to its treatment of nearly equal eigenvalues.
pub(crate) fn error_of_principal_frame_along(PrincipalCoefficients { xx, yy, zz }: PrincipalCoefficients<f64>) -> f64 {
    let (gap, spread) = ((xx - yy).min(yy - zz), xx - zz);
    if gap <= TAKEN_FOR_EQUAL * spread { gap / spread } else { f64::EPSILON * xx.max(-zz) / gap }
}

/// How close a symmetric tensor `s^IJ` is to one with two equal eigenvalues.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SymmetryOfTensor {
    /// Proper rotation to a principal frame whose third axis belongs to the eigenvalue that differs from the two closest
    /// ones.
    pub principal_from_given: Matrix3<f64>,
    /// Third eigenvalue minus the mean of the two closest ones.
    pub difference: f64,
    /// The tensor minus its axisymmetric part: `s^IJ - mean (1 - z z) - s_z z z`, in the given frame.
    pub asymmetry: Matrix3<f64>,
    size: f64,
}

impl SymmetryOfTensor {
    /// The axisymmetric tensor closest to `tensor`, with the mean of the two closest eigenvalues.
    ///
    /// # Errors
    /// As for [`principal_frame`].
    pub fn of(tensor: &Matrix3<f64>) -> Result<Self, Error> {
        let frame = principal_frame(tensor)?;
        let PrincipalCoefficients { xx, yy, zz } = frame.coefficients;
        let (rotation, values) = if xx - yy <= yy - zz {
            (frame.principal_from_given, [xx, yy, zz])
        } else {
            (permuted_from_inertial::<f64>() * frame.principal_from_given, [yy, zz, xx])
        };
        let equal = (values[0] + values[1]) / 2.0;
        let symmetric = Matrix3::from_diagonal(&Vector3::new(equal, equal, values[2]));
        Ok(Self {
            principal_from_given: rotation,
            difference: values[2] - equal,
            asymmetry: tensor - rotation.transpose() * symmetric * rotation,
            size: tensor.norm(),
        })
    }

    /// Whether the part that is not axisymmetric is below eight roundings of the tensor, the precision of its entries.
    pub(crate) fn is_symmetric_within_rounding(&self) -> bool {
        self.asymmetry.norm() <= 8.0 * f64::EPSILON * self.size
    }

    /// Refuses a tensor that is not axisymmetric within rounding.
    ///
    /// # Errors
    /// [`Error::Domain`] with the part that is not axisymmetric.
    pub(crate) fn refuse_asymmetry(&self) -> Result<(), Error> {
        Error::ensure(
            self.is_symmetric_within_rounding(),
            "relative deviation of s^IJ from two equal eigenvalues",
            self.asymmetry.norm() / self.size,
            "at most 8 roundings; two equal eigenvalues are needed",
        )
    }
}

fn positive_along_largest(axis: Vector3<f64>) -> Vector3<f64> {
    if axis[axis.iamax()] < 0.0 { -axis } else { axis }
}

/// PPN replacement, Eq. (5) `[replace]`: `s^ij = -alpha_2 w^i w^j`, with `w` the velocity relative to the preferred frame in
/// units of the speed of light.
pub fn coefficients_from_preferred_frame<S: Scalar>(alpha_2: S, w: &Vector3<S>) -> Matrix3<S> {
    -(w * w.transpose()) * alpha_2
}

/// `|w|^2`; refuses a velocity whose fourth power would underflow.
pub(crate) fn squared_velocity<S: Real>(w: &Vector3<S>) -> Result<S, Error> {
    let w2 = w.dot(w);
    Error::ensure(
        w2.re() >= 1e-150,
        "squared velocity |w|^2",
        w2.re(),
        "at least 1e-150, so that |w|^4 does not underflow",
    )?;
    Ok(w2)
}

/// The PPN parameter of a tensor of rank one, the inverse of Eq. (5) `[replace]` for a given velocity `w` (units of c):
/// `alpha_2 = -s^ij w^i w^j / |w|^4`.
///
/// # Errors
/// [`Error::Domain`] for `|w|` below 1e-75, or where `s^ij + alpha_2 w^i w^j` is not zero to `1e-9` of `s^ij`: such a tensor is not
/// of preferred-frame form.
pub fn preferred_frame_parameter<S: Real>(s: &Matrix3<S>, w: &Vector3<S>) -> Result<S, Error> {
    let w2 = squared_velocity(w)?;
    let alpha_2 = -(w.dot(&(s * w)) / (w2 * w2));
    let rest = (s - coefficients_from_preferred_frame(alpha_2, w)).map(S::re).amax();
    Error::ensure(
        rest <= 1e-9 * s.map(S::re).amax(),
        "largest |s^ij + alpha_2 w^i w^j|",
        rest,
        "at most 1e-9 of the largest |s^ij|; the tensor must have the form of Eq. (5)",
    )?;
    Ok(alpha_2)
}

#[cfg(test)]
mod tests {
    use num_dual::{Dual2, Dual2_64};

    use super::*;

    /// Four derivatives with respect to one variable.
    type Fourth = Dual2<Dual2_64>;

    #[test]
    fn small_rotations_are_rotations_to_the_fourth_derivative() {
        let t = Fourth::from_re(Dual2_64::from_re(0.0).derivative()).derivative();
        let start = Matrix3::from_diagonal(&Vector3::new(2.0, 0.7, -1.1));
        let slope = Matrix3::new(0.3, -0.5, 0.8, -0.5, 0.6, 0.35, 0.8, 0.35, -0.2);
        let bend = Matrix3::new(-0.2, 0.9, 0.4, 0.9, 0.1, -1.1, 0.4, -1.1, 0.7);
        let tensor = Matrix3::from_fn(|i, j| {
            Fourth::from_f64(start[(i, j)]) + t * slope[(i, j)] + t * t * Fourth::from_f64(bend[(i, j)])
        });
        let (_, rotation) = principal_frame_with_derivatives(&tensor).unwrap();
        let fourth = |m: &Matrix3<Fourth>| m.map(|entry| entry.v2.v2).amax();
        assert!(fourth(&rotation) > 1.0);
        let defect = rotation * rotation.transpose() - Matrix3::identity();
        assert!(fourth(&defect) < 1e-9 * fourth(&rotation), "{:e}", fourth(&defect));
        let turned = rotation * tensor * rotation.transpose();
        let beside = turned - Matrix3::from_diagonal(&turned.diagonal());
        assert!(fourth(&beside) < 1e-9 * fourth(&rotation), "{:e}", fourth(&beside));
    }

    #[test]
    fn the_error_of_equal_eigenvalues_is_their_share_of_the_spread() {
        let error = |values| error_of_principal_frame_along(PrincipalCoefficients::new(values));
        for (values, expected) in [
            ([3.0, 3.0 - 1e-8, -4.0], 1e-8 / 7.0),
            ([3.0, -4.0 + 2e-8, -4.0], 2e-8 / 7.0),
            ([0.03, 0.01, -0.04], f64::EPSILON * 0.04 / 0.02),
            ([5.0, 3.0, -4.0], f64::EPSILON * 5.0 / 2.0),
            ([-1.0, -3.0, -4.0], f64::EPSILON * 4.0),
        ] {
            assert!((error(values) / expected - 1.0).abs() < 1e-6, "{values:?}");
        }
    }

    /// The test for equal eigenvalues is relative to the largest in size, and the error reports the difference.
    #[test]
    fn derivatives_want_eigenvalues_apart() {
        let dual = |values: [f64; 3]| Matrix3::from_diagonal(&Vector3::from(values)).map(Dual64::from_re);
        let near = |gap: f64| [[1.0, 1.0 - gap, -10.0], [10.0, 1.0, 1.0 - gap], [-1.0, -1.0 - gap, -10.0]];
        for (values, is_refused) in near(5e-12).map(|v| (v, true)).into_iter().chain(near(2e-11).map(|v| (v, false))) {
            let found = principal_frame_with_derivatives(&dual(values));
            assert_eq!(found.is_err(), is_refused, "{values:?}");
        }
        // The test does not depend on a sum of two eigenvalues, nor on a single one.
        for values in [[1.0, 0.3, -1.0], [2.0, 1.0, 0.0], [0.0, -1.0, -2.0], [1.0, 0.0, -2.0]] {
            assert!(principal_frame_with_derivatives(&dual(values)).is_ok(), "{values:?}");
        }
        for size in [1.0, -1.0, 0.02] {
            let values = |gap: f64| dual([size, size, size - gap * size.abs()]);
            assert!(principal_frame_along(&values(3e-12)).is_ok());
            match principal_frame_along(&values(5e-13)) {
                Err(Error::Domain { value, .. }) => {
                    assert!((value / (5e-13 * size.abs()) - 1.0).abs() < 1e-3, "{value:e}")
                }
                other => panic!("{other:?}"),
            }
        }
    }

    /// Two eigenvalues count as equal if their difference is a small enough fraction of the spread, and their axes then do not turn about each other.
    /// The antisymmetric part of a derivative of the tensor has no effect on the slopes of the eigenvalues.
    #[test]
    fn equal_eigenvalues_are_those_within_their_share_of_the_spread() {
        let slope = Matrix3::new(0.3, 0.1, 0.2, -1.1, 0.6, 0.4, 1.4, -0.3, -0.2);
        let along = |values: [f64; 3], slope: &Matrix3<f64>| {
            principal_frame_along(&Matrix3::from_diagonal(&Vector3::from(values)).zip_map(slope, Dual64::new)).unwrap()
        };
        for (gap, is_equal) in [(5e-10, true), (1e-9, false)] {
            for values in [[0.03, 0.03 - gap, -0.04], [0.04, -0.03 + gap, -0.03]] {
                let (found, frame) = along(values, &slope);
                let differences = [(found.xx - found.yy).re, (found.yy - found.zz).re];
                assert_eq!(differences.contains(&0.0), is_equal, "{values:?}: {differences:?}");
                let (other, _) = along(values, &((slope + slope.transpose()) / 2.0));
                let slopes = |values: PrincipalCoefficients<Dual64>| [values.xx, values.yy, values.zz].map(|x| x.eps);
                assert_eq!(slopes(found), slopes(other));
                let turn = frame.map(|entry| entry.eps) * frame.map(|entry| entry.re).transpose();
                let (i, j) = if differences[0] < differences[1] { (0, 1) } else { (1, 2) };
                assert_eq!(turn[(i, j)].abs() < 1e-12, is_equal, "{values:?}: {turn}");
            }
        }
    }

    #[test]
    fn eight_roundings_of_the_tensor_are_no_asymmetry() {
        for size in [0.03, 40.0] {
            for (roundings, is_symmetric) in [(7.9, true), (8.1, false)] {
                let asymmetry = Matrix3::from_diagonal(&Vector3::new(0.6, -0.8, 0.0)) * roundings * f64::EPSILON * size;
                let found =
                    SymmetryOfTensor { principal_from_given: Matrix3::identity(), difference: size, asymmetry, size };
                assert_eq!(found.is_symmetric_within_rounding(), is_symmetric, "{roundings} of {size}");
                match found.refuse_asymmetry() {
                    Err(Error::Domain { value, .. }) => {
                        assert!(!is_symmetric && (value / (roundings * f64::EPSILON) - 1.0).abs() < 1e-12);
                    }
                    other => assert!(is_symmetric && other.is_ok()),
                }
            }
        }
    }

    #[test]
    fn velocities_whose_fourth_power_underflows_are_refused_as_such() {
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, -0.1));
        for size in [1e-3, 1e-74] {
            let w = Vector3::new(0.0, 0.0, size);
            let found = preferred_frame_parameter(&coefficients_from_preferred_frame(0.1, &w), &w).unwrap();
            assert!((found - 0.1_f64).abs() < 1e-15, "{size:e}: {found}");
        }
        for size in [0.0, 1e-170, 1e-90, 1e-76, f64::NAN] {
            let refused = preferred_frame_parameter(&tensor, &Vector3::new(0.0, 0.0, size)).unwrap_err();
            assert!(matches!(refused, Error::Domain { quantity: "squared velocity |w|^2", .. }), "{size:e}: {refused}");
        }
    }
}
