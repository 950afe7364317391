//! Four doubles at once: in one register with fused multiply-add, or one by one.

use crate::numerics::arithmetic::Componentwise;

/// The storage and multiplication of four doubles.
pub(crate) trait FourLanes: Copy {
    type Lanes: Copy;
    /// Whether products are added without intermediate rounding.
    const FUSED: bool;

    fn load(self, values: &[f64; 4]) -> Self::Lanes;
    /// Four equal numbers.
    fn all(self, value: f64) -> Self::Lanes;
    /// `a b + sum`.
    fn multiply_add(self, a: Self::Lanes, b: Self::Lanes, sum: Self::Lanes) -> Self::Lanes;
    fn store(self, lanes: Self::Lanes) -> [f64; 4];
}

impl FourLanes for Componentwise<f64> {
    type Lanes = [f64; 4];
    const FUSED: bool = false;

    #[inline(always)]
    fn load(self, values: &[f64; 4]) -> [f64; 4] {
        *values
    }

    #[inline(always)]
    fn all(self, value: f64) -> [f64; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn multiply_add(self, a: [f64; 4], b: [f64; 4], sum: [f64; 4]) -> [f64; 4] {
        core::array::from_fn(|i| a[i] * b[i] + sum[i])
    }

    #[inline(always)]
    fn store(self, lanes: [f64; 4]) -> [f64; 4] {
        lanes
    }
}
