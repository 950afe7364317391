//! The operators of a number type, from its four field operations.

/// Gives a type with `Scalar::from_f64` the sum, the negative, the product and the quotient that are written for it, and what `Scalar` takes
/// besides: differences, assigning operators, products with constants, zero and one.
macro_rules! field_operators {
    (
        $type:ty $(, $parameter:ident)?;
        $a:ident + $b:ident = $sum:expr;
        -$of:ident = $negative:expr;
        $c:ident * $d:ident = $product:expr;
        $e:ident / $f:ident = $quotient:expr;
    ) => {
        impl$(<$parameter: twofold::Scalar>)? core::ops::Add for $type {
            type Output = Self;

            #[inline]
            fn add(self, $b: Self) -> Self {
                let $a = self;
                $sum
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Sub for $type {
            type Output = Self;

            #[inline]
            fn sub(self, rhs: Self) -> Self {
                self + -rhs
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Neg for $type {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                let $of = self;
                $negative
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Mul for $type {
            type Output = Self;

            #[inline]
            fn mul(self, $d: Self) -> Self {
                let $c = self;
                $product
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Div for $type {
            type Output = Self;

            #[inline]
            fn div(self, $f: Self) -> Self {
                let $e = self;
                $quotient
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::AddAssign for $type {
            fn add_assign(&mut self, rhs: Self) {
                *self = *self + rhs;
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::SubAssign for $type {
            fn sub_assign(&mut self, rhs: Self) {
                *self = *self - rhs;
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::MulAssign for $type {
            fn mul_assign(&mut self, rhs: Self) {
                *self = *self * rhs;
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::DivAssign for $type {
            fn div_assign(&mut self, rhs: Self) {
                *self = *self / rhs;
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Mul<f64> for $type {
            type Output = Self;

            fn mul(self, rhs: f64) -> Self {
                self * <Self as twofold::Scalar>::from_f64(rhs)
            }
        }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Div<f64> for $type {
            type Output = Self;

            fn div(self, rhs: f64) -> Self {
                self / <Self as twofold::Scalar>::from_f64(rhs)
            }
        }

        impl$(<$parameter: twofold::Scalar>)? num_traits::Zero for $type {
            fn zero() -> Self {
                <Self as twofold::Scalar>::from_f64(0.0)
            }

            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl$(<$parameter: twofold::Scalar>)? num_traits::One for $type {
            fn one() -> Self {
                <Self as twofold::Scalar>::from_f64(1.0)
            }
        }
    };
}

pub(crate) use field_operators;
