//! Double-double numbers, about 31 digits, as a scalar of the model: the reference where 16 digits are not enough.
//!
//! The arithmetic is that of the crate `xprec` (Joldes, Muller and Popescu 2017, ACM Trans. Math. Softw. 44, 15). The type
//! here only implements the traits of the model.

use core::fmt;
use core::str::FromStr;

use crate::prelude::*;
use xprec::Df64;

/// An unevaluated sum of two doubles, the second below half an ulp of the first.
#[derive(Clone, Copy, PartialEq)]
pub struct DoubleDouble(Df64);

impl DoubleDouble {
    /// The sum of two doubles, exact within 106 bits.
    pub fn sum_of(high: f64, low: f64) -> Self {
        Self(Df64::new(high) + Df64::new(low))
    }

    /// `2 pi` to 32 digits.
    pub fn tau() -> Self {
        Self::sum_of(core::f64::consts::TAU, 2.449_293_598_294_706_4e-16)
    }

    /// The nearest double.
    pub fn high(self) -> f64 {
        self.0.hi()
    }

    /// The difference from [`high`](Self::high).
    pub fn low(self) -> f64 {
        self.0.lo()
    }
}

impl fmt::Debug for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:e} + {:e}", self.high(), self.low())
    }
}

field_operators! {
    DoubleDouble;
    a + b = Self(a.0 + b.0);
    -a = Self(-a.0);
    a * b = Self(a.0 * b.0);
    a / b = Self(a.0 / b.0);
}

impl Scalar for DoubleDouble {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self(Df64::new(value))
    }

    fn sin_cos(self) -> (Self, Self) {
        // The crate loses digits of angles above some 1e9: whole turns are subtracted here, with 48 digits of `2 pi`.
        let turns = (self.high() / core::f64::consts::TAU).round();
        let angle = if turns == 0.0 {
            self
        } else {
            let turns = Self::from_f64(turns);
            (self - Self::from_f64(core::f64::consts::TAU) * turns)
                - Self::from_f64(2.449_293_598_294_706_4e-16) * turns
                - Self::from_f64(-5.989_539_619_436_679e-33) * turns
        };
        let (sin, cos) = angle.0.sin_cos();
        (Self(sin), Self(cos))
    }
}

impl Real for DoubleDouble {
    const HAS_DERIVATIVES: bool = false;

    #[inline]
    fn re(self) -> f64 {
        self.high()
    }

    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    fn exp(self) -> Self {
        Self(self.0.exp())
    }

    fn ln(self) -> Self {
        Self(self.0.ln())
    }

    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0))
    }
}

impl FromStr for DoubleDouble {
    type Err = String;

    /// Reads a decimal number such as `-1.5e-3`, rounded to about 31 digits.
    fn from_str(text: &str) -> Result<Self, String> {
        let malformed = || format!("`{text}` is not a decimal number");
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let mut exponent: i32 = exponent.parse().map_err(|_| malformed())?;
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = whole.trim_start_matches(['-', '+']).chars().chain(fraction.chars());
        let ten = Self::from_f64(10.0);
        let mut value = Self::zero();
        let mut count = 0;
        for digit in digits {
            let digit = digit.to_digit(10).ok_or_else(malformed)?;
            count += 1;
            if value.high() < 1e31 {
                value = value * ten + Self::from_f64(f64::from(digit));
            } else {
                // The digit is beyond 106 bits.
                exponent += 1;
            }
        }
        if count == 0 {
            return Err(malformed());
        }
        exponent -= fraction.len() as i32;
        // Powers of ten up to 1e44 are exact double-doubles; `powi` would take a logarithm.
        let power = (0..exponent.abs()).fold(Self::from_f64(1.0), |power, _| power * ten);
        let value = if exponent < 0 { value / power } else { value * power };
        Ok(if mantissa.starts_with('-') { -value } else { value })
    }
}
