//! Arithmetic of three-component vectors, so that one code serves every scalar type and every vector instruction set.

use nalgebra::Vector3;

use crate::numerics::ring::Ring;
use crate::numerics::scalar::{Real, Scalar};

/// A vector as stored: three components and padding to 32 bytes for doubles, which is one register.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Padded<S>(pub(crate) [S; 4]);

impl<S: Scalar> Padded<S> {
    pub(crate) fn zero() -> Self {
        Self([S::zero(); 4])
    }

    pub(crate) fn vector(&self) -> Vector3<S> {
        Vector3::new(self.0[0], self.0[1], self.0[2])
    }
}

impl<S: Scalar> From<Vector3<S>> for Padded<S> {
    fn from(v: Vector3<S>) -> Self {
        Self([v.x, v.y, v.z, S::zero()])
    }
}

/// Three-component vectors whose components are multiplied one by one. Cross products are computed from the two cyclic
/// permutations: `a x b = a.yzx * b.zxy - a.zxy * b.yzx`.
pub(crate) trait Arithmetic: Copy {
    /// Three components.
    type Vector: Copy;
    /// A vector with both cyclic permutations available.
    type Permuted: Copy;
    /// Whether the recurrences may take the tensor `s^IJ` to be diagonal. Rotation to its principal axes is exact to
    /// rounding for real numbers; a dual number may have derivatives with respect to the other components.
    const PRINCIPAL_FRAME: bool;
    /// Whether there are many vectors side by side, which fill the registers without padding.
    const MANY: bool = false;

    fn zero(self) -> Self::Vector;
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a * b + c`, rounded once or twice.
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector;
    /// For wider numbers, division by a small integer is more accurate than multiplication by its rounded inverse.
    fn divide(self, a: Self::Vector, divisor: f64) -> Self::Vector;
    /// The sum of the three columns multiplied by the components of `v`.
    fn combine(self, columns: &[Self::Vector; 3], v: Self::Vector) -> Self::Vector;

    fn permuted(self, v: Self::Vector) -> Self::Permuted;
    /// The components in the order y, z, x.
    fn yzx(self, v: Self::Permuted) -> Self::Vector;
    /// The components in the order z, x, y.
    fn zxy(self, v: Self::Permuted) -> Self::Vector;
}

/// Vectors of single numbers, stored with padding.
pub(crate) trait LoadStore: Arithmetic {
    /// A component.
    type Scalar: Real;

    fn load(self, kept: &Padded<Self::Scalar>) -> Self::Vector;
    fn store(self, v: Self::Vector) -> Padded<Self::Scalar>;
    /// A vector with equal components.
    fn splat(self, value: Self::Scalar) -> Self::Vector;
    /// Largest component in size, by real parts; NaN if one component is NaN.
    fn largest(self, v: Self::Vector) -> f64;
}

/// Vectors whose components are separate numbers of the type of the one given: any scalar without special instructions, or one number
/// for each of several vectors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Componentwise<T>(pub(crate) T);

/// Vectors of any scalar type.
pub(crate) fn plain<S: Real>() -> Componentwise<S> {
    Componentwise(S::zero())
}

impl<T: Ring> Arithmetic for Componentwise<T> {
    type Vector = [T; 3];
    type Permuted = [T; 3];
    const PRINCIPAL_FRAME: bool = T::MANY;
    const MANY: bool = T::MANY;

    #[inline(always)]
    fn zero(self) -> [T; 3] {
        [self.0.like(0.0); 3]
    }

    #[inline(always)]
    fn add(self, a: [T; 3], b: [T; 3]) -> [T; 3] {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }

    #[inline(always)]
    fn sub(self, a: [T; 3], b: [T; 3]) -> [T; 3] {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    #[inline(always)]
    fn mul(self, a: [T; 3], b: [T; 3]) -> [T; 3] {
        [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
    }

    #[inline(always)]
    fn mul_add(self, a: [T; 3], b: [T; 3], c: [T; 3]) -> [T; 3] {
        [a[0].mul_add(b[0], c[0]), a[1].mul_add(b[1], c[1]), a[2].mul_add(b[2], c[2])]
    }

    #[inline(always)]
    fn divide(self, a: [T; 3], divisor: f64) -> [T; 3] {
        let divisor = self.0.like(divisor);
        [a[0].over(divisor), a[1].over(divisor), a[2].over(divisor)]
    }

    #[inline(always)]
    fn combine(self, [a, b, c]: &[[T; 3]; 3], v: [T; 3]) -> [T; 3] {
        self.mul_add(*c, [v[2]; 3], self.mul_add(*b, [v[1]; 3], self.mul(*a, [v[0]; 3])))
    }

    #[inline(always)]
    fn permuted(self, v: [T; 3]) -> [T; 3] {
        v
    }

    #[inline(always)]
    fn yzx(self, [x, y, z]: [T; 3]) -> [T; 3] {
        [y, z, x]
    }

    #[inline(always)]
    fn zxy(self, [x, y, z]: [T; 3]) -> [T; 3] {
        [z, x, y]
    }
}

impl<S: Real> LoadStore for Componentwise<S> {
    type Scalar = S;

    #[inline(always)]
    fn load(self, kept: &Padded<S>) -> [S; 3] {
        [kept.0[0], kept.0[1], kept.0[2]]
    }

    #[inline(always)]
    fn store(self, [x, y, z]: [S; 3]) -> Padded<S> {
        Padded([x, y, z, S::zero()])
    }

    #[inline(always)]
    fn splat(self, value: S) -> [S; 3] {
        [value; 3]
    }

    #[inline(always)]
    fn largest(self, v: [S; 3]) -> f64 {
        largest(v.map(S::re))
    }
}

/// Largest of three numbers in size; NaN if one is NaN.
#[inline(always)]
pub(crate) fn largest(v: [f64; 3]) -> f64 {
    let [x, y, z] = v.map(f64::abs);
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    larger(larger(x, y), z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_vectors_are_by_components() {
        assert_eq!(plain().mul([2.0, 3.0, 5.0], [7.0, 11.0, 13.0]), [14.0, 33.0, 65.0]);
    }
}
