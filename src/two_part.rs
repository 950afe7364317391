//! Numbers of 32 digits as unevaluated sums of two doubles, for times over decades: a second in 20 years to 1e-10 of a turn.

use crate::rounding::{quick_two_sum, two_product, two_sum};

/// The value `x[0] + x[1]`, the second part below the rounding of the first.
pub(crate) type TwoPart = [f64; 2];

/// `a + b`.
pub(crate) fn sum(a: TwoPart, b: TwoPart) -> TwoPart {
    let (high, lost) = two_sum(a[0], b[0]);
    let (low, lost_low) = two_sum(a[1], b[1]);
    let (high, rest) = quick_two_sum(high, lost + low);
    quick_two_sum(high, rest + lost_low).into()
}

/// `a - b`.
pub(crate) fn difference(a: TwoPart, b: TwoPart) -> TwoPart {
    sum(a, [-b[0], -b[1]])
}

/// `a b`.
pub(crate) fn product(a: TwoPart, b: TwoPart) -> TwoPart {
    let (high, lost) = two_product(a[0], b[0]);
    quick_two_sum(high, lost + (a[0] * b[1] + a[1] * b[0])).into()
}

/// `a / b`.
pub(crate) fn quotient(a: TwoPart, b: TwoPart) -> TwoPart {
    let first = a[0] / b[0];
    let rest = difference(a, product([first, 0.0], b));
    let second = rest[0] / b[0];
    let rest = difference(rest, product([second, 0.0], b));
    let (high, low) = quick_two_sum(first, second);
    quick_two_sum(high, low + rest[0] / b[0]).into()
}

/// The nearest whole number, and what is left, from -1/2 to 1/2.
pub(crate) fn whole_and_rest(a: TwoPart) -> (f64, f64) {
    let whole = a[0].round();
    let rest = difference(a, [whole, 0.0]);
    // The first part may be whole, or half-way, and the second not.
    let more = (rest[0] + rest[1]).round();
    (whole + more, (rest[0] - more) + rest[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_digits_are_kept() {
        let third = quotient([1.0, 0.0], [3.0, 0.0]);
        let back = product(third, [3.0, 0.0]);
        let error = difference(back, [1.0, 0.0]);
        assert!(error[0].abs() < 1e-31, "{error:?}");
        let big = sum([1e12, 0.0], third);
        let (whole, rest) = whole_and_rest(big);
        assert!(whole == 1e12 && (rest - 1.0 / 3.0).abs() < 1e-19, "{whole} {rest}");
        assert_eq!(whole_and_rest([3.0, -0.25]), (3.0, -0.25));
        assert_eq!(whole_and_rest([1e17, 0.75]), (1e17 + 1.0, -0.25));
    }
}
