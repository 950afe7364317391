//! The operators of a number type, defined from its four field operations.

/// Implements the operators of a number type that has `Scalar::from_f64`, from expressions for the sum, the negative, the product and the quotient.
/// It adds what `Scalar` requires besides: differences, assigning operators, products with constants, zero and one. The type is `Copy` and
/// `PartialEq`, and may have one parameter that is a `Scalar`. The crate that calls the macro needs `num_traits`.
#[macro_export]
macro_rules! field_operators {
    (@operator [$type:ty $(, $parameter:ident)?] $trait:path, $name:ident($a:ident, $b:ident: $right:ty) $value:expr) => {
        impl$(<$parameter: $crate::Scalar>)? $trait for $type {
            type Output = Self;

            #[inline]
            fn $name(self, $b: $right) -> Self {
                let $a = self;
                $value
            }
        }
    };
    (@assigning [$type:ty $(, $parameter:ident)?] $trait:path, $name:ident $operator:tt) => {
        impl$(<$parameter: $crate::Scalar>)? $trait for $type {
            fn $name(&mut self, right: Self) {
                *self = *self $operator right;
            }
        }
    };
    (
        $type:ty $(, $parameter:ident)?;
        $a:ident + $b:ident = $sum:expr;
        -$of:ident = $negative:expr;
        $c:ident * $d:ident = $product:expr;
        $e:ident / $f:ident = $quotient:expr;
    ) => {
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Add, add($a, $b: Self) $sum }
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Sub, sub(left, right: Self) left + -right }
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Mul, mul($c, $d: Self) $product }
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Div, div($e, $f: Self) $quotient }
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Mul<f64>,
            mul(left, right: f64) left * <Self as $crate::Scalar>::from_f64(right) }
        $crate::field_operators! { @operator [$type $(, $parameter)?] core::ops::Div<f64>,
            div(left, right: f64) left / <Self as $crate::Scalar>::from_f64(right) }
        $crate::field_operators! { @assigning [$type $(, $parameter)?] core::ops::AddAssign, add_assign + }
        $crate::field_operators! { @assigning [$type $(, $parameter)?] core::ops::SubAssign, sub_assign - }
        $crate::field_operators! { @assigning [$type $(, $parameter)?] core::ops::MulAssign, mul_assign * }
        $crate::field_operators! { @assigning [$type $(, $parameter)?] core::ops::DivAssign, div_assign / }

        impl$(<$parameter: $crate::Scalar>)? core::ops::Neg for $type {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                let $of = self;
                $negative
            }
        }

        impl$(<$parameter: $crate::Scalar>)? num_traits::Zero for $type {
            fn zero() -> Self {
                <Self as $crate::Scalar>::from_f64(0.0)
            }

            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl$(<$parameter: $crate::Scalar>)? num_traits::One for $type {
            fn one() -> Self {
                <Self as $crate::Scalar>::from_f64(1.0)
            }
        }
    };
}
