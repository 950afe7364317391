//! Vectors of doubles in one register of four, with fused multiply-add, for processors with AVX2.

use pulp::f64x4;
use pulp::x86::V3;

use crate::numerics::arithmetic::{Arithmetic, LoadStore, Padded, largest};
use crate::numerics::four_lanes::FourLanes;

/// Proof, obtained at run time, that the processor has the instructions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fused(V3);

/// `None` on a processor without AVX2 and fused multiply-add.
pub(crate) fn detect_fused() -> Option<Fused> {
    V3::try_new().map(Fused)
}

/// Runs `work`, and what is inlined into it, compiled for these instructions.
#[inline(always)]
pub(crate) fn run_fused<R>(fused: Fused, work: impl FnOnce() -> R) -> R {
    fused.0.vectorize(work)
}

impl Arithmetic for Fused {
    type Vector = f64x4;
    type Permuted = [f64x4; 2];
    const PRINCIPAL_FRAME: bool = true;

    #[inline(always)]
    fn zero(self) -> f64x4 {
        self.0.splat_f64x4(0.0)
    }

    #[inline(always)]
    fn add(self, a: f64x4, b: f64x4) -> f64x4 {
        self.0.add_f64x4(a, b)
    }

    #[inline(always)]
    fn sub(self, a: f64x4, b: f64x4) -> f64x4 {
        self.0.sub_f64x4(a, b)
    }

    #[inline(always)]
    fn mul(self, a: f64x4, b: f64x4) -> f64x4 {
        self.0.mul_f64x4(a, b)
    }

    #[inline(always)]
    fn mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
        self.0.mul_add_f64x4(a, b, c)
    }

    #[inline(always)]
    fn divide(self, a: f64x4, divisor: f64) -> f64x4 {
        self.0.div_f64x4(a, self.splat(divisor))
    }

    #[inline(always)]
    fn combine(self, [a, b, c]: &[f64x4; 3], v: f64x4) -> f64x4 {
        let [x, y, z] = [v.0, v.1, v.2].map(|component| self.splat(component));
        self.mul_add(*a, x, self.mul_add(*b, y, self.mul(*c, z)))
    }

    /// Both permutations are computed once, since each is used in many products.
    #[inline(always)]
    fn permuted(self, v: f64x4) -> [f64x4; 2] {
        let v = pulp::cast(v);
        let yzx = self.0.avx2._mm256_permute4x64_pd::<0b11_00_10_01>(v);
        let zxy = self.0.avx2._mm256_permute4x64_pd::<0b11_01_00_10>(v);
        [pulp::cast(yzx), pulp::cast(zxy)]
    }

    #[inline(always)]
    fn yzx(self, [yzx, _]: [f64x4; 2]) -> f64x4 {
        yzx
    }

    #[inline(always)]
    fn zxy(self, [_, zxy]: [f64x4; 2]) -> f64x4 {
        zxy
    }
}

impl LoadStore for Fused {
    type Scalar = f64;

    #[inline(always)]
    fn load(self, &Padded([x, y, z, rest]): &Padded<f64>) -> f64x4 {
        f64x4(x, y, z, rest)
    }

    #[inline(always)]
    fn store(self, v: f64x4) -> Padded<f64> {
        Padded([v.0, v.1, v.2, v.3])
    }

    #[inline(always)]
    fn splat(self, value: f64) -> f64x4 {
        self.0.splat_f64x4(value)
    }

    #[inline(always)]
    fn largest(self, v: f64x4) -> f64 {
        largest([v.0, v.1, v.2])
    }
}

impl FourLanes for Fused {
    type Lanes = f64x4;
    const FUSED: bool = true;

    #[inline(always)]
    fn load(self, values: &[f64; 4]) -> Self::Lanes {
        LoadStore::load(self, &Padded(*values))
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self::Lanes {
        LoadStore::splat(self, value)
    }

    #[inline(always)]
    fn multiply_add(self, a: Self::Lanes, b: Self::Lanes, sum: Self::Lanes) -> Self::Lanes {
        self.mul_add(a, b, sum)
    }

    #[inline(always)]
    fn store(self, lanes: Self::Lanes) -> [f64; 4] {
        LoadStore::store(self, lanes).0
    }
}
