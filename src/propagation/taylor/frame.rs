//! The frame in which a series is computed.

use nalgebra::{Matrix3, Vector3};

use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::numerics::arithmetic::{LoadStore, Padded};
use crate::numerics::scalar::Real;

/// The tensor `s^IJ` without its isotropic part, in the frame of a series, and the transformation back.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeriesFrame<S> {
    pub(super) tensor: Matrix3<S>,
    is_principal: bool,
    /// Rotation from the principal frame, if that is the frame of the series and not the given one.
    given_from_series: Option<Matrix3<f64>>,
}

impl<S: Real> SeriesFrame<S> {
    /// The principal frame, computed from real parts, or the given one.
    pub(super) fn of(anisotropic: &Matrix3<S>, principal: bool) -> Result<Self, Error> {
        let off_diagonal = [(0, 1), (0, 2), (1, 2)].iter().any(|&place| anisotropic[place].re() != 0.0);
        if !principal || !off_diagonal {
            return Ok(Self { tensor: *anisotropic, is_principal: principal, given_from_series: None });
        }
        let frame = principal_frame(&anisotropic.map(S::re))?;
        // A step of Newton's method makes the axes orthonormal to rounding, so that the transformation and its inverse
        // agree.
        let back = frame.principal_from_given.transpose();
        let back = back * (Matrix3::identity() * 1.5 - back.transpose() * back * 0.5);
        let tensor = frame.coefficients.tensor().map(S::from_f64);
        Ok(Self { tensor, is_principal: true, given_from_series: Some(back) })
    }

    /// Whether the series is computed in the principal frame, or in the given one with full tensors.
    pub(super) fn is_principal(&self) -> bool {
        self.is_principal
    }

    /// Rotation from the frame of the series, if that is not the given one.
    pub(super) fn given_from_series(&self) -> Option<Matrix3<f64>> {
        self.given_from_series
    }

    pub(super) fn series_from_given(&self, v: &Vector3<S>) -> Vector3<S> {
        self.given_from_series.map_or(*v, |back| back.transpose().map(S::from_f64) * v)
    }

    /// A vector of the series in the given frame.
    pub(super) fn turned_back(&self, v: &Vector3<S>) -> Vector3<S> {
        self.given_from_series.map_or(*v, |back| back.map(S::from_f64) * v)
    }

    /// As [`turned_back`](Self::turned_back), with the instructions of the series.
    #[inline(always)]
    pub(super) fn turned_to_given<A: LoadStore<Scalar = S>>(&self, a: A, v: A::Vector) -> A::Vector {
        match &self.given_from_series {
            None => v,
            Some(back) => {
                let column = |i: usize| {
                    let [x, y, z] = [0, 1, 2].map(|row| S::from_f64(back[(row, i)]));
                    a.load(&Padded([x, y, z, S::zero()]))
                };
                a.combine(&[column(0), column(1), column(2)], v)
            }
        }
    }
}
