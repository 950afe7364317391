//! The operators of a number type that follow from its field operations.

/// Completes a type that has `+ - * /`, negation and `Scalar::from_f64` with what `Scalar` asks for besides: assigning
/// operators, products with constants, zero and one.
macro_rules! complete_operators {
    ($type:ty $(, $parameter:ident)?) => {
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

pub(crate) use complete_operators;
