//! Coefficients for Lorentz violation from the vacuum value of the field that couples to the Riemann tensor in the action. Eqs. (1), (3).
//!
//! ```
//! use twofold::curvature_coupling::{CurvatureTensor, coefficients_from_vacuum_value};
//!
//! // k^{0101} alone, with those that follow from it by the symmetries of the Riemann tensor.
//! let mut k: CurvatureTensor<f64> = [[[[0.0; 4]; 4]; 4]; 4];
//! for [a, b] in [[0, 1], [1, 0]] {
//!     (k[a][b][a][b], k[a][b][b][a]) = (1e-9, -1e-9);
//! }
//! let s = coefficients_from_vacuum_value(&k);
//! // Contracted twice: k^{0101} = 1e-9 enters s^{00} by g_11 and s^{11} by g_00, less a fourth of the trace -2e-9.
//! assert!((s[(0, 0)] - 1e-9).abs() < 1e-24 && (s[(1, 1)] + 1e-9).abs() < 1e-24 && (s[(2, 2)] - 1e-9).abs() < 1e-24);
//! ```

use nalgebra::Matrix4;

use crate::numerics::scalar::Scalar;

/// A tensor of the fourth rank with the symmetries of the Riemann tensor, `k[a][b][c][d] = k^{abcd}`; index 0 is time.
pub type CurvatureTensor<S> = [[[[S; 4]; 4]; 4]; 4];

/// The signs of the Minkowski metric `diag(-1, 1, 1, 1)`.
const SIGNS: [f64; 4] = [-1.0, 1.0, 1.0, 1.0];

/// Coefficients `s^{ab} = 2 (k^{ambn} g_{mn} - (1/4) g^{ab} k^{lmkn} g_{mn} g_{lk})` with the metric `diag(-1, 1, 1, 1)`, Eq. (3),
/// dimensionless: twice the trace-free part of the contraction of `k`, the vacuum value of the field in the action (1) `[action]`. The spatial
/// components are the `s^IJ` of all other equations.
///
/// In the action `k^{abcd} R_{abcd}` this is the coefficient of the trace-free Ricci tensor.
pub fn coefficients_from_vacuum_value<S: Scalar>(k: &CurvatureTensor<S>) -> Matrix4<S> {
    let contracted = Matrix4::from_fn(|a, c| (0..4).fold(S::zero(), |sum, m| sum + k[a][m][c][m] * SIGNS[m]));
    let trace = (0..4).fold(S::zero(), |sum, a| sum + contracted[(a, a)] * SIGNS[a]);
    Matrix4::from_fn(|a, b| {
        let isotropic = if a == b { trace * SIGNS[a] / 4.0 } else { S::zero() };
        (contracted[(a, b)] - isotropic) * 2.0
    })
}
