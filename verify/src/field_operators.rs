//! The operators of a number type, defined from its four field operations.

/// Gives a type with `Scalar::from_f64` the sum, the negative, the product and the quotient that are written for it, and what `Scalar` takes
/// besides: differences, assigning operators, products with constants, zero and one.
macro_rules! field_operators {
    (@operator [$type:ty $(, $parameter:ident)?] $trait:path, $name:ident($a:ident, $b:ident: $right:ty) $value:expr) => {
        impl$(<$parameter: twofold::Scalar>)? $trait for $type {
            type Output = Self;

            #[inline]
            fn $name(self, $b: $right) -> Self {
                let $a = self;
                $value
            }
        }
    };
    (@assigning [$type:ty $(, $parameter:ident)?] $trait:path, $name:ident $operator:tt) => {
        impl$(<$parameter: twofold::Scalar>)? $trait for $type {
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
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Add, add($a, $b: Self) $sum }
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Sub, sub(left, right: Self) left + -right }
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Mul, mul($c, $d: Self) $product }
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Div, div($e, $f: Self) $quotient }
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Mul<f64>,
            mul(left, right: f64) left * <Self as twofold::Scalar>::from_f64(right) }
        field_operators! { @operator [$type $(, $parameter)?] core::ops::Div<f64>,
            div(left, right: f64) left / <Self as twofold::Scalar>::from_f64(right) }
        field_operators! { @assigning [$type $(, $parameter)?] core::ops::AddAssign, add_assign + }
        field_operators! { @assigning [$type $(, $parameter)?] core::ops::SubAssign, sub_assign - }
        field_operators! { @assigning [$type $(, $parameter)?] core::ops::MulAssign, mul_assign * }
        field_operators! { @assigning [$type $(, $parameter)?] core::ops::DivAssign, div_assign / }

        impl$(<$parameter: twofold::Scalar>)? core::ops::Neg for $type {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                let $of = self;
                $negative
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
