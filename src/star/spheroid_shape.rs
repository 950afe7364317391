//! Shape of a spheroid: axis ratio, eccentricity, oblateness. Eqs. (10), (72), (79).
//!
//! ```
//! use twofold::star::spheroid_shape::SpheroidShape;
//!
//! let shape = SpheroidShape::from_semi_axes(1.0_f64, 0.8)?;
//! for same in [
//!     SpheroidShape::from_axis_ratio(0.8)?,
//!     SpheroidShape::from_eccentricity(0.6)?,
//!     SpheroidShape::from_eccentricity_squared(0.36)?,
//!     SpheroidShape::from_oblateness(shape.oblateness())?,
//! ] {
//!     assert!((same.axis_ratio() - 0.8).abs() < 1e-14);
//! }
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::error::Error;
use crate::numerics::rounding::{two_product, two_sum};
use crate::numerics::scalar::Real;

/// Shape of the spheroid `(x^2 + y^2) / a1^2 + z^2 / a3^2 = 1`, Eq. (10) `[spheroid]`: oblate, spherical or prolate.
///
/// Stores `q = a3 / a1`, `q^2` and `e^2 = 1 - q^2` together, each to about one ulp of the value it was built from. None of
/// them can replace the others: `e^2` of 1e-24 is lost in `q`, and `q` of a thin disc is lost in `e^2`. For a prolate
/// spheroid `e^2` is negative; all functions of the shape are analytic in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpheroidShape<S> {
    pub(crate) axis_ratio: S,
    pub(crate) axis_ratio_squared: S,
    pub(crate) eccentricity_squared: S,
    /// Rounding errors of `q^2` and of `e^2`, zero if they are not known.
    pub(crate) lost: (S, S),
}

impl<S: Real> SpheroidShape<S> {
    /// The shape from the eccentricity `e = sqrt(1 - (a3 / a1)^2)`, Eq. (72) `[ecc]`, of an oblate spheroid.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `0 <= e < 1`.
    pub fn from_eccentricity(e: S) -> Result<Self, Error> {
        Error::ensure((0.0..1.0).contains(&e.re()), "eccentricity e", e.re(), "from 0 to below 1")?;
        let (e2, e2_lost) = two_product(e, e);
        let (q2, q2_lost) = one_minus(e2, e2_lost);
        Ok(Self { axis_ratio: q2.sqrt(), axis_ratio_squared: q2, eccentricity_squared: e2, lost: (q2_lost, e2_lost) })
    }

    /// The shape from `e^2 = 1 - (a3 / a1)^2`, Eq. (72) `[ecc]`; negative for a prolate spheroid. Regular at zero for
    /// derivatives.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `-1e200 <= e^2 < 1`.
    pub fn from_eccentricity_squared(e2: S) -> Result<Self, Error> {
        Error::ensure((-1e200..1.0).contains(&e2.re()), "squared eccentricity e^2", e2.re(), "from -1e200 to below 1")?;
        let (q2, lost) = one_minus(e2, S::zero());
        Ok(Self { axis_ratio: q2.sqrt(), axis_ratio_squared: q2, eccentricity_squared: e2, lost: (lost, S::zero()) })
    }

    /// The shape from the axis ratio `q = a3 / a1`: below one oblate, above one prolate.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `1e-100 <= q <= 1e100`.
    pub fn from_axis_ratio(q: S) -> Result<Self, Error> {
        let allowed = "from 1e-100 to 1e100, so that no power of it over- or underflows";
        Error::ensure((1e-100..=1e100).contains(&q.re()), "axis ratio a3 / a1", q.re(), allowed)?;
        let (q2, q2_lost) = two_product(q, q);
        let (e2, e2_lost) = one_minus(q2, q2_lost);
        Ok(Self { axis_ratio: q, axis_ratio_squared: q2, eccentricity_squared: e2, lost: (q2_lost, e2_lost) })
    }

    /// The shape from the semi-axes `a1` (equatorial) and `a3` (polar).
    ///
    /// # Errors
    /// [`Error::Domain`] unless both are positive and finite and their ratio is between 1e-100 and 1e100.
    pub fn from_semi_axes(a1: S, a3: S) -> Result<Self, Error> {
        for (a, name) in [(a1.re(), "equatorial semi-axis a1"), (a3.re(), "polar semi-axis a3")] {
            Error::ensure(a > 0.0 && a.is_finite(), name, a, "positive and finite")?;
        }
        let shape = Self::from_axis_ratio(a3 / a1)?;
        // a1 - a3 is exact for axes within a factor of two.
        let e2 = ((a1 - a3) / a1) * ((a1 + a3) / a1);
        Ok(Self { eccentricity_squared: e2, lost: (S::zero(), S::zero()), ..shape })
    }

    /// The shape from the oblateness `epsilon` of the uniform spheroid, the inverse of Eq. (79):
    /// `e^2 = 2 epsilon / (1 + epsilon)`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `-1 < epsilon < 1`.
    pub fn from_oblateness(epsilon: S) -> Result<Self, Error> {
        Error::ensure(epsilon.re().abs() < 1.0, "oblateness epsilon", epsilon.re(), "above -1 and below 1")?;
        let q2 = (S::one() - epsilon) / (S::one() + epsilon);
        let e2 = epsilon * 2.0 / (S::one() + epsilon);
        let lost = (S::zero(), S::zero());
        Ok(Self { axis_ratio: q2.sqrt(), axis_ratio_squared: q2, eccentricity_squared: e2, lost })
    }

    /// Axis ratio `q = a3 / a1`.
    pub fn axis_ratio(&self) -> S {
        self.axis_ratio
    }

    /// Squared axis ratio `q^2 = 1 - e^2`.
    pub fn axis_ratio_squared(&self) -> S {
        self.axis_ratio_squared
    }

    /// Squared eccentricity `e^2 = 1 - (a3 / a1)^2`, Eq. (72) `[ecc]`; negative for a prolate spheroid.
    pub fn eccentricity_squared(&self) -> S {
        self.eccentricity_squared
    }

    /// Oblateness `epsilon = e^2 / (2 - e^2)` of the uniform spheroid, Eq. (79).
    pub fn oblateness(&self) -> S {
        let sum = self.axis_ratio_squared + S::one();
        if self.eccentricity_squared.re() < -2.0 {
            // Towards -1: the derivative of the quotient is the difference of two terms larger by `q^2`.
            return S::from_f64(2.0) / sum - S::one();
        }
        self.eccentricity_squared / sum
    }
}

/// `1 - (x + lost)`, and its rounding error.
fn one_minus<S: Real>(x: S, lost: S) -> (S, S) {
    let (difference, first) = two_sum(S::one(), -x);
    two_sum(difference, first - lost)
}
