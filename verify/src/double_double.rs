//! Double-double numbers, about 31 digits, as a scalar of the model: the oracle where 16 digits are not enough.
//!
//! The arithmetic is that of the crate `xprec` (Joldes, Muller and Popescu 2017, ACM Trans. Math. Softw. 44, 15). The type
//! here only lends it the traits of the model.

use core::fmt;
use core::str::FromStr;

use crate::prelude::*;
use xprec::Df64;

/// An unevaluated sum of two doubles, the second below half an ulp of the first.
#[derive(Clone, Copy, PartialEq)]
pub struct DoubleDouble(Df64);

impl DoubleDouble {
    /// The exact sum of two doubles, as far as 106 bits hold it.
    pub fn sum_of(high: f64, low: f64) -> Self {
        Self(Df64::new(high) + Df64::new(low))
    }

    /// `2 pi`, to its last digit.
    pub fn tau() -> Self {
        Self::sum_of(core::f64::consts::TAU, 2.449_293_598_294_706_4e-16)
    }

    /// The double nearest to it.
    pub fn high(self) -> f64 {
        self.0.hi()
    }

    /// What [`high`](Self::high) lacks.
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
        // The crate loses digits of angles from some 1e9: whole turns are taken away here, with 48 digits of `2 pi`.
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

    /// Reads a decimal number such as `-1.5e-3`, rounded to some 31 digits.
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
                // Beyond what 106 bits hold.
                exponent += 1;
            }
        }
        if count == 0 {
            return Err(malformed());
        }
        exponent -= fraction.len() as i32;
        // Powers of ten up to 1e44 are double-doubles without rounding; `powi` would take a logarithm.
        let power = (0..exponent.abs()).fold(Self::from_f64(1.0), |power, _| power * ten);
        let value = if exponent < 0 { value / power } else { value * power };
        Ok(if mantissa.starts_with('-') { -value } else { value })
    }
}

#[cfg(test)]
mod tests {
    use num_traits::One;
    use twofold::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
    use twofold::lorentz_violation::PrincipalCoefficients;
    use twofold::propagation::Motion;

    use super::*;
    use crate::check::largest;

    /// Unit of the last place, 2^-105.
    const EPSILON: f64 = 2.5e-32;

    fn number(text: &str) -> DoubleDouble {
        text.parse().expect("a decimal number")
    }

    fn close(a: DoubleDouble, b: DoubleDouble) {
        let difference = ((a - b) / b).high().abs();
        assert!(difference <= 4.0 * EPSILON, "{a:?} and {b:?} differ by {difference:e}");
    }

    #[test]
    fn decimals_are_read_to_the_last_digit() {
        assert_eq!(number("-12.5"), DoubleDouble::from_f64(-12.5));
        assert_eq!(number("3e2"), DoubleDouble::from_f64(300.0));
        let third = DoubleDouble::one() / DoubleDouble::from_f64(3.0);
        close(number("0.33333333333333333333333333333333333"), third);
        assert_eq!(number("0.1").high(), 0.1);
        assert!(["", "-", "1.2.3", "x", "1e"].iter().all(|text| text.parse::<DoubleDouble>().is_err()));
    }

    #[test]
    fn functions_have_thirty_digits() {
        let two = DoubleDouble::from_f64(2.0);
        let one = DoubleDouble::one();
        close(two.sqrt(), number("1.4142135623730950488016887242096980786"));
        close(one.exp(), number("2.7182818284590452353602874713526624978"));
        close(two.ln(), number("0.69314718055994530941723212145817656808"));
        let (sin, cos) = number("0.7").sin_cos();
        close(sin, number("0.64421768723769105367261435139872018307"));
        close(cos, number("0.76484218728448842625585999019186490927"));
        // mpmath, 60 digits.
        let (sin, cos) = number("1e15").sin_cos();
        close(sin, number("0.858272793170235835523886390848406647"));
        close(cos, number("-0.51319373778697025223453613642316493"));
        let quarter = number("0.78539816339744830961566084581987572104");
        close(one.atan2(one), quarter);
        close(one.atan2(-one), quarter * 3.0);
        close((-one).atan2(-one), -quarter * 3.0);
    }

    #[test]
    fn a_motion_agrees_with_the_reference_beyond_double_precision() {
        let spheroid = RigidSpheroid::in_units_of_tc(number("1.1"));
        let s = PrincipalCoefficients::new(["0.02", "0.01", "-0.04"].map(number)).tensor();
        let rows = include_str!("../data/reference_states.csv").lines().filter_map(|line| line.strip_prefix("tp-2,"));
        let states: Vec<Vec<DoubleDouble>> = rows.map(|row| row.split(',').map(number).collect()).collect();
        let vector = |i: usize| nalgebra::Vector3::from_column_slice(&states[0][i..i + 3]);
        let problem = Problem::new(spheroid, s, BodyState::from_vectors([1, 4, 7].map(vector))).expect("a problem");
        let last = states.last().expect("states")[0].high();
        let motion = problem.taylor((0.0, last), 1e-16).expect("a motion");
        for row in &states[1..] {
            let state = motion.state(row[0]).expect("a time of the span");
            let found = state.vectors();
            let error =
                largest(found.iter().flatten().zip(&row[1..]).map(|(ours, theirs)| (*ours - *theirs).high().abs()));
            // The initial values are rounded to 22 digits and a phase of 600 rad makes more of that.
            assert!(error < 1e-18, "t = {}: {error:e}", row[0].high());
        }
    }
}
