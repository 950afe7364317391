//! Registers of doubles.

use pulp::x86::{V3, V4};
use pulp::{f64x4, f64x8};

/// A register of doubles and its lane-by-lane operations. `pulp::Simd` has the same operations, but does not always inline its negation,
/// absolute value and selection: with it, motions in lanes took 11 times as many instructions.
pub(crate) trait Register: Copy {
    /// The register.
    type Lanes: Copy;
    /// Number of lanes.
    const COUNT: usize;

    fn splat(self, value: f64) -> Self::Lanes;
    fn add(self, a: Self::Lanes, b: Self::Lanes) -> Self::Lanes;
    fn sub(self, a: Self::Lanes, b: Self::Lanes) -> Self::Lanes;
    fn mul(self, a: Self::Lanes, b: Self::Lanes) -> Self::Lanes;
    fn mul_add(self, a: Self::Lanes, b: Self::Lanes, c: Self::Lanes) -> Self::Lanes;
    /// `a * b - c`, rounded once.
    fn mul_sub(self, a: Self::Lanes, b: Self::Lanes, c: Self::Lanes) -> Self::Lanes;
    /// `a / b`, and zero where `b` is zero.
    fn div_or_zero(self, a: Self::Lanes, b: Self::Lanes) -> Self::Lanes;
    /// The larger of two in size, lane by lane; NaN in `a` stays.
    fn larger(self, a: Self::Lanes, b: Self::Lanes) -> Self::Lanes;
    fn get(self, a: &Self::Lanes, lane: usize) -> f64;
    fn set(self, a: &mut Self::Lanes, lane: usize, value: f64);
    /// Runs `work`, and what is inlined into it, compiled for these instructions.
    fn run<R>(self, work: impl FnOnce() -> R) -> R;
}

/// A register of pulp, whose functions are named with its name as a suffix.
macro_rules! register {
    ($token:ident, $lanes:ident, $count:literal, $splat:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $mul_add:ident,
     $mul_sub:ident, $select:ident, $equal:ident, $greater:ident, $abs:ident) => {
        impl Register for $token {
            type Lanes = $lanes;
            const COUNT: usize = $count;

            #[inline(always)]
            fn splat(self, value: f64) -> $lanes {
                self.$splat(value)
            }

            #[inline(always)]
            fn add(self, a: $lanes, b: $lanes) -> $lanes {
                self.$add(a, b)
            }

            #[inline(always)]
            fn sub(self, a: $lanes, b: $lanes) -> $lanes {
                self.$sub(a, b)
            }

            #[inline(always)]
            fn mul(self, a: $lanes, b: $lanes) -> $lanes {
                self.$mul(a, b)
            }

            #[inline(always)]
            fn mul_add(self, a: $lanes, b: $lanes, c: $lanes) -> $lanes {
                self.$mul_add(a, b, c)
            }

            #[inline(always)]
            fn mul_sub(self, a: $lanes, b: $lanes, c: $lanes) -> $lanes {
                self.$mul_sub(a, b, c)
            }

            #[inline(always)]
            fn div_or_zero(self, a: $lanes, b: $lanes) -> $lanes {
                let zero = self.$splat(0.0);
                self.$select(self.$equal(b, zero), zero, self.$div(a, b))
            }

            #[inline(always)]
            fn larger(self, a: $lanes, b: $lanes) -> $lanes {
                let (a, b) = (self.$abs(a), self.$abs(b));
                self.$select(self.$greater(b, a), b, a)
            }

            #[inline(always)]
            fn get(self, a: &$lanes, lane: usize) -> f64 {
                pulp::cast::<$lanes, [f64; $count]>(*a)[lane]
            }

            #[inline(always)]
            fn set(self, a: &mut $lanes, lane: usize, value: f64) {
                let mut lanes: [f64; $count] = pulp::cast(*a);
                lanes[lane] = value;
                *a = pulp::cast(lanes);
            }

            #[inline(always)]
            fn run<R>(self, work: impl FnOnce() -> R) -> R {
                self.vectorize(work)
            }
        }
    };
}

register!(
    V3,
    f64x4,
    4,
    splat_f64x4,
    add_f64x4,
    sub_f64x4,
    mul_f64x4,
    div_f64x4,
    mul_add_f64x4,
    mul_sub_f64x4,
    select_f64x4,
    cmp_eq_f64x4,
    cmp_gt_f64x4,
    abs_f64x4
);
register!(
    V4,
    f64x8,
    8,
    splat_f64x8,
    add_f64x8,
    sub_f64x8,
    mul_f64x8,
    div_f64x8,
    mul_add_f64x8,
    mul_sub_f64x8,
    select_f64x8,
    cmp_eq_f64x8,
    cmp_gt_f64x8,
    abs_f64x8
);

#[cfg(test)]
mod tests {
    use super::*;

    fn quotients<R: Register>(register: R) {
        let of = |values: &dyn Fn(usize) -> f64| {
            let mut lanes = register.splat(0.0);
            for lane in 0..R::COUNT {
                register.set(&mut lanes, lane, values(lane));
            }
            lanes
        };
        let (a, b) = (|lane: usize| 3.0 + lane as f64, |lane: usize| [0.0, 1.0, -2.0, 0.5][lane % 4]);
        let quotient = register.div_or_zero(of(&a), of(&b));
        for lane in 0..R::COUNT {
            let expected = if b(lane) == 0.0 { 0.0 } else { a(lane) / b(lane) };
            assert_eq!(register.get(&quotient, lane), expected);
        }
    }

    #[test]
    fn quotients_by_zero_are_zero() {
        if let Some(register) = V3::try_new() {
            quotients(register);
        }
        if let Some(register) = V4::try_new() {
            quotients(register);
        }
    }
}
